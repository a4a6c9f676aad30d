#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::reader_test {
namespace {

using testing::scene_of;
constexpr double pi = std::numbers::pi;

TEST(Scene, TheContractsExampleReads) {
    Scene const scene = scene_of(R"(schema = 1
title  = "Slider-crank, 0.1 mm clearance"
[mechanism]
kind = "slider_crank"
crank_length = "50 mm"
rod_length = "142.2 mm"
crank_speed = "3.141592653589793 rad/s"
gravity = 9.81
inclination = "0 deg"
[joint]
clearance = "0.1 mm"
[contact]
law = "paper"
eta = 0.01
chi_line = 0.0
chi_surface = 0.0
[friction]
static = 0.15
kinetic = 0.10
stick_speed = "1 mm/s"
slip_speed = "10 mm/s"
[initial]
z = "0.01 mm"
[integrator]
method = "auto"
rtol = 1e-6
atol = 1e-6
[study]
kind = "ensemble"
members = 1024
seed = 1
revolutions = 2
samples_per_revolution = 200
quantities = ["peak_normal_force", "energy_residual", "mode_time"]
[study.vary]
"joint.clearance" = { dist = "truncnorm", mean = "0.1 mm", sd = "0.01 mm", low = "0.05 mm", high = "0.15 mm" }
"initial.y"       = { dist = "unif", low = "-0.05 mm", high = "0.05 mm" }
)");
    EXPECT_EQ(scene.title, "Slider-crank, 0.1 mm clearance");
    EXPECT_EQ(scene.parts.mechanism, Mechanism::slider_crank);
    EXPECT_EQ(scene.inputs.rod_length, 0.1422);
    EXPECT_EQ(scene.inputs.crank_speed, pi);
    EXPECT_EQ(scene.inputs.clearance_y, 1e-4);
    EXPECT_EQ(scene.inputs.clearance_z, 1e-4);
    EXPECT_EQ(scene.inputs.z, 1e-5);
    EXPECT_EQ(scene.inputs.friction_slip_speed, 0.01);
    EXPECT_TRUE(std::isnan(scene.inputs.slider_mass));
    EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
    EXPECT_EQ(scene.integrator.method, Method::automatic);
    EXPECT_EQ(scene.integrator.rtol, 1e-6);
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 4);      // two turns at half a turn per second
    EXPECT_DOUBLE_EQ(scene.integrator.max_step, 1e-3);   // 2 s / 2000
    EXPECT_EQ(scene.integrator.max_steps, 50'008'000u);  // 1e7 + 1e7 per second + twice the longest steps
    EXPECT_EQ(scene.members, 1024u);
    ASSERT_EQ(scene.sample_times.size(), 401u);
    EXPECT_EQ(scene.sample_times.front(), 0);
    EXPECT_DOUBLE_EQ(scene.sample_times[1], 0.01);
    EXPECT_EQ(scene.sample_times.back(), scene.integrator.end_time);
    EXPECT_EQ(scene.quantities, (1u << static_cast<int>(Quantity::peak_normal_force)) |
                                    (1u << static_cast<int>(Quantity::energy_residual)) |
                                    (1u << static_cast<int>(Quantity::mode_time)));
    EXPECT_EQ(scene.series, 0x3ffu);
    ASSERT_EQ(scene.variations.size(), 2u);
    EXPECT_EQ(scene.variations[0].key->name, "joint.clearance");
    EXPECT_EQ(scene.variations[0].line, 36);
    EXPECT_EQ(scene.variations[0].distribution.kind, Distribution::Kind::truncated_normal);
    EXPECT_EQ(scene.variations[0].distribution.sd, 1e-5);
    EXPECT_EQ(scene.variations[0].distribution.high, 1.5e-4);
    EXPECT_EQ(scene.variations[1].key->name, "initial.y");
    EXPECT_EQ(scene.variations[1].distribution.low, -5e-5);
}

TEST(Scene, TheSchemaAloneIsTheDefaultMechanism) {
    Scene const scene = scene_of("schema = 1");
    EXPECT_EQ(scene.inputs.crank_length, 0.05);
    EXPECT_EQ(scene.parts, Parts{});
    EXPECT_EQ(scene.members, 1u);
    EXPECT_DOUBLE_EQ(scene.integrator.end_time, 2);
    EXPECT_TRUE(scene.sample_times.empty());
    EXPECT_EQ(scene.series, 0u);
}

TEST(Scene, PartsAreInOnlyWhereTheSceneNeedsThem) {
    auto const parts = [](std::string_view text) { return scene_of("schema = 1\n" + std::string(text)).parts; };
    EXPECT_TRUE(parts("[friction]").friction);
    EXPECT_FALSE(parts("[friction]\nenabled = false").friction);
    EXPECT_TRUE(parts("[friction]\nenabled = true").friction);
    EXPECT_TRUE(parts("[way]").misaligned_way);
    EXPECT_TRUE(parts("[way]\nroll = \"1 mrad\"").misaligned_way);
    EXPECT_FALSE(parts("[joint]").misaligned_way);
    EXPECT_EQ(parts("[contact]\nchi_line = 0.0").damping, Damping::point);
    EXPECT_EQ(parts("[contact]\nchi_surface = 0.1").damping, Damping::rate);
    EXPECT_EQ(parts("[contact]\nrestitution = 0.4").damping, Damping::restitution);
    EXPECT_EQ(parts("[contact]\nlaw = \"conservative\"").law, Law::conservative);
}

TEST(Scene, VariedKeysBringTheirParts) {
    auto const parts = [](std::string_view entry) {
        return scene_of("schema = 1\n[study.vary]\n" + std::string(entry)).parts;
    };
    EXPECT_TRUE(parts("\"way.pitch\" = {dist=\"unif\", low=0, high=1e-3}").misaligned_way);
    EXPECT_EQ(parts("\"contact.chi_line\" = {dist=\"unif\", low=0, high=0.1}").damping, Damping::rate);
    EXPECT_EQ(parts("\"contact.restitution\" = {dist=\"unif\", low=0.2, high=0.9}").damping, Damping::restitution);
    EXPECT_EQ(parts("\"initial.y\" = {dist=\"const\", value=0}"), Parts{});
}

TEST(Scene, ClearancesCanDiffer) {
    Scene const scene = scene_of("schema = 1\n[joint]\nclearance_y = \"0.2 mm\"\nclearance_z = 3e-4");
    EXPECT_EQ(scene.inputs.clearance_y, 2e-4);
    EXPECT_EQ(scene.inputs.clearance_z, 3e-4);
}

TEST(Scene, IntegersAreNumbers) {
    EXPECT_EQ(scene_of("schema = 1\n[mechanism]\ngravity = 10").inputs.gravity, 10);
    EXPECT_EQ(scene_of("schema = 1\n[study]\nmembers = 1e3").members, 1000u);
}

TEST(Scene, DurationAndSamplesReplaceRevolutions) {
    Scene const scene = scene_of("schema = 1\n[study]\nduration = \"300 ms\"\nsamples = 4");
    EXPECT_EQ(scene.integrator.end_time, 0.3);
    ASSERT_EQ(scene.sample_times.size(), 4u);
    EXPECT_DOUBLE_EQ(scene.sample_times[1], 0.1);
    EXPECT_EQ(scene.sample_times[3], 0.3);
    // 0.3 s of a 2 s revolution at 200 samples per revolution are 30 intervals
    EXPECT_EQ(scene_of("schema = 1\n[study]\nduration = 0.3\nsamples_per_revolution = 200").sample_times.size(), 31u);
    EXPECT_TRUE(scene_of("schema = 1\n[study]\nduration = 0.3\nsamples_per_revolution = 0").sample_times.empty());
}

TEST(Scene, SamplesEndExactlyAtTheEnd) {
    for (int i = 1; i < 40; ++i) {
        Overrides const overrides = {{"study.duration", std::to_string(0.0123 * i)},
                                     {"study.samples", std::to_string(2 + i)}};
        Scene const scene = scene_of("schema = 1", overrides);
        ASSERT_EQ(scene.sample_times.size(), 2u + static_cast<unsigned>(i));
        EXPECT_EQ(scene.sample_times.back(), scene.integrator.end_time);
        EXPECT_TRUE(std::is_sorted(scene.sample_times.begin(), scene.sample_times.end()));
    }
}

TEST(Scene, TheCrankMayStandOrTurnBackwards) {
    Scene const still = scene_of("schema = 1\n[mechanism]\ncrank_speed = 0");
    EXPECT_EQ(still.integrator.end_time, 1);
    EXPECT_EQ(still.integrator.max_step, 1e-3);
    Scene const back = scene_of("schema = 1\n[mechanism]\ncrank_speed = \"-60 rpm\"");
    EXPECT_DOUBLE_EQ(back.integrator.end_time, 1);
    EXPECT_DOUBLE_EQ(back.integrator.max_step, 5e-4);
}

TEST(Scene, ExtremesOfThePhysicsAreAccepted) {
    EXPECT_NO_THROW(
        scene_of("schema = 1\n[joint]\nclearance = 1e-7\n[mechanism]\ncrank_speed = 500\n"
                 "[contact]\nyoung_modulus = 1e13\n[initial]\ny = 1\n[friction]\nstatic = 2\nkinetic = 0"));
}

TEST(Scene, SeriesAreChosenByName) {
    Scene const scene = scene_of("schema = 1\n[study]\nsamples = 2\nquantities = [\"normal_force\", \"y\"]");
    EXPECT_EQ(scene.quantities, 0u);
    EXPECT_EQ(scene.series, 0x3ffu | (1u << static_cast<int>(Series::normal_force)));
}

TEST(Scene, VariedKeysNeedNoQuotes) {
    Scene const scene = scene_of(
        "schema = 1\n[study.vary]\njoint.clearance = {dist=\"const\", value=\"1 mm\"}\n"
        "initial.y = {dist=\"const\", value=0}\ninitial.z = {dist=\"const\", value=0}");
    ASSERT_EQ(scene.variations.size(), 3u);
    EXPECT_EQ(scene.variations[0].key->name, "joint.clearance");
    EXPECT_EQ(scene.variations[2].key->name, "initial.z");
}

TEST(Override, TakesNumbersTextsAndBareWords) {
    auto const inputs = [](char const* value) {
        return scene_of("schema = 1\n[joint]\nclearance = 1", {{"joint.clearance", value}}).inputs.clearance_z;
    };
    EXPECT_EQ(inputs("2e-4"), 2e-4);
    EXPECT_EQ(inputs("0.2 mm"), 2e-4);
    EXPECT_EQ(inputs("\"0.2 mm\""), 2e-4);
    EXPECT_EQ(inputs(".0002"), 2e-4);
    EXPECT_EQ(inputs("+2.e-4"), 2e-4);
    EXPECT_EQ(inputs("0.12345678901234567"), 0.12345678901234567);
    EXPECT_EQ(scene_of("schema = 1", {{"contact.law", "conservative"}}).parts.law, Law::conservative);
    EXPECT_TRUE(scene_of("schema = 1", {{"friction.enabled", "true"}}).parts.friction);
    EXPECT_EQ(scene_of("schema = 1", {{"title", "a \"b\" \\ c"}}).title, "a \"b\" \\ c");
}

TEST(Override, TakesAnyKey) {
    Scene const scene = scene_of("schema = 1\n[study]\nmembers = 3",
                                 {{"study.members", "7"},
                                  {"study.quantities", "[\"peak_tilt\"]"},
                                  {"integrator.rtol", "1e-8"},
                                  {"study.vary.\"initial.y\"", "{dist=\"unif\", low=-1e-5, high=1e-5}"},
                                  {"study.vary.\"initial.y\".high", "2e-5"}});
    EXPECT_EQ(scene.members, 7u);
    EXPECT_EQ(scene.quantities, 1u << static_cast<int>(Quantity::peak_tilt));
    EXPECT_EQ(scene.integrator.rtol, 1e-8);
    ASSERT_EQ(scene.variations.size(), 1u);
    EXPECT_EQ(scene.variations[0].distribution.low, -1e-5);
    EXPECT_EQ(scene.variations[0].distribution.high, 2e-5);
}

TEST(Override, TheLastOneWins) {
    EXPECT_EQ(scene_of("schema = 1", {{"study.members", "7"}, {"study.members", "8"}}).members, 8u);
    Scene const scene = scene_of("schema = 1", {{"joint.clearance_y", "1e-3"}, {"joint.clearance", "2e-4"}});
    EXPECT_EQ(scene.inputs.clearance_y, 2e-4);
    Scene const refined = scene_of("schema = 1\n[joint]\nclearance = 3e-4", {{"joint.clearance_y", "1e-3"}});
    EXPECT_EQ(refined.inputs.clearance_y, 1e-3);
    EXPECT_EQ(refined.inputs.clearance_z, 3e-4);
}

TEST(Override, MakesRivalsInTheFileVoid) {
    EXPECT_EQ(scene_of("schema = 1\n[joint]\nclearance_y = 1e-3", {{"joint.clearance", "2e-4"}}).inputs.clearance_y,
              2e-4);
    EXPECT_EQ(scene_of("schema = 1\n[contact]\neta = 0.1", {{"contact.restitution", "0.4"}}).parts.damping,
              Damping::restitution);
    EXPECT_EQ(scene_of("schema = 1\n[study]\nrevolutions = 2", {{"study.duration", "0.5"}}).integrator.end_time, 0.5);
    EXPECT_EQ(scene_of("schema = 1\n[study]\nsamples_per_revolution = 9", {{"study.samples", "5"}}).sample_times.size(),
              5u);
}

}  // namespace
}  // namespace slideway::reader_test
