// A correlated Latin hypercube is ordered as a whole: the same however its members are shared out.
#include <algorithm>
#include <cmath>

#include "tests/system/shards.hpp"

namespace slideway::testing::correlated_test {
namespace {

class CorrelatedHypercube : public ShardedRun {
protected:
    static constexpr int members = 60;
    CorrelatedHypercube() {
        write(
            "s.toml",
            "schema = 1\n[contact]\nlaw = \"paper\"\n[friction]\n[study]\ndesign = \"lhs\"\nmembers = 60\nduration = \"1 ms\"\nquantities = "
            "[\"energy_residual\"]\n"
            "[study.correlation]\nkeys = [\"initial.z\", \"initial.y\"]\nmatrix = [[1, 0.9], [0.9, 1]]\n[study.vary]\n"
            "\"initial.y\" = { dist = \"unif\", low = -6e-5, high = 6e-5 }\n\"initial.z\" = { dist = \"unif\", low = "
            "0, high = 6e-5 }\n");
    }
    void expect_done(std::vector<std::string> const& options) const {
        Outcome const outcome = run_scene(options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
};

TEST_F(CorrelatedHypercube, HasStrataAndCorrelation) {
    expect_done({});
    auto const y = results("o.nc").values("initial_y"), z = results("o.nc").values("initial_z");
    std::vector<int> in_y(members), in_z(members);
    double sum = 0;
    for (std::size_t i = 0; i < members; ++i) {
        double const u = (y[i] + 6e-5) / 12e-5, v = z[i] / 6e-5;
        ++in_y.at(static_cast<std::size_t>(u * members));
        ++in_z.at(static_cast<std::size_t>(v * members));
        sum += (u - 0.5) * (v - 0.5) * 12 / members;
    }
    EXPECT_EQ(std::count(in_y.begin(), in_y.end(), 1), members);
    EXPECT_EQ(std::count(in_z.begin(), in_z.end(), 1), members);
    EXPECT_NEAR(sum, 0.891, 0.03);  // 6/π asin(0.45)
}

TEST_F(CorrelatedHypercube, IsOneOverThreadsBlocksShardsAndResumedRuns) {
    std::string const hash = undisturbed_hash();
    for (auto const& options : {std::vector<std::string>{"--threads", "1", "--block-members", "7"},
                                {"--threads", "2", "--block-members", "8"}}) {
        expect_done(options);
        EXPECT_EQ(hash_of("o.nc"), hash);
        std::filesystem::remove(path("o.nc"));
    }
    expect_done({"--shard", "2/3"});
    expect_done({"--resume", "--block-members", "5"});
    EXPECT_EQ(hash_of("o.nc"), hash);
    std::filesystem::remove(path("o.nc"));
    for (char const* const part : {"2/2", "1/2"}) expect_done({"--shard", part});
    EXPECT_EQ(run({"merge", "o.nc.shards", "-o", "o.nc"}).code, 0) << file_text(path("err"));
    EXPECT_EQ(hash_of("o.nc"), hash);
}

TEST_F(CorrelatedHypercube, IsOneOverRanks) {
    if (auto const why = why_no_ranks(); !why.empty()) GTEST_SKIP() << why;
    std::string const hash = undisturbed_hash();
    ShellOutcome const outcome = shell(mpirun(2) + run_text("--threads 1 --block-members 8"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(hash_of("o.nc"), hash);
}

TEST_F(CorrelatedHypercube, TellsWhatItsOrderTakes) {
    // 60 members of 20 bytes and 4 for each of two keys.
    std::string const text = run({"check", "s.toml"}).out;
    EXPECT_NE(text.find(", 1.7 kB for the order of the members"), std::string::npos) << text;
    EXPECT_EQ(run({"check", "s.toml", "--set", "study.design=mc"}).out.find("order of the members"), std::string::npos);
}

TEST_F(CorrelatedHypercube, RepeatsAMemberAlone) {
    expect_done({});
    auto const y = results("o.nc").values("initial_y");
    EXPECT_EQ(run(run_words({"--members", "41..41"}, "one.nc")).code, 0) << file_text(path("err"));
    EXPECT_EQ(results("one.nc").values("initial_y"), std::vector<double>{y[41]});
}

}  // namespace
}  // namespace slideway::testing::correlated_test
