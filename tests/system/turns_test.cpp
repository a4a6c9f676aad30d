// Studies by the revolutions of cranks that turn freely, run through the program, and what their files hold.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/system/results.hpp"

namespace slideway::testing::turns_test {
namespace {

using std::numbers::pi;

/// Of a yoke on a motor, and a flywheel.
std::string scene(std::string const& study, std::string const& drive = "torque = \"0.4 N m\"\nno_load_speed = \"25 rad/s\"\n") {
    return fmt::format(
        "schema = 1\n[mechanism]\nkind = \"scotch_yoke\"\ncrank_speed = \"9 rad/s\"\nstart_angle = \"40 deg\"\n"
        "[drive]\nkind = \"torque\"\ninertia = 0.004\n{}[contact]\nlaw = \"conservative\"\nrestitution = 0.6\n[friction]\n"
        "[study]\nmembers = 24\ntime_limit = \"20 s\"\nverify = 0\n{}\n"
        "[study.vary]\n\"initial.y\" = {{ dist = \"unif\", low = \"-0.09 mm\", high = \"0.09 mm\" }}\n", drive, study);
}

class ByTurns : public ProgramWithResults {
protected:
    ResultReader results_of(std::string const& text, std::vector<std::string> more = {}) const {
        write("s.toml", text);
        std::vector<std::string> words{"run", "s.toml", "-o", "s.nc", "--force", "--no-progress"};
        words.insert(words.end(), more.begin(), more.end());
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return results("s.nc");
    }
};

TEST_F(ByTurns, FilesHaveAnglesOfSamplesAndTimesOfMembers) {
    ResultReader const file = results_of(scene("revolutions = 1.5\nsamples_per_revolution = 20\nquantities = [\"drive_work\"]"));
    auto const turned = file.values("turned"), time = file.values("time"), angle = file.values("crank_angle"), end = file.values("end_time"),
               last = file.values("final_crank_angle");
    ASSERT_EQ(turned.size(), 31u);
    EXPECT_EQ(file.unit("turned"), "rad");
    EXPECT_EQ(file.shape("time"), (std::vector<std::size_t>{24, 31}));
    for (std::size_t i = 0; i < 24; ++i) {
        EXPECT_NEAR(last[i], pi * (40.0 / 180 + 3), 1e-11) << i;
        EXPECT_EQ(time[31 * i + 30], end[i]);
        EXPECT_EQ(time[31 * i], 0);
        for (std::size_t k = 0; k < 31; ++k) EXPECT_NEAR(angle[31 * i + k], pi * (40.0 / 180 + 0.1 * static_cast<double>(k)), 1e-10) << i << ' ' << k;
    }
    EXPECT_NE(end[0], end[1]);
    ASSERT_EQ(run({"export", "s.nc", "-o", "o.csv", "--series", "y"}).code, 0);
    std::string const table = file_text(path("o.csv"));
    EXPECT_EQ(table.substr(0, table.find('\n')), "member,turned [rad],time [s],y [m]");
    expect_refusal(2, "s.nc: its samples are at equal angles, not at equal times; run the scene with study.duration and study.samples", {"stats", "s.nc", "--variable", "y"});
    Outcome const probed = run({"probe", "s.nc", "--member", "3", "--time", fmt::format("{:.17g}", time[31 * 3 + 12])});
    EXPECT_EQ(probed.code, 0) << probed.err;
}

/// A heavy flywheel turns freely with a light slider, whose contacts take next to nothing of its energy: rounding of that is no instability.
TEST_F(ByTurns, ALightSliderOnAHeavyFlywheelIsStable) {
    for (std::string const& kind : {std::string("scotch_yoke"), std::string("planar_slider_crank")}) {
        for (std::string const& law : {std::string("foundation"), std::string("rigid")}) {
            if (kind != "scotch_yoke" && law != "rigid") continue;
            ResultReader const file = results_of(fmt::format(
                "schema = 1\n[mechanism]\nkind = \"{}\"\ncrank_speed = \"60 rpm\"\nslider_mass = 0.1\n[drive]\nkind = \"free\"\ninertia = 5\n"
                "[joint]\nclearance = \"10 um\"\n[contact]\nlaw = \"{}\"\nrestitution = 0.5\n[initial]\ny = \"-10 um\"\n"
                "[study]\nrevolutions = 3\ntime_limit = \"50 s\"\nquantities = [\"energy_residual\"]\n", kind, law));
            EXPECT_LT(std::abs(file.values("energy_residual")[0]), 1e-6) << kind << ", " << law;
        }
    }
}

/// Members of other speeds end after revolutions of their own, with the steps of their own drives: a speed that is drawn moves as one that is given.
TEST_F(ByTurns, MembersOfDrivesThatScatterEndAfterTheirOwnRevolutions) {
    auto const text = [](std::string const& mechanism, std::string const& vary) {
        return "schema = 1\n[mechanism]\n" + mechanism + "[contact]\nlaw = \"foundation\"\nrestitution = 0.5\n[friction]\n[study]\nkind = \"tolerance\"\nmembers = 4\n"
               "revolutions = 1\nverify = 0\nquantities = [\"friction_loss\"]\n[study.vary]\n" + vary;
    };
    struct Drive { std::string kind, key, value; };
    for (Drive const& drive : {Drive{"slider_crank", "crank_speed", "15"}, Drive{"carriage", "carriage_speed", "1"}, Drive{"carriage", "stroke", "0.01"}}) {
        std::string const kind = "kind = \"" + drive.kind + "\"\n", vary = "\"mechanism." + drive.key + "\" = {dist = \"const\", value = " + drive.value + "}\n";
        std::string const start = "\"initial.y\" = {dist = \"const\", value = 0}\n";
        ResultReader const drawn = results_of(text(kind, vary + start));
        auto const losses = drawn.values("friction_loss"), ends = drawn.values("end_time");
        ResultReader const given = results_of(text(kind + drive.key + " = " + drive.value + "\n", start));
        EXPECT_EQ(ends, given.values("end_time")) << drive.key;
        EXPECT_EQ(losses, given.values("friction_loss")) << drive.key;
    }
    ResultReader const file = results_of(text("kind = \"slider_crank\"\n", "\"mechanism.crank_speed\" = {dist = \"unif\", low = 10, high = 20}\n"));
    auto const speeds = file.values("mechanism_crank_speed"), ends = file.values("end_time");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(ends[i], 2 * pi / speeds[i], 1e-12) << i;
    write("s.toml", text("kind = \"slider_crank\"\n", "\"mechanism.crank_speed\" = {dist = \"unif\", low = 10, high = 20}\n"));
    expect_refusal(2, "mechanism.crank_speed may be 0, where revolutions do not end", {"check", "s.toml", "--set", "study.vary.\"mechanism.crank_speed\".low=-1"});
    EXPECT_NE(run({"check", "s.toml"}).out.find("each over 1 revolutions of its own, 0.628319 s at most"), std::string::npos);
    expect_refusal(2, "members are sampled at common times, and their revolutions last differently: mechanism.crank_speed is drawn",
                   {"check", "s.toml", "--set", "study.samples=5", "study.kind=ensemble"});
}

/// A pulse over 8 degrees of the crank is met in each turn, however fast the members turn that are drawn.
TEST_F(ByTurns, StepsAreThoseOfTheFastestMember) {
    write("p.csv", "crank_angle [deg],t\n0,0\n196.3,0\n200.3,1000\n204.3,0\n360,0\n");
    ResultReader const file = results_of(
        "schema = 1\n[mechanism]\nkind = \"scotch_yoke\"\ngravity = 0\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n[load.a]\non = \"crank\"\ntorque = 1\n"
        "table = \"p.csv\"\nover = \"crank_angle\"\ncolumn = \"t\"\ninterpolation = \"linear\"\n[study]\nkind = \"tolerance\"\nmembers = 4\nrevolutions = 2\n"
        "verify = 0\nquantities = [\"load_work\"]\n[study.vary]\n\"mechanism.crank_speed\" = {dist = \"unif\", low = 60, high = 61}\n");
    for (double const work : file.values("load_work")) EXPECT_NEAR(work, 2 * 1000 * (8 * pi / 180) / 2, 0.05);
}

/// Without exponents a sweep asks nothing of rigid contacts that they do not have.
TEST_F(ByTurns, RigidSweepsWithoutExponentsRun) {
    ResultReader const file = results_of(
        "schema = 1\n[mechanism]\nkind = \"slider_crank\"\ncrank_speed = 10\n[drive]\nkind = \"torque\"\ntorque = 1\ninertia = 0.1\nno_load_speed = 12\n"
        "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n[friction]\n[study]\nkind = \"sweep\"\nparameter = \"drive.torque\"\nvalues = [1, 1.5]\nmembers = 1\n"
        "transient_revolutions = 1\nrevolutions = 2\ntime_limit = 10\nexponents = 0\nverify = 0\nquantities = [\"friction_loss\"]\n");
    EXPECT_EQ(file.values("friction_loss").size(), 2u);
}

TEST_F(ByTurns, ResumedFilesAreThoseOfOneRun) {
    std::string const text = scene("revolutions = 0.75\nsamples_per_revolution = 16\nquantities = [\"energy_residual\"]");
    std::string const whole = results_of(text).attribute("payload_hash");
    ASSERT_EQ(run({"run", "s.toml", "-o", "p.nc", "--no-progress", "--block-members", "8", "--shard", "1/1"}).code, 0);
    ASSERT_TRUE(std::filesystem::remove(path("p.nc.shards/members-0000000008.nc")));
    ASSERT_EQ(run({"run", "s.toml", "-o", "p.nc", "--quiet", "--resume"}).code, 0);
    EXPECT_EQ(results("p.nc").attribute("payload_hash"), whole);
    EXPECT_EQ(results_of(text, {"--isa", "scalar", "--threads", "1"}).attribute("payload_hash"), whole);
}

TEST_F(ByTurns, OrbitsHaveOneHashOnEveryInstructionSet) {
    std::string const turns = "transient_revolutions = 1\nrevolutions = 1\n", exponents = "exponents = 2\nrescalings_per_revolution = 60\n";
    for (std::string const& study : {"kind = \"lyapunov\"\n" + exponents, std::string("kind = \"poincare\"\nphase = \"10 deg\"\n"),
                                     "kind = \"sweep\"\nparameter = \"drive.torque\"\nvalues = [0.3, -0.4]\n" + exponents}) {
        for (std::vector<std::string> const& mechanism : {std::vector<std::string>{}, {"--set", "mechanism.kind=planar_slider_crank", "contact.law=rigid"}}) {
            std::vector<std::string> lanes = mechanism;
            if (lanes.empty()) lanes.push_back("--set");
            lanes.push_back("study.members=9");
            std::vector<std::string> scalar = lanes;
            scalar.insert(scalar.end(), {"--isa", "scalar", "--threads", "1"});
            std::string const text = scene(turns + study), hash = results_of(text, lanes).attribute("payload_hash");
            EXPECT_EQ(results_of(text, scalar).attribute("payload_hash"), hash) << study;
        }
    }
}

TEST_F(ByTurns, MembersThatAreLateAreCounted) {
    write("s.toml", scene("revolutions = 1.5\nquantities = [\"drive_work\"]"));
    Outcome const outcome = run({"run", "s.toml", "-o", "s.nc", "--no-progress", "--set", "drive.torque=0.01", "study.time_limit=0.3", "--max-failures", "100%"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("The cranks of 24 members had not turned as far as study.revolutions after study.time_limit = 0.3 s"), std::string::npos) << outcome.out;
    for (double const status : results("s.nc").values("status")) EXPECT_EQ(status, 8);
    for (double const time : results("s.nc").values("end_time")) EXPECT_EQ(time, 0.3);
}

TEST_F(ByTurns, SectionsLieAtTheirPhaseWhicheverWayTheCrankTurns) {
    for (double const way : {1.0, -1.0}) {
        std::string const drive = fmt::format("torque = {}\nno_load_speed = \"25 rad/s\"\n", 0.4 * way);
        ResultReader const file = results_of(scene("kind = \"poincare\"\nphase = \"75 deg\"\ntransient_revolutions = 2\nrevolutions = 3", drive),
                                             {"--set", fmt::format("mechanism.crank_speed={}", 9 * way)});
        EXPECT_EQ(file.values("section_count"), std::vector<double>(24, 3));
        auto const angle = file.values("section_crank_angle"), time = file.values("section_time");
        double const first = way > 0 ? 75 : 75 - 360;
        for (std::size_t k = 0; k < angle.size(); ++k) {
            EXPECT_NEAR(angle[k], pi / 180 * (first + way * 360 * static_cast<double>(2 + k % 3)), 1e-11) << k;
            if (k % 3 > 0) {
                EXPECT_GT(time[k], time[k - 1]);
            }
        }
    }
}

TEST_F(ByTurns, ACrankThatComesBackThroughItsStartHasItsSections) {
    // On both sides of the start the phase is another angle away: a hair behind it, and half a degree, from a crank that begins backward or turns round.
    struct Way { char const* phase; double start, speed, torque; };
    for (Way const& way : {Way{"0.698131 rad", 40, -9, -0.4}, Way{"9.9999 deg", 10, -9, -0.4}, Way{"9.5 deg", 10, 9, -0.3}}) {
        SCOPED_TRACE(way.phase);
        std::string const drive = fmt::format("torque = {}\nno_load_speed = \"25 rad/s\"\n", way.torque);
        ResultReader const file = results_of(scene(fmt::format("kind = \"poincare\"\nphase = \"{}\"\ntransient_revolutions = 0\nrevolutions = 2", way.phase), drive),
                                             {"--set", fmt::format("mechanism.crank_speed={}", way.speed), fmt::format("mechanism.start_angle={} deg", way.start)});
        EXPECT_EQ(file.values("status"), std::vector<double>(24, 0));
        EXPECT_EQ(file.values("section_count"), std::vector<double>(24, 2));
        double const phase = way.start == 40 ? 0.698131 : pi / 180 * std::stod(way.phase);
        for (double const angle : file.values("section_crank_angle")) EXPECT_NEAR(std::remainder(angle - phase, 2 * pi), 0, 1e-10);
    }
}

TEST_F(ByTurns, ACrankAtRestHasItsFirstSampleAtItsStart) {
    ResultReader const file = results_of(scene("revolutions = 1\nsamples_per_revolution = 4"), {"--set", "mechanism.crank_speed=0"});
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(file.values("time")[5 * i], 0);
}

TEST_F(ByTurns, ASectionOnTheCrankAngleIsThatAtItsPhase) {
    auto const orbits = [&](std::string const& section) {
        return results_of(scene("kind = \"poincare\"\ntransient_revolutions = 1\nrevolutions = 3\n" + section));
    };
    ResultReader const phase = orbits("phase = \"75 deg\"");
    auto const time = phase.values("section_time"), y = phase.values("section_y");
    ResultReader const crossings = orbits("section = { on = \"crank_angle\", value = \"75 deg\" }");
    auto const other_time = crossings.values("section_time"), other_y = crossings.values("section_y");
    ASSERT_EQ(time.size(), other_time.size());
    for (std::size_t k = 0; k < time.size(); ++k) {
        EXPECT_NEAR(time[k], other_time[k], 1e-5) << k;
        EXPECT_NEAR(y[k], other_y[k], 1e-8) << k;
    }
}

TEST_F(ByTurns, AColumnOfASweepGoesOnWithTheSpeedOfTheOneBefore) {
    std::string const study = "kind = \"sweep\"\nparameter = \"drive.torque\"\nphase = \"75 deg\"\ntransient_revolutions = 0\nexponents = 0\n";
    ResultReader const longer = results_of(scene(study + "values = [0.4]\nrevolutions = 4\n"));
    auto const speed = longer.values("section_crank_angular_velocity");
    ResultReader const continued = results_of(scene(study + "values = [0.4, 0.4]\nrevolutions = 2\nstart = \"continue\"\n"));
    auto const again = continued.values("section_crank_angular_velocity"), angle = continued.values("section_crank_angle");
    ASSERT_EQ(again.size(), 96u);
    for (std::size_t i = 0; i < 24; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_NEAR(again[2 * i + k], speed[4 * i + k], 1e-9 * speed[4 * i + k]) << i;
            EXPECT_NEAR(again[48 + 2 * i + k], speed[4 * i + 2 + k], 1e-4 * speed[4 * i]) << i;
            EXPECT_NEAR(angle[48 + 2 * i + k], pi / 180 * (75 + 360 * static_cast<double>(k + 1)), 1e-11) << i;
        }
    }
}

TEST_F(ByTurns, ExponentsOfAHugeFlywheelAreThoseOfADrivenCrank) {
    // Contacts and damping take the slider's offsets, at a rate that the flywheel does not change; its own are neutral.
    std::string const study = "kind = \"lyapunov\"\nexponents = 4\ntransient_revolutions = 1\nrevolutions = 4\nrescalings_per_revolution = 200\n";
    ResultReader const free = results_of(scene(study, "torque = 1e-9\n"), {"--set", "drive.inertia=1e7", "study.members=4"});
    auto const exponent = free.values("lyapunov_exponent"), per_turn = free.values("lyapunov_exponent_per_turn"), time = free.values("lyapunov_time");
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(time[i], 4 * 2 * pi / 9, 1e-6);
        for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(per_turn[4 * i + j], exponent[4 * i + j] * time[i] / 4, 1e-9 * std::abs(per_turn[4 * i + j])) << i;
        EXPECT_LT(std::abs(exponent[4 * i]), 1.0) << "a turn of the flywheel goes on";
    }
    EXPECT_EQ(free.values("rescalings"), std::vector<double>(4, 800));
}

}  // namespace
}  // namespace slideway::testing::turns_test
