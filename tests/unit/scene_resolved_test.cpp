#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/scene_fixture.hpp"

namespace slideway {
namespace {

using testing::contains;
using testing::scene_of;

void expect_equal(Distribution const& a, Distribution const& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.sd, b.sd);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
}

void expect_equal(Scene const& a, Scene const& b) {
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.mechanism, b.mechanism);
    for (Key const& key : keys()) {
        double const x = key.get(a.inputs), y = key.get(b.inputs);
        EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << key.name << ": " << x << " and " << y;
        EXPECT_EQ(std::signbit(x), std::signbit(y)) << key.name;
    }
    EXPECT_EQ(a.parts, b.parts);
    EXPECT_EQ(a.integrator.method, b.integrator.method);
    EXPECT_EQ(a.integrator.rtol, b.integrator.rtol);
    EXPECT_EQ(a.integrator.atol, b.integrator.atol);
    EXPECT_EQ(a.integrator.end_time, b.integrator.end_time);
    EXPECT_EQ(a.integrator.max_step, b.integrator.max_step);
    EXPECT_EQ(a.integrator.stiff_tolerance, b.integrator.stiff_tolerance);
    EXPECT_EQ(a.integrator.stiff_max_step, b.integrator.stiff_max_step);
    EXPECT_EQ(a.integrator.fixed_step, b.integrator.fixed_step);
    EXPECT_EQ(a.integrator.locate_modes, b.integrator.locate_modes);
    EXPECT_EQ(a.integrator.max_steps, b.integrator.max_steps);
    EXPECT_EQ(a.study, b.study);
    EXPECT_EQ(a.members, b.members);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.sample_times, b.sample_times);
    EXPECT_EQ(a.quantities, b.quantities);
    EXPECT_EQ(a.series, b.series);
    ASSERT_EQ(a.variations.size(), b.variations.size());
    for (std::size_t i = 0; i < a.variations.size(); ++i) {
        EXPECT_EQ(a.variations[i].key, b.variations[i].key);
        expect_equal(a.variations[i].distribution, b.variations[i].distribution);
    }
}

void expect_round_trip(std::string_view text) {
    Scene const scene = scene_of(text);
    std::string const resolved = resolved_toml(scene);
    Scene const again = scene_of(resolved);
    expect_equal(scene, again);
    EXPECT_EQ(resolved_toml(again), resolved);
}

TEST(ResolvedScene, DefaultsReadBack) { expect_round_trip("schema = 1"); }

TEST(ResolvedScene, EverythingReadsBack) {
    expect_round_trip(R"(schema = 1
title = "quotes \" backslash \\ newline \n tab \t del \u007f µ"
[mechanism]
crank_length = 0.051234567890123456
rod_length = "7 inch"
crank_speed = "-33.3 rpm"
start_angle = "77 deg"
gravity = -0.0
inclination = "-30 deg"
slider_mass = "1 lb"
rod_mass_center = 0.3
[joint]
clearance_y = "0.1234567 mm"
clearance_z = 1e-7
thickness_z = 0.01
[way]
offset_y = 1e-5
yaw = "1 arcsec"
[contact]
law = "conservative"
eta = 0.003
chi_line = 0.1
young_modulus = 3e10
slider_poisson_ratio = 0.1
hertz_exponent = 1.4
[friction]
static = 0.21
[initial]
y = -1e-5
wz = "1 rpm"
[integrator]
rtol = 3e-9
atol = 7e-10
max_step = "0.1 ms"
max_steps = 123456789012
[study]
members = 77
seed = 9223372036854775807
revolutions = 1.234567
samples_per_revolution = 33
quantities = ["mode_time", "lines", "peak_tilt", "x"]
[study.vary]
"initial.z" = { dist = "norm", mean = 0, sd = "0.01 mm" }
"joint.slider_length" = { dist = "unif", low = "39 mm", high = "41 mm" }
"contact.eta" = { dist = "truncnorm", mean = 0.01, sd = 0.01, low = 0, high = 0.02 }
"way.roll" = { dist = "const", value = "1 deg" }
)");
}

TEST(ResolvedScene, RestitutionReadsBack) {
    expect_round_trip("schema = 1\n[contact]\nrestitution = 0.4\n[friction]\nenabled = false\nstatic = 0.3\n[way]\n"
                      "[study]\nduration = 0.1\nsamples = 7");
    expect_round_trip("schema = 1\n[study.vary]\n\"contact.restitution\" = {dist=\"unif\", low=0.1, high=1}\n"
                      "\"contact.young_modulus\" = {dist=\"unif\", low=1e9, high=1e10}");
}

TEST(ResolvedScene, NumbersAreInSiUnits) {
    std::string const text = resolved_toml(scene_of("schema = 1\n[joint]\nclearance = \"0.1 mm\"\n[mechanism]\n"
                                                    "crank_speed = \"3.141592653589793 rad/s\""));
    EXPECT_TRUE(contains(text, "clearance_y = 0.0001  # m\n"));
    EXPECT_TRUE(contains(text, "crank_speed = 3.141592653589793  # rad/s\n"));
    EXPECT_TRUE(contains(text, "method = \"auto\"\n"));
    EXPECT_TRUE(contains(text, "# slider_mass = 0.1872  # kg, follows from other keys\n"))  << text;
}

TEST(ResolvedScene, WhatFollowsStillFollowsWhenItsSourceVaries) {
    Scene const scene = scene_of(resolved_toml(scene_of(
        "schema = 1\n[study.vary]\n\"mechanism.slider_mass\" = {dist=\"const\", value=0.3744}")));
    EXPECT_NEAR(member_inputs(scene, 0).slider_inertia_x, 2 * 2.028e-5, 1e-18);
}

}  // namespace
}  // namespace slideway
