// The memory and the disk that a run says it needs, and those that it takes.
#include <filesystem>

#include <sys/resource.h>

#include "host/study/prediction.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::memory_test {
namespace {

class Needs : public Program {
protected:
    static std::string scene(std::string const& members) {
        return "schema = 1\n[contact]\nlaw = \"paper\"\n[integrator]\nmethod = \"rk4\"\nstep = 1e-5\n[study]\nkind = \"tolerance\"\n" + members +
               "\nduration = 1e-5\nquantities = [\"peak_normal_force\", \"mode_time\"]\n[study.vary]\n"
               "\"joint.clearance\" = { dist = \"unif\", low = 1e-4, high = 2e-4 }\n"
               "\"contact.eta\" = { dist = \"unif\", low = 0.01, high = 0.02 }\n";
    }

    /// The most memory that a run of two threads has at once [B].
    double peak_of(std::string const& text, std::vector<std::string> options = {}) const {
        write("s.toml", text);
        options.insert(options.begin(),
                       {"run", "s.toml", "--no-progress", "--isa", "scalar", "--threads", "2", "--force", "-o", "r.nc"});
        pid_t const child = start(std::move(options));
        int status = 0;
        rusage usage{};
        EXPECT_EQ(wait4(child, &status, 0, &usage), child);
        EXPECT_EQ(status, 0) << file_text(path("err"));
        return 1024.0 * static_cast<double>(usage.ru_maxrss);
    }
};

TEST_F(Needs, OfMemoryAreMoreThanWhatARunTakesButNotThrice) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need more memory than the program";
#endif
    double const program = peak_of(scene("design = \"mc\"\nmembers = 10"));
    for (std::string const design : {"design = \"mc\"\nmembers = 150000", "design = \"saltelli\"\nbase = 49152"}) {
        double const taken = peak_of(scene(design)) - program;
        auto const told = static_cast<double>(predict(scene_of(scene(design)), *cpu_backend(Isa::scalar), 2).memory());
        EXPECT_LT(taken, told) << design;
        EXPECT_LT(told, 3 * taken) << design;
    }
}

TEST_F(Needs, OfTheDiskHoldWhatSmallBlocksTake) {
    std::string const text = scene("design = \"mc\"\nmembers = 400");
    peak_of(text, {"--block-members", "10", "--shard", "1/1"});
    std::uintmax_t shards = 0, count = 0;
    for (auto const& entry : std::filesystem::directory_iterator(path("r.nc.shards"))) {
        if (!entry.path().filename().string().starts_with("members-")) continue;
        shards += entry.file_size();
        EXPECT_LT(entry.file_size(), 60'000u);
        ++count;
    }
    EXPECT_EQ(count, 40u);
    std::filesystem::remove_all(path("r.nc.shards"));
    peak_of(text);
    Prediction const told = predict(scene_of(text), *cpu_backend(Isa::scalar), 2, 10);
    EXPECT_LT(shards, told.shard_bytes);
    EXPECT_LT(told.shard_bytes, 2 * shards);
    std::uintmax_t const result = std::filesystem::file_size(path("r.nc"));
    EXPECT_LT(result, told.output_bytes);
    EXPECT_LT(told.output_bytes, 2 * result);
}

TEST_F(Needs, OfACorrelatedHypercubeHoldItsOrder) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need more memory than the program";
#endif
    constexpr char const* correlation =
        "[study.correlation]\nkeys = [\"joint.clearance\", \"contact.eta\"]\nmatrix = [[1, 0.5], [0.5, 1]]\n";
    std::string const alone = scene("design = \"lhs\"\nmembers = 150000"), together = alone + correlation;
    auto const told = [](std::string const& text) {
        return predict(scene_of(text), *cpu_backend(Isa::scalar), 2).memory();
    };
    // Scores, a sum of them, its order; strata of two keys.  The scene is longer, too.
    EXPECT_NEAR(static_cast<double>(told(together) - told(alone)), 150000.0 * (8 + 8 + 4 + 2 * 4), 1000);
    EXPECT_LT(peak_of(together) - peak_of(scene("design = \"mc\"\nmembers = 10")), static_cast<double>(told(together)));
}

}  // namespace
}  // namespace slideway::testing::memory_test
