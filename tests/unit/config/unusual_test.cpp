// Numbers that are likelier slips of a unit, steps that come to no end, titles that are no title.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::unusual_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;
using Warnings = std::vector<std::string>;

Warnings warnings_of(std::string const& lines, Overrides const& overrides = {}) { return scene_of("schema = 1\n" + lines, overrides).warnings; }

TEST(UnusualNumbers, AreNamedWithWhatIsUsual) {
    EXPECT_EQ(warnings_of("[joint]\nclearance = 1"),
              Warnings{"scene.toml:3: joint.clearance is 1 m (usually 1e-08 to 0.01 m); did you mean \"1 mm\"?"});
    EXPECT_EQ(warnings_of("[contact]\nway_young_modulus = 1e300"),
              Warnings{"scene.toml:3: contact.way_young_modulus is 1e+300 Pa (usually 100000 to 1e+13 Pa); is its unit right?"});
    EXPECT_EQ(warnings_of("[contact]\nyoung_modulus = 207"),
              Warnings{"scene.toml:3: contact.young_modulus is 207 Pa (usually 100000 to 1e+13 Pa); did you mean \"207 GPa\"?"});
    EXPECT_EQ(warnings_of("[mechanism]\nkind = \"free_slider\"\n[initial]\nvx = -3000"),
              Warnings{"scene.toml:5: initial.vx is -3000 m/s (usually within ±1000 m/s); did you mean \"-3000 mm/s\"?"});
    EXPECT_EQ(warnings_of("[friction]\nkinetic = 4"), Warnings{"scene.toml:3: friction.kinetic is 4 (usually up to 3); is its unit right?"});
    EXPECT_EQ(warnings_of("[mechanism]\ncrank_length = 50\nrod_length = 142.2").size(), 2u);
    EXPECT_EQ(warnings_of("", {{"mechanism.start_angle", "\"720 deg\""}}), Warnings{});
    EXPECT_EQ(warnings_of("", {{"mechanism.crank_speed", "\"200000 rpm\""}}),
              Warnings{"--set mechanism.crank_speed=\"200000 rpm\": mechanism.crank_speed is 20943.951023931953 rad/s (usually within ±10000 rad/s); is it meant?"});
    EXPECT_EQ(warnings_of("", {{"mechanism.start_angle", "90"}}),
              Warnings{"--set mechanism.start_angle=90: mechanism.start_angle is 90 rad (usually within ±10 rad); did you mean \"90 deg\"?"});
}

TEST(UnusualNumbers, OfMassesAndSpeedsToo) {
    for (char const* const lines : {"[mechanism]\nslider_mass = 1e7", "[mechanism]\nrod_inertia = 1e9", "[mechanism]\ncrank_speed = 30000", "[way]\nyaw = 5",
                                    "[contact]\nedge_radius = 50", "[friction]\nstick_speed = 20\nslip_speed = 100", "[initial]\nwz = 1e6", "[mechanism]\ngravity = 9810",
                                    "[contact]\nchi_line = 1e9"}) {
        EXPECT_FALSE(warnings_of(lines).empty()) << lines;
    }
    EXPECT_TRUE(warnings_of("[friction]\nstatic = 3\nkinetic = 3\n[joint]\nclearance = 1e-3\n[contact]\nyoung_modulus = 1e13\n[initial]\nvy = 1000").empty()) << "ends are usual";
}

TEST(UnusualNumbers, MayBeSoTogether) {
    EXPECT_EQ(warnings_of("[joint]\nclearance = \"5 mm\""),
              Warnings{"scene.toml:3: joint.clearance_y is 0.005 m (usually less than a tenth of the way, 0.002 m); is its unit right?"});
    EXPECT_EQ(warnings_of("[joint]\nway_width = \"0.5 mm\""),
              Warnings{"scene.toml:1: joint.clearance_y is 0.0001 m (usually less than a tenth of the way, 5e-05 m); is its unit right?"});
    EXPECT_EQ(warnings_of("[mechanism]\ncrank_speed = 5000\ncrank_length = 1\nrod_length = 3"),
              Warnings{"scene.toml:3: mechanism.crank_speed is 5000 rad/s (the crank pin then moves at 5000 m/s, usually up to 1000 m/s); is its unit right?"});
}

TEST(UnusualNumbers, OfFrictionAndInertiaAreToldOfEachOther) {
    EXPECT_EQ(warnings_of("[friction]\nkinetic = 0.2"), Warnings{"scene.toml:3: friction.kinetic is 0.2 (usually not above friction.static, 0.15); give both"});
    EXPECT_TRUE(warnings_of("[friction]\nstatic = 0.2\nkinetic = 0.2").empty());
    auto const inertia = [](char const* x) { return warnings_of(std::string("[mechanism]\nslider_inertia_x = ") + x + "\nslider_inertia_y = 1e-5\nslider_inertia_z = 1e-5"); };
    EXPECT_EQ(inertia("2.1e-5"), Warnings{"scene.toml:3: mechanism.slider_inertia_x is 2.1e-05 kg m2 (a rigid body has at most the sum of the other two, 2e-05 kg m2)"});
    EXPECT_TRUE(inertia("2e-5").empty());
}

TEST(UnusualNumbers, OfDrawsAndColumnsOfASweep) {
    auto const drawn = [](std::string const& distribution) { return warnings_of("[study.vary]\n\"joint.clearance\" = " + distribution); };
    std::string const expected = "scene.toml:3: a value of study.vary.joint.clearance is 0.1 m (usually 1e-08 to 0.01 m); did you mean \"0.1 mm\"?";
    for (char const* const distribution :
         {"{dist=\"const\", value=0.1}", "{dist=\"norm\", mean=0.1, sd=0.01}", "{dist=\"unif\", low=1e-4, high=0.1}", "{dist=\"triang\", low=1e-4, mode=2e-4, high=0.1}",
          "{dist=\"lognorm\", mean=0.1, sd=0.01}", "{dist=\"weibull\", scale=0.1, shape=2}", "{dist=\"values\", values=[1e-4, 0.1]}",
          "{dist=\"truncnorm\", mean=0.1, sd=0.01, low=1e-4, high=1}"}) {
        EXPECT_EQ(drawn(distribution), Warnings{expected}) << distribution;
    }
    EXPECT_TRUE(drawn("{dist=\"truncnorm\", mean=1e-4, sd=1e-5, low=1e-7, high=1e-3}").empty());
    EXPECT_EQ(warnings_of("[study]\nkind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4, 0.2, 0.3]\nexponents = 0"),
              Warnings{"scene.toml:5: a value of joint.clearance is 0.2 m (usually 1e-08 to 0.01 m); did you mean \"0.2 mm\"?"});
}

TEST(UnusualNumbers, OfTheFirstRowOfATable) {
    testing::TableFolder const folder;
    std::string const lines = "[mechanism]\nkind = \"free_slider\"\n[contact]\nlaw = \"paper\"\n[study]\ndesign = \"table\"\ntable = \"a.csv\"\nduration = \"1 ms\"\n";
    folder.write("a.csv", "part,joint.clearance,initial.vx\na,1e-4,1\nb,0.1,1\nc,0.2,5000\n");
    Warnings warnings = folder.read(lines).warnings;
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_TRUE(contains(warnings[0], "a.csv:3: joint.clearance is 0.1 m (usually 1e-08 to 0.01 m); did you mean \"0.1 mm\"?")) << warnings[0];
    EXPECT_TRUE(contains(warnings[1], "a.csv:4: initial.vx is 5000 m/s")) << warnings[1];
    folder.write("a.csv", "joint.clearance [mm]\n1\n2.5\n");
    warnings = folder.read(lines).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(contains(warnings[0], "a.csv:3: joint.clearance_y is 0.0025 m (usually less than a tenth of the way, 0.002 m)")) << warnings[0];
}

TEST(UnusualNumbers, AreInNoSceneThatComesWithTheProgram) {
    int scenes = 0;
    for (auto const& entry : std::filesystem::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() != ".toml") continue;
        ++scenes;
        for (std::string const& warning : read_scene(entry.path().string()).warnings) EXPECT_FALSE(contains(warning, "usually")) << warning;
    }
    EXPECT_GT(scenes, 20);
}

TEST(UnusualNumbers, AreNoDefaults) {
    for (Parts const& parts : testing::mechanisms_and_laws()) {
        Inputs const inputs = with_presets({}, parts.law);
        EXPECT_FALSE(unusual_pair(inputs, parts));
        for (Key const& key : keys()) {
            bool const is_unusual = unusual(key, key.get(inputs)) && !std::isnan(key.get(inputs));
            EXPECT_FALSE(counts_for(key, parts) && is_unusual) << key.name;
        }
    }
}

std::string error_with(std::string const& integrator, std::string const& study = "duration = 1") {
    return error_of("schema = 1\n[integrator]\n" + integrator + "\n[study]\n" + study);
}

TEST(Steps, WithoutAnEndAreRefusedWithTheirNumber) {
    EXPECT_EQ(error_with("max_step = 1e-300"), "scene.toml:3: integrator.max_step is 1e-300 (a member would take 1e+300 steps or more); use a value >= 1e-15 s");
    EXPECT_EQ(error_with("stiff_max_step = \"1e-20 s\"", "duration = 100"),
              "scene.toml:3: integrator.stiff_max_step is \"1e-20 s\" (a member would take 1e+22 steps or more); use a value >= 1e-13 s");
    EXPECT_TRUE(contains(error_with("method = \"dopri5\"\nmax_step = 1e-17"), "integrator.max_step is 1e-17 (a member would take 1e+17 steps or more)"));
    EXPECT_TRUE(contains(error_with("method = \"rk4\"\nstep = 1e-300"), "integrator.step is 1e-300 (that makes 1e+300 steps)"));
    EXPECT_EQ(error_with("method = \"dopri5\"\nmax_step = 1e-3\nmax_steps = 999"),
              "scene.toml:5: integrator.max_steps is 999 (a member takes 1000 steps or more); use a larger one, or larger steps");
    EXPECT_EQ(error_with("method = \"dopri5\"\nmax_step = 1e-3\nmax_steps = 1000"), "");
    EXPECT_EQ(error_with("max_step = 1e-14"), "");
    EXPECT_TRUE(contains(error_of("schema = 1\n[study]\nkind = \"lyapunov\"\nduration = 1\nTtr = 0\ndt = 1e-300"), "study.dt is 1e-300 (that makes 1e+300 rescalings)"));
}

TEST(Steps, FollowFromTheDriveToo) {
    std::string const error = error_of("schema = 1\n[mechanism]\ncrank_speed = 1e20\n[study]\nduration = 1");
    EXPECT_TRUE(contains(error, "scene.toml:5: integrator.max_step follows from the drive and is ")) << error;
    EXPECT_TRUE(contains(error, "steps or more); shorten study.duration, slow the drive down, or give integrator.max_step")) << error;
}

TEST(Steps, ThatLastForHoursAreWarnedOf) {
    EXPECT_EQ(scene_of("schema = 1\n[integrator]\nmax_step = 1e-12\n[study]\nduration = 1").warnings,
              Warnings{"integrator.max_step is 1e-12 s: a member takes 1e+11 steps or more"});
}

TEST(Samples, OfATimeWithoutRoomAreRefused) {
    EXPECT_TRUE(contains(error_with("", "duration = 1e-310\nsamples = 1000"), "study.samples is 1000 (no numbers tell the times of 1e-310 s apart)"));
}

TEST(Titles, HaveAThousandCharacters) {
    auto const titled = [](std::string const& title) { return "schema = 1\ntitle = \"" + title + "\""; };
    std::string many;
    for (int i = 0; i < 1000; ++i) many += "\xc3\xa9";  // é
    EXPECT_EQ(error_of(titled(std::string(1000, 'a'))), "");
    EXPECT_EQ(scene_of(resolved_toml(scene_of(titled(many)))).title, many);
    std::string const error = error_of(titled(std::string(1001, 'a')));
    EXPECT_TRUE(contains(error, "scene.toml:2: title is \"aaa")) << error;
    EXPECT_TRUE(contains(error, "(1001 characters); use at most 1000 characters, and put notes into comments")) << error;
    EXPECT_LT(error.size(), 250u);
    // Each of them is six bytes of the resolved scene, whose lines have a longest length.
    std::string controls;
    for (int i = 0; i < 680; ++i) controls += "\\u0001";
    EXPECT_TRUE(contains(error_of("schema = 1\n", {{"title", "\"" + controls + "\""}}), "(more than 4000 bytes as a line of a scene)"));
}

}  // namespace
}  // namespace slideway::unusual_test
