// Starts that no mechanism has.
#include "tests/system/small_run.hpp"

namespace slideway::testing::start_test {
namespace {

class Starts : public SmallRun {};

TEST_F(Starts, InsideTheWayAreRefusedByCheckAndRun) {
    EXPECT_EQ(run({"check", "s.toml"}).code, 0);
    // A clearance of 0.1 mm: the sliders that vary in y by 0.09 mm each way start free.
    for (char const* const start : {"initial.roll=-1", "initial.z=-0.3 mm", "initial.z=0.111 mm", "initial.pitch=0.1"}) {
        for (char const* const command : {"check", "run"}) {
            expect_refusal(2, "inside the way, deeper than a tenth of the clearance: member ", {command, "s.toml", "--set", start});
        }
        EXPECT_EQ(run({"check", "s.toml", "--any-start", "--set", start, "study.duration=1 us"}).code, 0) << start;
    }
    // A contact that is pressed in is no mistake.
    EXPECT_EQ(run({"check", "s.toml", "--set", "initial.z=-0.10001 mm"}).code, 0);
}

TEST_F(Starts, InsideAStopOrOffTheWayAreRefused) {
    std::string const head = "schema = 1\n[mechanism]\nkind = \"free_slider\"\n[contact]\nlaw = \"foundation\"\nrestitution = 0.5\n[study]\nduration = 0.1\n";
    auto const stop = [&](double position) { return head + fmt::format("[stop.a]\nblocks = \"+x\"\nposition = {}\nstiffness = 1e9\n", position); };
    write("stop.toml", stop(-1e-3));
    expect_refusal(2, "it starts inside a stop, deeper than a tenth of the clearance: member 0 by 1 mm", {"check", "stop.toml"});
    EXPECT_EQ(run({"check", "stop.toml", "--any-start"}).code, 0);
    write("stop.toml", stop(1e-3));
    EXPECT_EQ(run({"check", "stop.toml"}).code, 0);
    write("ends.toml", head + "[way_ends]\nfrom = 0.5\n");
    expect_refusal(2, "[way_ends], off which it may begin,", {"check", "ends.toml"});
}

/// The speed of a touch is that of the start where this touches: F (1 + a) with a(0.5) = 1.433, and not 100 times that.
TEST_F(Starts, ThatTouchHaveMetAsFastAsTheyMove) {
    for (std::string const& method : {std::string("auto"), std::string("dopri5"), std::string("verner65")}) {
        write("deep.toml", "schema = 1\n[mechanism]\nkind = \"free_slider\"\ngravity = 0\n[contact]\nlaw = \"foundation\"\nrestitution = 0.5\n[initial]\nvy = \"10 mm/s\"\n"
                           "[integrator]\nmethod = \"" + method + "\"\n[study]\nduration = \"1 ms\"\nverify = 0\nquantities = [\"peak_normal_force\"]\n");
        auto const peak = [&](std::string const& y) {
            EXPECT_EQ(run({"run", "deep.toml", "-o", "o.nc", "--force", "--no-progress", "--set", "initial.y=" + y}).code, 0);
            return results("o.nc").values("peak_normal_force")[0];
        };
        double const grazing = peak("0.1 mm"), in = peak("0.10002 mm");
        EXPECT_NEAR(grazing, 495, 20) << method;
        EXPECT_GT(in, grazing) << method;
        EXPECT_LT(in, 1.6 * grazing) << method;
    }
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
    words = some;
    words.insert(words.end(), {"-o", "o.nc", "--set", "study.duration=1 us"});
    EXPECT_EQ(run_scene(words).err, refused.err) << "one gate";
    EXPECT_FALSE(std::filesystem::exists(path("o.nc.shards")));
    // A run that takes them warns, and shows what becomes of them.
    words.emplace_back("--any-start");
    Outcome const outcome = run_scene(words);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("warning: " + std::to_string(of) + " of 37 members start inside the way"), std::string::npos) << outcome.err;
}

/// Clearances below zero: 46 % of this distribution.  They fail alone, and check says how many will.
TEST_F(Starts, OfDrawsThatCannotBeAreCounted) {
    Outcome const outcome = run({"check", "s.toml", "--set", "study.vary.\"joint.clearance\"={dist=\"norm\", mean=1e-4, sd=1e-3}", "--set",
                                 "study.vary.\"initial.y\"={dist=\"unif\", low=0, high=1e-9}"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    auto const at = outcome.err.find("s.toml: ");
    int of = 0, all = 0;
    ASSERT_NE(at, std::string::npos) << outcome.err;
    ASSERT_EQ(std::sscanf(outcome.err.c_str() + at, "s.toml: %d of %d members draw what cannot be", &of, &all), 2) << outcome.err;
    EXPECT_EQ(all, 37);
    EXPECT_GT(of, 8);
    EXPECT_LT(of, 29);
}

TEST_F(Starts, OfRowsAreRefusedAtTheirLine) {
    write("table.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nduration = \"1 us\"\ndesign = \"table\"\ntable = \"rows.csv\"\n");
    write("rows.csv", "part,initial.z [mm]\nA-001,0.05\nA-002,0.1\nA-003,0.3\n");
    for (char const* const command : {"check", "run"}) {
        expect_refusal(2, "rows.csv:4: its member starts inside the way, deeper than a tenth of the clearance: by 0.2 mm", {command, "table.toml"});
    }
    write("rows.csv", "part,initial.z [mm]\nA-001,0.05\nA-002,nan\n");
    for (char const* const command : {"check", "run"}) expect_refusal(2, "rows.csv:3: initial.z (column 2) is \"nan\"", {command, "table.toml"});
    // The rod does not reach a slider that is 10 m above the crank.
    write("rows.csv", "initial.y\n0\n10\n");
    for (char const* const command : {"check", "run"}) {
        expect_refusal(2, "rows.csv:3: its mechanism cannot be evaluated at the start (geometry); change the row", {command, "table.toml"});
    }
}

/// A way that is tilted leaves the slider as it was, whose apices are then inside: 0.7 mm at one end, in a clearance of 0.1 mm.
TEST_F(Starts, OfRigidSlidersInsideTheWaySaySo) {
    std::string const rigid = "schema = 1\n[mechanism]\nkind = \"scotch_yoke\"\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n[way]\npitch = 0.01\n"
                              "[initial]\ny = -1e-4\n[study]\nduration = \"1 us\"\n";
    std::string const words = "cannot be evaluated at the start (geometry: with rigid contacts it may not begin inside the way, by 0.699 mm); change ";
    write("rigid.toml", rigid);
    write("rows.toml", rigid + "design = \"table\"\ntable = \"rows.csv\"\n");
    write("rows.csv", "initial.vy\n0\n");
    for (char const* const command : {"check", "run"}) {
        expect_refusal(2, "rigid.toml: its mechanism " + words + "[initial]", {command, "rigid.toml"});
        expect_refusal(2, "rows.csv:2: its mechanism " + words + "the row", {command, "rows.toml"});
    }
}

TEST_F(Starts, ThatNoMemberHasAreRefused) {
    for (char const* const command : {"check", "run"}) expect_refusal(2, "s.toml: no member can be evaluated at the start (geometry)", {command, "s.toml", "--set", "initial.z=10"});
}

}  // namespace
}  // namespace slideway::testing::start_test
