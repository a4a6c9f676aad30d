// Runs on a card that do not come to their end: what was finished is whole, and goes on anywhere.
#include <csignal>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>

#include "tests/cuda/simulated_run.hpp"

namespace slideway::testing::simulated_ends_test {
namespace {

constexpr char const* scene = R"(
schema = 1
[friction]
[study]
members = 48
duration = "2 ms"
quantities = ["energy_residual"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

std::vector<std::string> const small_blocks{"--threads", "2", "--block-members", "8"};

class EarlyEnds : public SimulatedRun {
protected:
    EarlyEnds() { write("s.toml", scene); }

    std::map<std::string, std::uint64_t> calls() const {
        Setting const counts("COUNTS", path("counts").string());
        EXPECT_EQ(run_scene("s.toml", "counted.nc", small_blocks).code, 0);
        std::ifstream file(path("counts"));
        std::map<std::string, std::uint64_t> found;
        std::string function;
        for (std::uint64_t count; file >> function >> count;) found[function] = count;
        return found;
    }
    /// The run ends with one line and code 4, or as if nothing had been; what it left then makes the whole result.
    void expect_survived(std::string const& failure, std::string const& hash) const {
        {
            Setting const fail("FAIL", failure);
            Outcome const outcome = run_scene("s.toml", "s.nc", small_blocks);
            if (outcome.code == 0) {
                EXPECT_EQ(outcome.err, "") << failure;
            } else {
                EXPECT_EQ(outcome.code, 4) << failure << ": " << outcome.err;
                EXPECT_TRUE(outcome.err.starts_with("cuda: ")) << failure << ": " << outcome.err;
                EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
                    << failure << ": " << outcome.err;
                EXPECT_FALSE(std::filesystem::exists(path("s.nc"))) << failure;
            }
        }
        std::vector<std::string> resumed = small_blocks;
        resumed.insert(resumed.end(), {"--resume", "--backend", "cpu"});
        Outcome const outcome = run_scene("s.toml", "s.nc", resumed);
        EXPECT_EQ(outcome.code, 0) << failure << ": " << outcome.err;
        EXPECT_EQ(hash_of("s.nc"), hash) << failure;
        std::filesystem::remove(path("s.nc"));
    }
};

TEST_F(EarlyEnds, OfEveryFailingCallLoseNothing) {
    std::string const hash = processor_hash("s.toml");
    auto const counted = calls();
    ASSERT_GE(counted.size(), 15u);
    for (auto const& [function, count] : counted) {
        if (function.starts_with("__cuda")) continue;
        // The end of a block is asked for as often as it takes.
        std::uint64_t const last = function == "cudaEventQuery" ? 5 : count;
        for (std::uint64_t const n : {std::uint64_t(1), (last + 1) / 2}) {
            expect_survived(function + ":" + std::to_string(n), hash);
        }
    }
}

TEST_F(EarlyEnds, OfACardThatIsLostLoseNothing) {
    std::string const hash = processor_hash("s.toml");
    for (int const n : {1, 3, 6}) expect_survived("kernel:" + std::to_string(n) + ":700", hash);
    Setting const fail("FAIL", "kernel:5:700");
    Outcome const outcome = run_scene("s.toml", "s.nc", small_blocks);
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("cudaErrorIllegalAddress"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("what is finished is kept in s.nc.shards: add --resume to go on"), std::string::npos);
    EXPECT_GE(shards_in("s.nc.shards"), 1u);
}

TEST_F(EarlyEnds, ByASignalAreSoonAndGoOn) {
    std::vector<std::string> const words{"run",
                                         "s.toml",
                                         "-o",
                                         "s.nc",
                                         "--no-progress",
                                         "--backend",
                                         "cuda",
                                         "--threads",
                                         "2",
                                         "--set",
                                         "study.members=4000",
                                         "study.duration=0.1",
                                         "--block-members",
                                         "500"};
    pid_t const child = start(words);
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(path("s.nc.shards/run.toml")); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    auto const told = std::chrono::steady_clock::now();
    kill(child, SIGTERM);
    Outcome const outcome = wait(child);
    EXPECT_LT(std::chrono::steady_clock::now() - told, std::chrono::seconds(3));
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("stopped early (signal)"), std::string::npos) << outcome.err;
    // Members of the blocks in work that had ended are kept.
    EXPECT_GE(shards_in("s.nc.shards"), 1u);
}

}  // namespace
}  // namespace slideway::testing::simulated_ends_test
