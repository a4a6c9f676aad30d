// The keys of [study] for lyapunov, poincare and sweep: values, defaults and what they make of a scene.
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::chaos_test {
namespace {

using testing::contains;
using testing::scene_of;
using On = SectionSurface::On;
constexpr double pi = std::numbers::pi;

Scene study(std::string const& kind, std::string const& lines = {}, Overrides const& overrides = {}) {
    return scene_of(fmt::format("schema = 1\n[study]\nkind = \"{}\"\n{}", kind, lines), overrides);
}
std::string const clearances = "parameter = \"joint.clearance\"\nvalues = [\"0.1 mm\", 2e-4]\n";
Scene sweep(std::string const& lines = {}) { return study("sweep", clearances + lines); }

Span turns(double value) { return {value, true}; }
Span seconds(double value) { return {value, false}; }

TEST(SceneChaos, EveryKindHasItsName) {
    EXPECT_EQ(scene_of("schema = 1").study, StudyKind::ensemble);
    EXPECT_EQ(study("ensemble").study, StudyKind::ensemble);
    EXPECT_EQ(study("lyapunov").study, StudyKind::lyapunov);
    EXPECT_EQ(study("poincare").study, StudyKind::poincare);
    EXPECT_EQ(sweep().study, StudyKind::sweep);
    EXPECT_EQ(name_of(StudyKind::sweep), "sweep");
}

TEST(SceneChaos, SpansAreSecondsOrRevolutions) {
    double const never = std::numeric_limits<double>::infinity();
    EXPECT_EQ(seconds(3).seconds(0.5), 3);
    EXPECT_EQ(seconds(3).seconds(never), 3);
    EXPECT_EQ(turns(3).seconds(2), 6);
    EXPECT_TRUE(std::isinf(turns(1).seconds(never)));
    EXPECT_EQ(turns(0).seconds(never), 0);
}

TEST(SceneChaos, PartsAreCountedButForRounding) {
    EXPECT_EQ(parts_of(turns(10), turns(1.0 / 2000), 2), 20000);
    EXPECT_EQ(parts_of(seconds(0.3), seconds(0.1), 2), 3);
    EXPECT_EQ(parts_of(seconds(0.29), seconds(0.1), 2), 2);
    EXPECT_EQ(parts_of(seconds(4), turns(1.0 / 7), 2), 14);
    for (int n = 1; n < 3000; ++n) EXPECT_EQ(parts_of(turns(50), turns(1.0 / n), 0.7), 50.0 * n);
}

TEST(SceneChaos, PoincareDefaultsToThePapersSections) {
    Scene const scene = study("poincare");
    EXPECT_EQ(scene.chaos.section, SectionSurface{});
    EXPECT_EQ(scene.chaos.span, turns(150));
    EXPECT_EQ(scene.chaos.transient, turns(20));
    EXPECT_EQ(scene.chaos.max_crossings, 1000u);
    EXPECT_EQ(scene.chaos.exponents, 0) << "no neighbours";
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 340);
    EXPECT_GE(scene.integrator.max_steps, 340u * 30'000u) << "what the paper's law takes";
    EXPECT_TRUE(scene.integrator.locate_modes);
    EXPECT_TRUE(scene.sample_times.empty());
    EXPECT_EQ(scene.series, 0u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(SceneChaos, PoincareAtAPhase) {
    Scene const scene = study("poincare", "phase = \"90 deg\"\nTtr = \"20 s\"\nduration = \"1 min\"");
    EXPECT_EQ(scene.chaos.section.on, On::phase);
    EXPECT_DOUBLE_EQ(scene.chaos.section.level, pi / 2);
    EXPECT_EQ(scene.chaos.transient, seconds(20));
    EXPECT_EQ(scene.chaos.span, seconds(60));
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 80);
    EXPECT_EQ(study("poincare", "phase = -1").chaos.section.level, -1);
    EXPECT_DOUBLE_EQ(study("poincare", "phase = \"0.25 rev\"").chaos.section.level, pi / 2);
    EXPECT_DOUBLE_EQ(study("poincare", "Ttr = 0\nrevolutions = 2.5").integrator.end_time, 5);
}

TEST(SceneChaos, PoincareWhereAStateCrosses) {
    Scene const scene =
        study("poincare", "section = { on = \"vy\", value = \"3 mm/s\", direction = \"falling\" }\nmax_crossings = 77");
    EXPECT_EQ(scene.chaos.section, (SectionSurface{On::state, 2, 3e-3, CrossingDirection::falling}));
    EXPECT_EQ(scene.chaos.max_crossings, 77u);
    for (int i = 0; i < state_size; ++i) {
        auto const lines = fmt::format("section = {{ on = \"{}\" }}", series_table[i].name);
        EXPECT_EQ(study("poincare", lines).chaos.section, (SectionSurface{On::state, i, 0, CrossingDirection::rising}));
    }
    EXPECT_DOUBLE_EQ(study("poincare", "section = {on=\"wx\", value=\"1 rpm\"}").chaos.section.level, pi / 30);
    EXPECT_DOUBLE_EQ(study("poincare", "section = {on=\"roll\", value=\"1 deg\"}").chaos.section.level, pi / 180);
    EXPECT_EQ(study("poincare", "section = {on=\"y\", direction=\"both\"}").chaos.section.direction,
              CrossingDirection::both);
}

TEST(SceneChaos, PoincareWhereAGapCrosses) {
    for (int apex = 1; apex <= 8; ++apex) {
        auto const on = [&](char const* face) {
            return study("poincare", fmt::format("section = {{ on = \"{}[P{}]\", value = \"1 um\" }}", face, apex))
                .chaos.section;
        };
        EXPECT_EQ(on("gap_y"), (SectionSurface{On::gap_y, apex - 1, 1e-6, CrossingDirection::rising}));
        EXPECT_EQ(on("gap_z"), (SectionSurface{On::gap_z, apex - 1, 1e-6, CrossingDirection::rising}));
    }
    Scene const table = study("poincare", "[study.section]\non = \"gap_z[P3]\"");
    EXPECT_EQ(table.chaos.section, (SectionSurface{On::gap_z, 2, 0, CrossingDirection::rising}));
}

TEST(SceneChaos, PoincareAtTheImpactsOfRigidContacts) {
    for (char const* const kind : {"free_slider", "slider_crank", "planar_slider_crank"}) {
        auto const section = [&](char const* more) {
            return study("poincare", fmt::format("Ttr = 1\nduration = 1\nsection = {{ on = \"impacts\"{} }}\n[mechanism]\nkind = \"{}\"\n"
                                                 "[contact]\nlaw = \"rigid\"\nrestitution = 0.5", more, kind))
                .chaos.section;
        };
        EXPECT_EQ(section(""), (SectionSurface{On::impacts, 0, 0, CrossingDirection::both})) << kind;
        EXPECT_EQ(section(", direction = \"falling\"").direction, CrossingDirection::falling) << kind;
    }
}

TEST(SceneChaos, LyapunovDefaults) {
    Scene const scene = study("lyapunov");
    EXPECT_EQ(scene.chaos.exponents, 1);
    EXPECT_EQ(scene.chaos.d0, 1e-6);
    EXPECT_DOUBLE_EQ(scene.chaos.d0_lower, 3e-7);
    EXPECT_DOUBLE_EQ(scene.chaos.d0_upper, 3e-6);
    EXPECT_EQ(scene.chaos.transient, turns(2));
    EXPECT_EQ(scene.chaos.span, turns(10));
    EXPECT_EQ(scene.chaos.dt, turns(1.0 / 2000));
    EXPECT_EQ(scene.chaos.history, 100u);
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 24);
}

TEST(SceneChaos, LyapunovAsGiven) {
    Scene const scene = study("lyapunov",
                              "exponents = 1\nd0 = 1e-5\nd0_lower = 1e-7\nd0_upper = 1e-2\ndt = \"5 ms\"\n"
                              "Ttr = \"1 s\"\nduration = \"3 s\"\nhistory = 600");
    EXPECT_EQ(scene.chaos.d0, 1e-5);
    EXPECT_EQ(scene.chaos.d0_lower, 1e-7);
    EXPECT_EQ(scene.chaos.d0_upper, 1e-2);
    EXPECT_EQ(scene.chaos.dt, seconds(5e-3));
    EXPECT_EQ(scene.chaos.span, seconds(3));
    EXPECT_EQ(scene.chaos.transient, seconds(1));
    EXPECT_EQ(scene.chaos.history, 600u);
    EXPECT_TRUE(scene.warnings.empty());
    Scene const several = study("lyapunov", "exponents = 10\nd0 = 1e-4\nrescalings_per_revolution = 7\nhistory = 0");
    EXPECT_EQ(several.chaos.exponents, 10);
    EXPECT_DOUBLE_EQ(several.chaos.d0_lower, 3e-5);
    EXPECT_DOUBLE_EQ(several.chaos.d0_upper, 3e-4);
    EXPECT_EQ(several.chaos.dt, turns(1.0 / 7));
    EXPECT_EQ(several.chaos.history, 0u);
}

TEST(SceneChaos, TheHistoryIsNoLongerThanTheStudy) {
    EXPECT_EQ(study("lyapunov", "revolutions = 2\nrescalings_per_revolution = 7").chaos.history, 14u);
    EXPECT_EQ(study("lyapunov", "revolutions = 2\nrescalings_per_revolution = 7\nhistory = 14").chaos.history, 14u);
}

TEST(SceneChaos, SweepDefaults) {
    Scene const scene = sweep();
    EXPECT_EQ(scene.chaos.parameter, find_key("joint.clearance"));
    EXPECT_EQ(scene.chaos.values, (std::vector<double>{1e-4, 2e-4}));
    EXPECT_FALSE(scene.chaos.continued);
    EXPECT_EQ(scene.chaos.section, SectionSurface{});
    EXPECT_EQ(scene.chaos.span, turns(50));
    EXPECT_EQ(scene.chaos.transient, turns(20));
    EXPECT_EQ(scene.chaos.exponents, 1);
    EXPECT_EQ(scene.chaos.dt, turns(1.0 / 2000));
    EXPECT_EQ(scene.chaos.history, 0u);
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 140) << "one column";
}

TEST(SceneChaos, SweepAsGiven) {
    Scene const scene = sweep(
        "start = \"continue\"\nphase = \"1 rad\"\nrevolutions = 7\ntransient_revolutions = 3\n"
        "exponents = 2\nd0 = 1e-5\nrescalings_per_revolution = 10");
    EXPECT_TRUE(scene.chaos.continued);
    EXPECT_EQ(scene.chaos.section.level, 1);
    EXPECT_EQ(scene.chaos.span, turns(7));
    EXPECT_EQ(scene.chaos.transient, turns(3));
    EXPECT_EQ(scene.chaos.exponents, 2);
    EXPECT_EQ(scene.chaos.dt, turns(0.1));
    EXPECT_EQ(sweep("exponents = 0").chaos.exponents, 0);
    EXPECT_EQ(sweep("start = \"fresh\"\nTtr = \"20 s\"").chaos.transient, seconds(20));
}

TEST(SceneChaos, SweepRanges) {
    auto const values = [](std::string const& lines) {
        return study("sweep", "parameter = \"joint.clearance\"\n" + lines).chaos.values;
    };
    auto const linear = values("from = \"0.1 mm\"\nto = \"0.5 mm\"\npoints = 5");
    ASSERT_EQ(linear.size(), 5u);
    for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(linear[i], 1e-4 * (i + 1));
    EXPECT_EQ(linear.front(), 1e-4);
    EXPECT_EQ(linear.back(), 5e-4);
    auto const geometric = values("from = 1e-3\nto = 1e-5\npoints = 3\nspacing = \"log\"");
    ASSERT_EQ(geometric.size(), 3u);
    EXPECT_DOUBLE_EQ(geometric[1], 1e-4);
    EXPECT_EQ(geometric.back(), 1e-5);
    EXPECT_EQ(values("from = 1e-3\nto = 2e-3\npoints = 2\nspacing = \"linear\"").size(), 2u);
}

TEST(SceneChaos, SweptKeysBringTheirParts) {
    auto const parts = [](std::string const& lines) { return study("sweep", lines).parts; };
    EXPECT_TRUE(parts("parameter = \"way.roll\"\nvalues = [0, 1e-4]").misaligned_way);
    EXPECT_EQ(parts("parameter = \"contact.chi_line\"\nvalues = [0, 0.1]").damping, Damping::rate);
    EXPECT_EQ(parts("parameter = \"contact.restitution\"\nvalues = [0.5]").damping, Damping::restitution);
}

TEST(SceneChaos, AFastCrankIsNotLeaptOver) {
    std::string const lines = "parameter = \"mechanism.crank_speed\"\nvalues = [\"30 rpm\", \"600 rpm\"]";
    Scene const scene = study("sweep", lines);
    EXPECT_DOUBLE_EQ(scene.integrator.max_step, 0.1 / 2000);
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 140) << "at the scene's own speed";
    EXPECT_GE(study("sweep", "parameter = \"mechanism.crank_speed\"\nvalues = [\"3 rpm\"]").integrator.max_steps,
              1400u * 1'000'000u)
        << "but the steps suffice for the slowest";
}

TEST(SceneChaos, ACrankAtRestCountsSeconds) {
    std::string const rest = "[mechanism]\ncrank_speed = 0\n";
    Scene const lyapunov = study("lyapunov", rest);
    EXPECT_EQ(lyapunov.chaos.span, seconds(10));
    EXPECT_EQ(lyapunov.chaos.transient, seconds(2));
    EXPECT_EQ(lyapunov.chaos.dt, seconds(1.0 / 2000));
    EXPECT_EQ(study("poincare", "section = { on = \"y\" }\n" + rest).chaos.span, seconds(150));
}

TEST(SceneChaos, SpeedsMayVaryWhereAllCountRevolutions) {
    std::string const vary = "[study.vary]\n\"mechanism.crank_speed\" = {dist=\"unif\", low=3, high=4}";
    EXPECT_EQ(study("lyapunov", vary).variations.size(), 1u);
    EXPECT_EQ(study("lyapunov", "dt = 1e-3\nTtr = 1\nduration = 3\n" + vary).variations.size(), 1u);
    EXPECT_EQ(study("lyapunov", "Ttr = 0\n" + vary).variations.size(), 1u);
    EXPECT_EQ(study("poincare", vary).variations.size(), 1u);
    EXPECT_EQ(study("poincare", "duration = 3\nsection = {on=\"y\"}\n" + vary).variations.size(), 1u);
    EXPECT_EQ(sweep(vary).variations.size(), 1u);
}

TEST(SceneChaos, StepsSufficeForTheSlowestCrankOfADistribution) {
    auto const steps = [](std::string const& distribution) {
        return study("poincare", "[study.vary]\n\"mechanism.crank_speed\" = {dist=" + distribution + "}")
            .integrator.max_steps;
    };
    // Within 1 % of what 1 rad/s asks for: lognormal values 8 deviations below the median, exp(-0.008) of it.
    auto const wanted = static_cast<double>(steps("\"const\", value=1"));
    for (char const* const distribution :
         {"\"triang\", low=1, mode=2, high=3", "\"values\", values=[2, -1, 4]", "\"weibull\", scale=1, shape=1, low=1",
          "\"lognorm\", mean=1, sd=0.001", "\"lognorm\", mean=2, sd=0.001, low=1"}) {
        bool const shifted = std::string(distribution).ends_with("low=1") && distribution[1] == 'l';
        double const got = static_cast<double>(steps(distribution)) * (shifted ? 1.992 : 1);
        EXPECT_NEAR(got / wanted, 1, 0.01) << distribution;
    }
    for (char const* const distribution :
         {"\"triang\", low=-1, mode=2, high=3", "\"values\", values=[2, 0]", "\"weibull\", scale=3, shape=2, low=-1"}) {
        EXPECT_TRUE(contains(testing::error_of("schema = 1\n[study]\nkind = \"poincare\"\n[study.vary]\n"
                                               "\"mechanism.crank_speed\" = {dist=" +
                                               std::string(distribution) + "}"),
                             "mechanism.crank_speed may be 0"))
            << distribution;
    }
}

TEST(SceneChaos, ModesAreLocatedInEveryStudy) {
    auto const located = [](Scene const& scene) { return scene.integrator.locate_modes; };
    EXPECT_TRUE(located(study("lyapunov")));
    EXPECT_TRUE(located(sweep()));
    EXPECT_TRUE(located(sweep("exponents = 0")));
    EXPECT_TRUE(located(study("poincare")));
    EXPECT_TRUE(located(study("ensemble")));
    EXPECT_TRUE(located(study("tolerance", "design = \"mc\"\nmembers = 4\nquantities = [\"friction_loss\"]")));
    EXPECT_TRUE(located(study("ensemble", "[integrator]\nmethod = \"verner65\"")));
    EXPECT_FALSE(located(study("ensemble", "[integrator]\nmethod = \"ros34pw2\"")));
    EXPECT_FALSE(located(study("ensemble", "[contact]\nrestitution = 0.5")));
    EXPECT_FALSE(located(study("ensemble", "[contact]\nlaw = \"rigid\"\nrestitution = 0.5")));
    EXPECT_FALSE(located(study("ensemble", "[integrator]\nlocate_modes = false")));
    EXPECT_TRUE(study("ensemble", "[integrator]\nlocate_modes = false").warnings.empty());
    EXPECT_FALSE(located(study("lyapunov", "[contact]\nlaw = \"conservative\"")));
    EXPECT_FALSE(located(study("lyapunov", "[contact]\nrestitution = 0.5")));
    EXPECT_TRUE(located(study("lyapunov", "[integrator]\nlocate_modes = true")));
    EXPECT_TRUE(study("lyapunov").warnings.empty());
    EXPECT_TRUE(study("lyapunov", "[contact]\nlaw = \"conservative\"").warnings.empty());

    Scene const off = study("lyapunov", "[integrator]\nlocate_modes = false");
    EXPECT_FALSE(located(off));
    ASSERT_EQ(off.warnings.size(), 1u);
    EXPECT_TRUE(contains(off.warnings[0], "integrator.locate_modes is false")) << off.warnings[0];
    EXPECT_TRUE(contains(off.warnings[0], "exponents come out wrong"));
    Scene const fixed = study("lyapunov", "[integrator]\nmethod = \"rk4\"\nstep = 1e-6");
    EXPECT_FALSE(located(fixed));
    ASSERT_EQ(fixed.warnings.size(), 1u);
    EXPECT_TRUE(contains(fixed.warnings[0], "integrator.method is rk4")) << fixed.warnings[0];
}

TEST(SceneChaos, WhatSwitchesMakeIsKnownWhereStepsEndAtThem) {
    std::string const asked = "quantities = [\"switching_energy\"]\n";
    EXPECT_TRUE(study("poincare", asked).warnings.empty());
    EXPECT_TRUE(study("ensemble", asked).warnings.empty());
    EXPECT_TRUE(study("ensemble", asked + "[contact]\nlaw = \"conservative\"").warnings.empty()) << "zero";
    std::string const leapt = testing::error_of("schema = 1\n[study]\nkind = \"ensemble\"\n" + asked + "[integrator]\nlocate_modes = false");
    EXPECT_TRUE(contains(leapt, "study.quantities")) << leapt;
    EXPECT_TRUE(contains(leapt, "leave [integrator] to its defaults")) << leapt;
}

TEST(SceneChaos, FixedStepsLeaveRoomForStops) {
    auto const steps = [](std::string const& lines) {
        return study("lyapunov",
                     lines + "Ttr = 0\nduration = 1\ndt = 0.001\n[integrator]\nmethod = \"rk4\"\nstep = 0.01")
            .integrator.max_steps;
    };
    EXPECT_GE(steps(""), 1100u) << "a step ends at each of the 1000 stops";
}

TEST(SceneChaos, WarnsOfKeysWithoutEffect) {
    EXPECT_EQ(study("lyapunov", "exponents = 3\nd0_lower = 1e-8\nd0_upper = 1e-2").warnings,
              (std::vector<std::string>{
                  "study.d0_lower has no effect with several exponents: their neighbours are rescaled every time",
                  "study.d0_upper has no effect with several exponents: their neighbours are rescaled every time"}));
    EXPECT_EQ(sweep("exponents = 0\nd0 = 1e-5\nrescalings_per_revolution = 3").warnings,
              (std::vector<std::string>{"study.d0 has no effect with study.exponents = 0",
                                        "study.rescalings_per_revolution has no effect with study.exponents = 0"}));
}

TEST(SceneChaos, QuantitiesAreThere) {
    for (char const* kind : {"lyapunov", "poincare"}) {
        EXPECT_TRUE(selects(study(kind, "quantities = [\"mode_time\"]").quantities, Quantity::mode_time));
    }
}

TEST(SceneChaos, OptionsReplaceWhatSaysTheSame) {
    EXPECT_EQ(study("poincare", "phase = 1", {{"study.section", "{on=\"vy\"}"}}).chaos.section.on, On::state);
    EXPECT_EQ(study("poincare", "section = {on=\"vy\"}", {{"study.phase", "1"}}).chaos.section.on, On::phase);
    EXPECT_EQ(study("lyapunov", "Ttr = 1", {{"study.transient_revolutions", "3"}}).chaos.transient, turns(3));
    EXPECT_EQ(study("lyapunov", "transient_revolutions = 3", {{"study.Ttr", "1"}}).chaos.transient, seconds(1));
    EXPECT_EQ(study("lyapunov", "dt = 1", {{"study.rescalings_per_revolution", "3"}}).chaos.dt, turns(1.0 / 3));
    EXPECT_EQ(study("lyapunov", "rescalings_per_revolution = 3", {{"study.dt", "1"}}).chaos.dt, seconds(1));
    EXPECT_EQ(study("sweep", "parameter = \"initial.y\"\nfrom = 0\nto = 1e-5\npoints = 3\nspacing = \"linear\"",
                    {{"study.values", "[1e-5]"}})
                  .chaos.values,
              std::vector<double>{1e-5});
}

}  // namespace
}  // namespace slideway::chaos_test
