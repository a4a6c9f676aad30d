// What a revolution is: of a crank, of a carriage, and where there is none.
#include "host/config/descriptors.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::drive_period_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;
constexpr double pi = std::numbers::pi;

Parts parts_of(Mechanism mechanism, bool free_crank = false) {
    Parts parts;
    parts.mechanism = mechanism;
    parts.drive.by = free_crank ? slideway::DriveBy::nothing : slideway::DriveBy::speed;
    return parts;
}

std::string with_kind(std::string const& kind, std::string const& lines) {
    return fmt::format("schema = 1\n[mechanism]\nkind = \"{}\"\n{}\n", kind, lines);
}

TEST(DrivePeriod, OfACrankIsItsTurn) {
    Inputs in;
    in.crank_speed = -4;
    EXPECT_DOUBLE_EQ(drive_period(parts_of(Mechanism::slider_crank), in), pi / 2);
    EXPECT_DOUBLE_EQ(drive_period(parts_of(Mechanism::planar_slider_crank), in), pi / 2);
    in.crank_speed = 0;
    EXPECT_TRUE(std::isinf(drive_period(parts_of(Mechanism::slider_crank), in)));
}

TEST(DrivePeriod, OfACarriageIsThereAndBack) {
    Inputs in;  // 150 mm at 60 mm/s, 20 ms to turn round, twice
    EXPECT_DOUBLE_EQ(drive_period(parts_of(Mechanism::carriage), in), 5.04);
    in.carriage_speed = 0.5, in.stroke = 0.1, in.reversal_time = 0.3;
    EXPECT_DOUBLE_EQ(drive_period(parts_of(Mechanism::carriage), in), 1);
}

TEST(DrivePeriod, IsNoneWhereNothingDrives) {
    EXPECT_TRUE(std::isinf(drive_period(parts_of(Mechanism::free_slider), {})));
    EXPECT_TRUE(std::isinf(drive_period(parts_of(Mechanism::planar_slider_crank, true), {})));
}

TEST(FirstTimeAt, OfACarriageIsAShareOfItsPeriod) {
    Inputs in;
    in.carriage_speed = 0.5, in.stroke = 0.1, in.reversal_time = 0.3;  // T = 1 s
    Parts const carriage = parts_of(Mechanism::carriage);
    EXPECT_DOUBLE_EQ(first_time_at(pi / 2, carriage, in), 0.25);
    EXPECT_DOUBLE_EQ(first_time_at(-pi / 2, carriage, in), 0.75);
    EXPECT_DOUBLE_EQ(first_time_at(9 * pi / 2, carriage, in), 0.25);
    EXPECT_DOUBLE_EQ(first_time_at(0, carriage, in), 1) << "the start is no return";
    in.start_angle = 1, in.crank_speed = 7;  // it has no crank
    EXPECT_DOUBLE_EQ(first_time_at(pi / 2, carriage, in), 0.25);
}

TEST(Revolutions, OfACarriageArePeriods) {
    Scene const scene = scene_of(with_kind("carriage", "[study]\nrevolutions = 2\nsamples_per_revolution = 10"));
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 10.08);
    EXPECT_EQ(scene.sample_times.size(), 21u);
    // A thousandth of a second, or a 2000th of the period where that is shorter.
    EXPECT_EQ(scene.integrator.max_step, 1e-3);
    EXPECT_DOUBLE_EQ(
        scene_of(with_kind("carriage", "carriage_speed = 1\nstroke = 0.1\nreversal_time = 0.4")).integrator.max_step,
        5e-4);
}

TEST(Revolutions, OfADrivenPlanarCrankAreItsTurns) {
    Scene const scene =
        scene_of(with_kind("planar_slider_crank", "crank_speed = \"600 rpm\"\n[study]\nrevolutions = 3"));
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 0.3);
    EXPECT_DOUBLE_EQ(scene.integrator.max_step, 5e-5);
}

/// What finds its touches inside steps may take longer ones than what may leap over an impact.
TEST(Revolutions, LimitTheStepsOfVerner65TenTimesLess) {
    auto const longest = [](std::string const& method, std::string const& speed) {
        return scene_of(with_kind("slider_crank", "crank_speed = " + speed + "\n[integrator]\nmethod = \"" + method + "\"")).integrator.max_step;
    };
    EXPECT_DOUBLE_EQ(longest("dopri5", "\"600 rpm\""), 5e-5);
    EXPECT_DOUBLE_EQ(longest("verner65", "\"600 rpm\""), 5e-4);
    EXPECT_EQ(longest("verner65", "1"), 1e-3);
    EXPECT_DOUBLE_EQ(scene_of(with_kind("planar_slider_crank", "crank_speed = \"600 rpm\"\n[integrator]\nmethod = \"verner65\"")).integrator.max_step, 5e-5)
        << "its corners have no clocks";
}

TEST(Revolutions, AreNoneWhereNothingDrives) {
    EXPECT_EQ(error_of(with_kind("free_slider", "[study]\nrevolutions = 2")),
              "scene.toml:5: study.revolutions is 2 (nothing drives a free_slider, so there are no revolutions); "
              "use study.duration instead");
    EXPECT_EQ(error_of(with_kind("free_slider", "[study]\nduration = 1\nsamples_per_revolution = 2")),
              "scene.toml:6: study.samples_per_revolution is 2 (nothing drives a free_slider, so there are no "
              "revolutions); use study.samples instead");
    EXPECT_EQ(error_of(with_kind("planar_slider_crank", "[drive]\nkind = \"free\"\n[study]\nrevolutions = 2")),
              "scene.toml:7: study.time_limit is missing (a crank that turns freely may never turn so far); add time_limit = \"60 s\"");
    EXPECT_EQ(scene_of(with_kind("free_slider", "")).integrator.end_time, 1);
    EXPECT_EQ(scene_of(with_kind("free_slider", "")).integrator.max_step, 1e-3);
}

TEST(Revolutions, OfAFreeCrankLimitItsStepsByTheSpeedItStartsWith) {
    std::string const lines = "crank_speed = \"600 rpm\"\n[drive]\nkind = \"free\"";
    EXPECT_DOUBLE_EQ(scene_of(with_kind("planar_slider_crank", lines)).integrator.max_step, 5e-5);
    EXPECT_EQ(scene_of(with_kind("planar_slider_crank", "crank_speed = 0\n[drive]\nkind = \"free\"")).integrator.max_step,
              1e-3);
}

TEST(Revolutions, OfStudiesOfOrbits) {
    std::string const free = "[drive]\nkind = \"free\"\n";
    EXPECT_EQ(error_of(with_kind("planar_slider_crank", free + "[study]\nkind = \"poincare\"")),
              "scene.toml:7: study.time_limit is missing (a crank that turns freely may never turn so far); add time_limit = \"60 s\"");
    EXPECT_EQ(error_of(with_kind("planar_slider_crank",
                                 free + "[study]\nkind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4]")),
              "scene.toml:7: study.time_limit is missing (a crank that turns freely may never turn so far); add time_limit = \"60 s\"");
    Scene const lyapunov = scene_of(with_kind("planar_slider_crank", free + "[study]\nkind = \"lyapunov\""));
    EXPECT_EQ(lyapunov.chaos.span, (Span{10, false}));
    EXPECT_EQ(lyapunov.chaos.dt, (Span{1.0 / 2000, false}));
    Scene const carriage = scene_of(with_kind("carriage", "[study]\nkind = \"poincare\"\nphase = \"90 deg\""));
    EXPECT_EQ(carriage.chaos.span, (Span{150, true}));
    EXPECT_DOUBLE_EQ(carriage.integrator.end_time, 170 * 5.04);
}

TEST(Revolutions, DifferWhereWhatDrivesVaries) {
    auto const carriage = [](std::string const& vary) {
        return error_of(with_kind("carriage", "[study]\nkind = \"poincare\"\nduration = 100\n[study.vary]\n" + vary));
    };
    for (char const* const key : {"mechanism.carriage_speed", "mechanism.stroke", "mechanism.reversal_time"}) {
        EXPECT_EQ(
            carriage(fmt::format("\"{}\" = {{ dist = \"unif\", low = 0.1, high = 0.2 }}", key)),
            fmt::format("scene.toml:6: study.duration is 100 ({} differs between members, and so would their number "
                        "of sections); use study.revolutions",
                        key));
    }
    EXPECT_EQ(carriage("\"initial.y\" = { dist = \"unif\", low = -1e-5, high = 1e-5 }"), "");
    EXPECT_TRUE(
        contains(error_of(with_kind("carriage",
                                    "[study]\nkind = \"poincare\"\nrevolutions = 3\n[study.vary]\n"
                                    "\"mechanism.carriage_speed\" = { dist = \"norm\", mean = 0.06, sd = 0.02 }")),
                 "mechanism.carriage_speed may be 0, where revolutions do not end"));
}

TEST(Revolutions, LastAsLongAsTheSlowestDriveMakesThem) {
    // Two periods of 2 (0.15/v + 0.02) s each: 12 s at 0.05 m/s; steps are allowed for what lasts longest.
    auto const steps = [](std::string const& vary) {
        return scene_of(with_kind("carriage",
                                  "[study]\nkind = \"poincare\"\nrevolutions = 2\ntransient_revolutions = 0\n" + vary))
            .integrator.max_steps;
    };
    std::string const slower =
        "[study.vary]\n\"mechanism.carriage_speed\" = { dist = \"unif\", low = 0.005, high = 0.06 }\n";
    EXPECT_GT(steps(slower), 5 * steps(""));
}

TEST(Exponents, AreNotOfAFreeSlider) {
    EXPECT_EQ(
        error_of(with_kind("free_slider", "[study]\nkind = \"lyapunov\"")),
        "scene.toml:5: study.kind is \"lyapunov\" (nothing drives a free_slider, and no exponents are computed of "
        "it); use \"ensemble\" or \"poincare\"");
    EXPECT_EQ(error_of(with_kind("carriage", "[study]\nkind = \"lyapunov\"\nexponents = 10")), "");
    // As many as the state has numbers.
    EXPECT_EQ(error_of(with_kind("planar_slider_crank", "[study]\nkind = \"lyapunov\"\nexponents = 4")), "");
    EXPECT_NE(error_of(with_kind("planar_slider_crank", "[study]\nkind = \"lyapunov\"\nexponents = 7")), "");
}

TEST(Sections, AreOfTheMechanismsOwnStates) {
    auto const on = [](std::string const& kind, std::string const& name) {
        return with_kind(
            kind,
            fmt::format("[study]\nkind = \"poincare\"\nTtr = 0\nduration = 1\nsection = {{ on = \"{}\" }}", name));
    };
    EXPECT_EQ(scene_of(on("free_slider", "vx")).chaos.section.index, 11);
    EXPECT_EQ(scene_of(on("free_slider", "gap_z[P2]")).chaos.section.index, 1);
    EXPECT_EQ(scene_of(on("free_slider", "gap_z[P2]")).chaos.section.on, SectionSurface::On::gap_z);
    EXPECT_EQ(scene_of(on("planar_slider_crank", "rod_angle")).chaos.section.index, 1);
    EXPECT_EQ(scene_of(on("planar_slider_crank", "wz")).chaos.section.index, 5);
    EXPECT_EQ(error_of(on("planar_slider_crank", "gap_y[P1]")),
              "scene.toml:8: study.section.on is \"gap_y[P1]\" (no state of it); use one of crank_angle, rod_angle, "
              "pitch, crank_angular_velocity, rod_angular_velocity, wz");
    EXPECT_NE(error_of(on("carriage", "x")), "") << "it is prescribed";
    Scene const turning = scene_of(with_kind("planar_slider_crank",
                                             "[study]\nkind = \"poincare\"\nTtr = 0\nduration = 1\n"
                                             "section = { on = \"crank_angular_velocity\", value = \"60 rpm\" }"));
    EXPECT_DOUBLE_EQ(turning.chaos.section.level, 2 * pi);
}

TEST(ContinuedSweeps, OfACarriageTakeTheirSectionsAtItsStart) {
    auto const sweep = [](std::string const& lines) {
        return error_of(with_kind("carriage",
                                  "[study]\nkind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4, "
                                  "2e-4]\nexponents = 0\nstart = \"continue\"\n" +
                                      lines));
    };
    EXPECT_EQ(sweep(""), "");
    EXPECT_EQ(sweep("phase = 0"), "");
    EXPECT_EQ(sweep("phase = 1"),
              "scene.toml:9: study.start is \"continue\" (a carriage starts at phase 0, and columns would end at "
              "study.phase); use start = \"fresh\", or phase = 0");
}

TEST(ContinuedSweeps, AreRefusedWhereFacesMoveOtherwiseThanStartsFollow) {
    auto const sweep = [](std::string const& parameter, std::string const& way) {
        return error_of(with_kind("slider_crank", "[contact]\nlaw = \"foundation\"\n" + way + "[study]\nkind = \"sweep\"\nparameter = \"" + parameter +
                                                      "\"\nvalues = [2e-4, 1e-4]\nexponents = 0\nstart = \"continue\"\n"));
    };
    std::string const leans = "[way]\npitch = 1e-4\n", ends = "[way_ends]\nfrom = \"50 mm\"\nto = \"250 mm\"\n",
                      scatters = "[study.vary]\n\"way.yaw\" = { dist = \"unif\", low = 0, high = 1e-4 }\n";
    for (char const* const parameter : {"joint.clearance", "joint.slider_length", "way.offset_y"}) EXPECT_EQ(sweep(parameter, ""), "");
    for (char const* const parameter : {"way.offset_y", "material.density", "joint.thickness_y"}) EXPECT_EQ(sweep(parameter, leans), "");
    constexpr std::pair<char const*, int> moved[] = {{"way.roll", 0}, {"way.pitch", 1}, {"joint.clearance", 1}, {"slider.pin_x", 1},
                                                     {"joint.clearance_y", 2}, {"way_ends.from", 2}, {"joint.clearance", 3}};
    std::string const ways[] = {"", leans, ends, scatters};
    for (auto const& [parameter, way] : moved) {
        std::string const words = std::string(" (") + parameter + " moves the faces of the way, and columns start where the one before ended); "
                                  "use start = \"fresh\", or another parameter", told = sweep(parameter, ways[way]);
        EXPECT_NE(told.find(words), std::string::npos) << parameter << ": " << told;
    }
}

}  // namespace
}  // namespace slideway::drive_period_test
