// Linkages that a scene describes, against closed forms and against the mechanisms of the tree.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/backend/backend.hpp"
#include "host/library/slideway.hpp"
#include "tests/support/planar_linkage.hpp"

namespace slideway::linkages_test {
namespace {

/// The crank is 60 mm, the coupler 250, the rocker 150, the ground 220 mm.
std::string four_bar(std::string_view pins, std::string_view rest) {
    std::string const pin = fmt::format("{}\n", pins);
    return "schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = \"150 rpm\"\n[drive]\nbody = \"crank\"\n"
           "[body.crank]\nmass = 0.4\ninertia = 3e-4\ncenter_x = 0.03\n[body.coupler]\nmass = 0.6\ninertia = 2e-3\ncenter_x = 0.12\nangle = 0.5\n"
           "[body.rocker]\nmass = 0.5\ninertia = 1e-3\ncenter_x = 0.07\nangle = 1.4\n"
           "[link.shaft]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"crank\"\n"
           "[link.post]\nkind = \"revolute\"\nfirst = \"ground\"\nfirst_x = 0.22\nsecond = \"rocker\"\n"
           "[link.crank_pin]\nfirst = \"crank\"\nfirst_x = 0.06\nsecond = \"coupler\"\n" + pin +
           "[link.coupler_pin]\nfirst = \"coupler\"\nfirst_x = 0.25\nsecond = \"rocker\"\nsecond_x = 0.15\n" + pin + std::string(rest);
}
constexpr std::string_view ideal = "kind = \"revolute\"", samples = "[study]\nrevolutions = 3\nsamples_per_revolution = 50\n";
std::string journals(double clearance) { return fmt::format("kind = \"journal\"\nclearance = {}\nradius = 0.01\n", clearance); }

std::vector<double> column(Result const& result, std::string const& name) { return result.column(name).values(); }

/// How far the ends of coupler and rocker are apart.
double open_by(double crank, double coupler, double rocker) {
    return std::hypot(0.06 * std::cos(crank) + 0.25 * std::cos(coupler) - 0.22 - 0.15 * std::cos(rocker),
                      0.06 * std::sin(crank) + 0.25 * std::sin(coupler) - 0.15 * std::sin(rocker));
}

/// Angle of the rocker over a crank angle, on the branch of the scene: from the crank pin coupler and rocker span a triangle.
double rocker_angle(double crank) {
    double const x = 0.22 - 0.06 * std::cos(crank), y = -0.06 * std::sin(crank), reach = std::hypot(x, y);
    double const at_post = std::acos((reach * reach + 0.15 * 0.15 - 0.25 * 0.25) / (2 * reach * 0.15));
    return std::atan2(-y, -x) - at_post;
}

}  // namespace

TEST(Linkages, OfIdealJointsHaveTheClosedFormOfAFourBar) {
    auto const result = Ensemble::parse(four_bar(ideal, std::string("[integrator]\nrtol = 1e-8\n") + std::string(samples))).run();
    auto const crank = column(result, "crank_angle"), rocker = column(result, "rocker_angle"), coupler = column(result, "coupler_angle");
    ASSERT_EQ(crank.size(), 151u);
    for (std::size_t i = 0; i < crank.size(); ++i) {
        double const want = rocker_angle(crank[i]);
        EXPECT_NEAR(std::remainder(rocker[i] - want, 2 * std::numbers::pi), 0, 1e-8) << crank[i];
        // Inside of steps the loop is closed but for their interpolation.
        EXPECT_LT(open_by(crank[i], coupler[i], rocker[i]), 1e-9) << crank[i];
    }
    auto const at_end = [&](std::string const& body) { return column(result, "final_" + body + "_angle")[0]; };
    EXPECT_LT(open_by(at_end("crank"), at_end("coupler"), at_end("rocker")), 1e-14);
}

/// What the drive puts in and takes out in whole turns of a linkage that nothing damps is nothing.
TEST(Linkages, OfIdealJointsTakeNoWorkInATurn) {
    auto const result = Ensemble::parse(four_bar(ideal, "[integrator]\nrtol = 1e-10\n[study]\nrevolutions = 3\nquantities = [\"drive_work\", \"energy_residual\", \"peak_crank_torque\"]\n")).run();
    EXPECT_GT(column(result, "peak_crank_torque")[0], 0.5);
    EXPECT_NEAR(column(result, "drive_work")[0], 0, 1e-9);
    EXPECT_NEAR(column(result, "energy_residual")[0], 0, 1e-9);
}

TEST(Linkages, MoveAsThePlanarSliderCrankThatTheyDescribe) {
    std::string const rest = "[contact]\nrestitution = 0.4\n{}[integrator]\nrtol = 1e-10\n[study]\nduration = 0.06\nsamples = 61\n"
                             "quantities = [\"contact_onsets\", \"damping_loss\", \"friction_loss\", \"normal_force\"]\n";
    for (std::string const friction : {"", "[friction]\nstatic = 0.1\nkinetic = 0.05\n"}) {
        double const y = friction.empty() ? 0 : 2e-4, pitch = friction.empty() ? 0 : 3e-3;
        Settings const start{{"study.samples", "61"}, {"study.duration", "0.06"}, {"integrator.rtol", "1e-10"}, {"integrator.atol", "1e-11"}, {"initial.y", fmt::format("{}", y)},
                             {"initial.pitch", fmt::format("{}", pitch)}, {"friction.enabled", friction.empty() ? "false" : "true"}, {"friction.static", "0.1"}, {"friction.kinetic", "0.05"},
                             {"study.quantities", "[\"contact_onsets\", \"damping_loss\", \"friction_loss\", \"normal_force\"]"}};
        Result const known = Ensemble::read(SLIDEWAY_SCENES "/planar_flores.toml", start).run();
        Result const described = Ensemble::parse(testing::planar_linkage() + fmt::format("offset_y = {}\ntilt = {}\n", y, pitch) + fmt::format(fmt::runtime(rest), friction)).run();
        EXPECT_EQ(column(described, "contact_onsets"), column(known, "contact_onsets"));
        EXPECT_GT(column(known, "contact_onsets")[0], 3);
        EXPECT_NEAR(column(described, "damping_loss")[0], column(known, "damping_loss")[0], 1e-7);
        EXPECT_NEAR(column(described, "friction_loss")[0], column(known, "friction_loss")[0], 1e-7);
        if (!friction.empty()) EXPECT_GT(column(known, "friction_loss")[0], 1e-3);
        for (auto const& [one, other] : {std::pair("rod_angle", "rod_angle"), {"crank_angle", "crank_angle"}, {"slider_angle", "pitch"}}) {
            auto const a = column(described, one), b = column(known, other);
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-8) << one << ' ' << i << friction;
        }
    }
}

TEST(Linkages, OfJournalsWithoutLossKeepTheirBooks) {
    std::string const study = "[contact]\nrestitution = 1\n[integrator]\nrtol = 1e-9\n[study]\nrevolutions = 1\nsamples_per_revolution = 100\n"
                              "quantities = [\"energy_residual\", \"drive_work\", \"energy_change\", \"contact_onsets\", \"crank_pin_x\", \"crank_pin_y\", \"coupler_pin_x\", \"coupler_pin_y\"]\n";
    Result const result = Ensemble::parse(four_bar(journals(2e-4), study)).run();
    EXPECT_GT(column(result, "contact_onsets")[0], 10);
    EXPECT_NEAR(column(result, "energy_residual")[0], 0, 1e-7);
    EXPECT_NEAR(column(result, "energy_change")[0], column(result, "drive_work")[0], 1e-7);
    for (std::string const pin : {"crank_pin", "coupler_pin"}) {
        auto const x = column(result, pin + "_x"), y = column(result, pin + "_y");
        double farthest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) farthest = std::max(farthest, std::hypot(x[i], y[i]));
        EXPECT_GT(farthest, 1.5e-4) << pin;
        EXPECT_LT(farthest, 2.1e-4) << pin;
    }
}

TEST(Linkages, OfJournalsFollowTheIdealOnesWithinTheirClearances) {
    std::string const study = "[contact]\nrestitution = 0.5\n" + std::string(samples);
    auto const crank = column(Ensemble::parse(four_bar(ideal, samples)).run(), "crank_angle");
    for (double const clearance : {1e-4, 1e-5}) {
        auto const rocker = column(Ensemble::parse(four_bar(journals(clearance), study)).run(), "rocker_angle");
        double farthest = 0;
        for (std::size_t i = 0; i < rocker.size(); ++i) farthest = std::max(farthest, std::abs(std::remainder(rocker[i] - rocker_angle(crank[i]), 2 * std::numbers::pi)));
        // Two clearances, along a coupler that pushes the rocker at an angle.
        EXPECT_LT(farthest, 4 * clearance / 0.15) << clearance;
        EXPECT_GT(farthest, 0.3 * clearance / 0.15) << clearance;
    }
}

TEST(Linkages, OfPendulumsKeepTheirEnergyTheBetterTheTighterTheTolerance) {
    double last = 1;
    for (char const* const rtol : {"1e-6", "1e-8", "1e-10"}) {
        Result const result = Ensemble::parse(fmt::format(
            "schema = 1\n[mechanism]\nkind = \"linkage\"\n[body.upper]\nmass = 1\ninertia = 0.02\ncenter_x = 0.25\nangle = 1.2\n[body.lower]\nmass = 0.7\ninertia = 0.01\ncenter_x = 0.2\nangle = 0.3\n"
            "[link.top]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"upper\"\n[link.elbow]\nkind = \"revolute\"\nfirst = \"upper\"\nfirst_x = 0.5\nsecond = \"lower\"\n"
            "[integrator]\nrtol = {0}\natol = {0}\nmax_step = 0.1\n[study]\nduration = 5\nquantities = [\"energy_change\"]\n", rtol)).run();
        double const error = std::abs(column(result, "energy_change")[0]);
        EXPECT_LT(error, 0.2 * last) << rtol;
        last = error;
    }
    EXPECT_LT(last, 1e-8);
}

/// A chain of two on journals, listed in either order: each body starts at the angle and with the rate that it is given.
TEST(Linkages, StartAsTheirBodiesAreGivenWhereThatCloses) {
    std::string const upper = "[body.upper]\nmass = 1\ninertia = 0.02\ncenter_x = 0.25\nangle = -1.2\nspeed = 5\n", lower = "[body.lower]\nmass = 0.7\ninertia = 0.01\ncenter_x = 0.2\nangle = -0.3\nspeed = -2\n";
    std::string const links = "[link.top]\nkind = \"journal\"\nfirst = \"upper\"\nsecond = \"ground\"\nclearance = 1e-4\nradius = 0.01\n"
                              "[link.elbow]\nkind = \"journal\"\nfirst = \"upper\"\nfirst_x = 0.5\nsecond = \"lower\"\nclearance = 1e-4\nradius = 0.01\n[study]\nduration = 1e-3\nsamples = 2\n";
    for (std::string const& bodies : {upper + lower, lower + upper}) {
        Result const result = Ensemble::parse("schema = 1\n[mechanism]\nkind = \"linkage\"\n" + bodies + links).run();
        EXPECT_NEAR(column(result, "upper_angle")[0], -1.2, 1e-12);
        EXPECT_NEAR(column(result, "lower_angle")[0], -0.3, 1e-12);
        EXPECT_NEAR(column(result, "upper_angular_velocity")[0], 5, 1e-11);
        EXPECT_NEAR(column(result, "lower_angular_velocity")[0], -2, 1e-11);
    }
}

/// Steps of motions without contact are judged by their own size: no pendulum is accused of making energy.
TEST(Linkages, OfPendulumsAreNotAccused) {
    for (char const* const pin : {"kind = \"revolute\"\n", "kind = \"journal\"\nclearance = 1e-4\nradius = 0.01\n"}) {
        Result const result = Ensemble::parse(std::string("schema = 1\n[mechanism]\nkind = \"linkage\"\n[body.rod]\nmass = 1\ninertia = 0.02\ncenter_x = 0.25\nangle = 0.3\n[link.top]\nfirst = \"rod\"\nsecond = \"ground\"\n") + pin +
                                             "[contact]\nrestitution = 0.8\n[study]\nduration = 5\nquantities = [\"energy_change\"]\n").run();
        EXPECT_EQ(column(result, "status")[0], 0) << pin;
    }
}

/// Two equal rods, let go from rest with both level, against tests/golden/double_pendulum.py, which differentiates Lagrange's equations; its second seed says 1.180.
TEST(Linkages, OfADoublePendulumSeparateAsAnotherProgramSays) {
    constexpr double wanted = 1.179, half_width = 0.0103;
    Result const result = Ensemble::parse(
        "schema = 1\n[mechanism]\nkind = \"linkage\"\n[body.upper]\nmass = 1\ninertia = 0.08333333333333333\ncenter_x = 0.5\n[body.lower]\nmass = 1\ninertia = 0.08333333333333333\ncenter_x = 0.5\n"
        "[link.top]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"upper\"\n[link.elbow]\nkind = \"revolute\"\nfirst = \"upper\"\nfirst_x = 1\nsecond = \"lower\"\n"
        "[integrator]\nrtol = 1e-8\natol = 1e-8\nmax_step = 0.1\n[study]\nkind = \"lyapunov\"\nmembers = 32\nduration = 200\nTtr = 20\ndt = 0.05\nd0 = 1e-6\nverify = 0\nquantities = [\"energy_change\"]\n"
        "[study.vary]\n\"body.upper.mass\" = { dist = \"unif\", low = 0.999999, high = 1.000001 }\n").run();
    auto const exponents = column(result, "lyapunov_exponent");
    double mean = 0, squares = 0;
    for (double const x : exponents) mean += x / double(exponents.size());
    for (double const x : exponents) squares += (x - mean) * (x - mean);
    double const error = std::sqrt(squares / double(exponents.size() - 1) / double(exponents.size()));
    EXPECT_NEAR(mean, wanted, 1.5 * std::hypot(2 * error, half_width));
    EXPECT_LT(error, 0.02);
    for (double const x : column(result, "energy_change")) EXPECT_LT(std::abs(x), 1e-3);
}

/// Each for a quarter of a turn, or a tenth of a second.
TEST(Linkages, OfTheScenesRunAndKeepTheirBooks) {
    for (std::string const name : {"four_bar_journal", "four_bar_journals", "four_bar_loose", "six_bar_press", "slider_crank_clearances", "slider_crank_journal"}) {
        Settings settings{{"study.members", "2"}, {"study.verify", "0"}, {"integrator.rtol", "1e-8"}, {"integrator.atol", "1e-8"}};
        if (name != "four_bar_loose") settings.push_back({"study.revolutions", "0.25"});
        Result const result = Ensemble::read(SLIDEWAY_SCENES "/" + name + ".toml", settings).run();
        for (std::size_t i = 0; i < 2; ++i) {
            double const lost = column(result, "damping_loss")[i];
            EXPECT_EQ(column(result, "status")[i], 0) << name;
            EXPECT_GT(lost, 1e-3) << name;
            EXPECT_LT(std::abs(column(result, "energy_residual")[i]), 1e-3 * lost) << name;
        }
    }
}

TEST(Linkages, HaveOneHashOnEveryInstructionSetAndNumberOfThreads) {
    Ensemble const ensemble = Ensemble::read(SLIDEWAY_SCENES "/four_bar_journals.toml", {{"study.revolutions", "0.5"}, {"study.members", "13"}, {"study.verify", "0"}});
    std::string const hash = ensemble.run({.threads = 2}).payload_hash();
    for (Isa const isa : built_isas()) {
        if (is_supported(isa)) EXPECT_EQ(ensemble.run({.threads = 1, .isa = std::string(name_of(isa))}).payload_hash(), hash) << name_of(isa);
    }
}

}  // namespace slideway::linkages_test
