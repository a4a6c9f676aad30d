// Starts that no mechanism has.
#include "tests/system/small_run.hpp"

namespace slideway::testing::start_test {
namespace {

class Starts : public SmallRun {};

TEST_F(Starts, InsideTheWayAreRefusedByCheck) {
    EXPECT_EQ(run({"check", "s.toml"}).code, 0);
    // A clearance of 0.1 mm: the sliders that vary in y by 0.09 mm each way start free.
    for (char const* const start : {"initial.roll=-1", "initial.z=-0.3 mm", "initial.z=0.111 mm", "initial.pitch=0.1"}) {
        expect_refusal(2, "inside the way", {"check", "s.toml", "--set", start});
        EXPECT_EQ(run({"check", "s.toml", "--force", "--set", start, "study.duration=1 us"}).code, 0) << start;
    }
    // A contact that is pressed in is no mistake.
    EXPECT_EQ(run({"check", "s.toml", "--set", "initial.z=-0.10001 mm"}).code, 0);
}

TEST_F(Starts, OfAFewMembersAreCounted) {
    std::vector<std::string> const some{"--set", "study.vary.\"initial.y\"={dist=\"unif\", low=\"0 mm\", high=\"0.2 mm\"}"};
    std::vector<std::string> words{"check", "s.toml"};
    words.insert(words.end(), some.begin(), some.end());
    Outcome const refused = run(words);
    EXPECT_EQ(refused.code, 2);
    int of = 0, all = 0;
    ASSERT_EQ(std::sscanf(refused.err.c_str(), "s.toml: %d of %d members start", &of, &all), 2) << refused.err;
    EXPECT_EQ(all, 37);
    // Deeper than 0.01 mm are 45 % of them.
    EXPECT_GT(of, 6);
    EXPECT_LT(of, 28);
    // A run warns, and shows what becomes of them.
    words = some;
    words.insert(words.end(), {"-o", "o.nc", "--set", "study.duration=1 us"});
    Outcome const outcome = run_scene(words);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("warning: " + std::to_string(of) + " of 37 members start inside the way"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace slideway::testing::start_test
