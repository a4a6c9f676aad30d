#include <cmath>

#include <gtest/gtest.h>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::resolved_test {
namespace {

using testing::contains;
using testing::scene_of;

void expect_equal(Distribution const& a, Distribution const& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.sd, b.sd);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_EQ(a.mode, b.mode);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.list, b.list);
}

void expect_equal(Design const& a, Design const& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.base, b.base);
    EXPECT_EQ(a.levels, b.levels);
    EXPECT_EQ(a.correlation.variations, b.correlation.variations);
    EXPECT_EQ(a.correlation.matrix, b.correlation.matrix);
    ASSERT_EQ(a.table == nullptr, b.table == nullptr);
    if (a.table == nullptr) return;
    EXPECT_EQ(a.table->path, b.table->path);
    EXPECT_EQ(a.table->checksum, b.table->checksum);
    EXPECT_EQ(a.table->columns, b.table->columns);
    EXPECT_EQ(a.table->values, b.table->values);
}

void expect_equal(Scene const& a, Scene const& b) {
    EXPECT_EQ(a.title, b.title);
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
    EXPECT_EQ(a.chaos.transient, b.chaos.transient);
    EXPECT_EQ(a.chaos.span, b.chaos.span);
    EXPECT_EQ(a.chaos.section, b.chaos.section);
    EXPECT_EQ(a.chaos.max_crossings, b.chaos.max_crossings);
    EXPECT_EQ(a.chaos.exponents, b.chaos.exponents);
    EXPECT_EQ(a.chaos.d0, b.chaos.d0);
    EXPECT_EQ(a.chaos.d0_lower, b.chaos.d0_lower);
    EXPECT_EQ(a.chaos.d0_upper, b.chaos.d0_upper);
    EXPECT_EQ(a.chaos.dt, b.chaos.dt);
    EXPECT_EQ(a.chaos.history, b.chaos.history);
    EXPECT_EQ(a.chaos.parameter, b.chaos.parameter);
    EXPECT_EQ(a.chaos.values, b.chaos.values);
    EXPECT_EQ(a.chaos.continued, b.chaos.continued);
    EXPECT_EQ(a.members, b.members);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.sample_times, b.sample_times);
    EXPECT_EQ(a.quantities, b.quantities);
    EXPECT_EQ(a.series, b.series);
    ASSERT_EQ(a.variations.size(), b.variations.size());
    for (std::size_t i = 0; i < a.variations.size(); ++i) {
        EXPECT_EQ(a.variations[i].key, b.variations[i].key);
        EXPECT_EQ(a.variations[i].column, b.variations[i].column);
        expect_equal(a.variations[i].distribution, b.variations[i].distribution);
    }
    expect_equal(a.design, b.design);
    ASSERT_EQ(a.limits.size(), b.limits.size());
    for (std::size_t i = 0; i < a.limits.size(); ++i) {
        EXPECT_EQ(a.limits[i].name(), b.limits[i].name());
        EXPECT_EQ(a.limits[i].low, b.limits[i].low);
        EXPECT_EQ(a.limits[i].high, b.limits[i].high);
    }
}

void expect_round_trip(Scene const& scene) {
    std::string const resolved = resolved_toml(scene);
    Scene const again = scene_of(resolved);
    expect_equal(scene, again);
    EXPECT_EQ(resolved_toml(again), resolved);
}

void expect_round_trip(std::string_view text) { expect_round_trip(scene_of(text)); }

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
    expect_round_trip(
        "schema = 1\n[contact]\nrestitution = 0.4\n[friction]\nenabled = false\nstatic = 0.3\n[way]\n"
        "[study]\nduration = 0.1\nsamples = 7");
    expect_round_trip(
        "schema = 1\n[study.vary]\n\"contact.restitution\" = {dist=\"unif\", low=0.1, high=1}\n"
        "\"contact.young_modulus\" = {dist=\"unif\", low=1e9, high=1e10}");
}

void expect_study_round_trip(std::string_view study, std::string_view lines) {
    SCOPED_TRACE(study);
    SCOPED_TRACE(lines);
    expect_round_trip("schema = 1\n[study]\nkind = \"" + std::string(study) + "\"\n" + std::string(lines));
}

TEST(ResolvedScene, StudiesOfChaosReadBack) {
    for (char const* lines :
         {"", "phase = \"77 deg\"\nTtr = 0.1\nduration = 7.3\nmembers = 3\nseed = 4", "revolutions = 0.3",
          "section = {on=\"wy\", value=\"1 rpm\", direction=\"both\"}\nmax_crossings = 3\ntransient_revolutions = 0",
          "section = {on=\"gap_z[P8]\", value=-1e-7, direction=\"falling\"}\n[mechanism]\ncrank_speed = 0",
          "section = {on=\"impacts\", direction=\"rising\"}\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5",
          "section = {on=\"gap_y[P1]\"}\nquantities = [\"mode_time\"]"}) {
        expect_study_round_trip("poincare", lines);
    }
    for (char const* lines :
         {"", "exponents = 10\nd0 = 3e-7\nd0_lower = 1e-9", "d0 = 3e-7\nd0_lower = 1e-9\nd0_upper = 0.7\nhistory = 0",
          "rescalings_per_revolution = 49\nrevolutions = 0.37", "dt = \"3 ms\"\nduration = 1\nTtr = 0",
          "[mechanism]\ncrank_speed = 0", "[integrator]\nlocate_modes = false", "[contact]\nrestitution = 0.5",
          "[contact]\nlaw = \"conservative\"", "[integrator]\nmethod = \"rk4\"\nstep = 1e-5"}) {
        expect_study_round_trip("lyapunov", lines);
    }
    for (
        char const* lines :
        {"parameter = \"joint.clearance\"\nvalues = [\"0.1 mm\", 1e-3, \"7 um\"]",
         "parameter = \"mechanism.crank_speed\"\nfrom = \"30 rpm\"\nto = \"-60 rpm\"\npoints = 8\nstart = \"continue\"",
         "parameter = \"contact.young_modulus\"\nfrom = 1e9\nto = 1e11\npoints = 10000\nspacing = \"log\"\nexponents = "
         "0",
         "parameter = \"way.roll\"\nvalues = [-0.0, 1]\nexponents = 3\nd0 = 1e-4\nrescalings_per_revolution = 20",
         "parameter = \"contact.restitution\"\nvalues = [0.3]\nTtr = 3\nphase = 7",
         "parameter = \"contact.chi_line\"\nvalues = [0, 0.1]\nexponents = 0\nd0 = 1e-3\nrescalings_per_revolution = 3",
         "parameter = \"friction.static\"\nvalues = [0, 0.1]\n[friction]\n[study.vary]\n\"initial.y\" = "
         "{dist=\"unif\", low=0, high=1e-5}"}) {
        expect_study_round_trip("sweep", lines);
    }
}

std::string const drawn_keys =
    "\n[study.vary]\n\"initial.y\" = {dist=\"triang\", low=\"-1 um\", mode=0, high=\"2 um\"}\n"
    "\"joint.clearance\" = {dist=\"lognorm\", mean=\"0.1 mm\", sd=\"7 um\"}\n"
    "\"initial.vy\" = {dist=\"lognorm\", mean=1, sd=2, low=-1}\n"
    "\"mechanism.slider_mass\" = {dist=\"weibull\", scale=\"10 g\", shape=2.5, low=\"0.1 kg\"}\n"
    "\"initial.z\" = {dist=\"const\", value=0}\n"
    "\"way.yaw\" = {dist=\"values\", values=[\"1 mrad\", 0, -2e-3]}\n";

TEST(ResolvedScene, TolerancesReadBack) {
    for (char const* lines :
         {"members = 7", "members = 8\ndesign = \"lhs\"\nduration = 0.1\nsamples = 3", "design = \"sobol\"",
          "design = \"saltelli\"\nbase = 16", "design = \"grid\"\nlevels = 3",
          "design = \"lhs\"\n[study.correlation]\nkeys = [\"way.yaw\", \"initial.y\"]\nmatrix = [[1, 0.1], [0.1, 1]]",
          "[study.limits]\npeak_normal_force = {max=\"2 kN\"}\n\"mode_time[free]\" = {min=\"1 ms\", max=3}\n"
          "\"peak_tilt[yaw]\" = {min=-1e-3}"}) {
        expect_study_round_trip("tolerance", "quantities = [\"mode_time\"]\n" + std::string(lines) + drawn_keys);
    }
    expect_study_round_trip("ensemble", "design = \"saltelli\"\nbase = 16\n" + drawn_keys);
    expect_study_round_trip("poincare", "design = \"grid\"\nlevels = 2\n" + drawn_keys);
}

TEST(ResolvedScene, LongListsTakeSeveralLines) {
    std::string values;
    for (int i = 0; i < 1000; ++i) values += std::to_string(0.1 + 1.0 / (3 + i)) + ",\n";
    expect_round_trip("schema = 1\n[study.vary]\n\"initial.y\" = {dist=\"values\", values=[" + values + "]}");
    std::string vary = "[study.vary]\n", names, matrix;
    int const n = 40;
    for (int i = 0; i < n; ++i) {
        std::string const name(keys()[static_cast<std::size_t>(i)].name);
        if (!counts_for(*find_key(name), Parts{.mechanism = Mechanism::slider_crank})) continue;
        if (name == "contact.restitution" || name == "contact.hertz_exponent" || name.starts_with("friction."))
            continue;
        vary += "\"" + name + "\" = {dist=\"unif\", low=0.1, high=0.2}\n";
    }
    Scene const plain = scene_of("schema = 1\n" + vary);
    std::size_t const keys_that_vary = plain.variations.size();
    for (std::size_t i = 0; i < keys_that_vary; ++i) {
        names += "\n\"" + std::string(plain.variations[i].key->name) + "\",";
        matrix += "\n[";
        for (std::size_t j = 0; j < keys_that_vary; ++j) matrix += i == j ? "1," : "0.012345678901234567,";
        matrix += "],";
    }
    expect_round_trip("schema = 1\n[study.correlation]\nkeys = [" + names + "]\nmatrix = [" + matrix + "]\n" + vary);
}

TEST(ResolvedScene, ATableReadsBackFromAnywhere) {
    testing::TableFolder const folder;
    folder.write("a b.csv", "initial.y [mm],friction.static\n0.1,0.2\n0.3,0.4\n");
    Scene const scene = folder.read(
        "[friction]\n[study]\ndesign = \"table\"\ntable = \"a b.csv\"\n[study.vary]\n"
        "\"initial.z\" = {dist=\"unif\", low=0, high=1}");
    expect_round_trip(scene);
}

TEST(ResolvedScene, AChangedTableChangesTheText) {
    testing::TableFolder const folder;
    auto const resolved = [&](std::string const& text) {
        folder.write("a.csv", text);
        return resolved_toml(folder.read("[study]\ndesign = \"table\"\ntable = \"a.csv\""));
    };
    std::string const text = resolved("initial.y\n1\n");
    // FNV-1a of its bytes by an independent computation
    EXPECT_TRUE(contains(text, "a.csv\"  # 1 rows, FNV-1a 2a0a894d3785630b\n")) << text;
    EXPECT_NE(resolved("initial.y\n2\n"), text);
    EXPECT_EQ(resolved("initial.y\n1\n"), text);
}

TEST(ResolvedScene, NumbersAreInSiUnits) {
    std::string const text =
        resolved_toml(scene_of("schema = 1\n[joint]\nclearance = \"0.1 mm\"\n[mechanism]\n"
                               "crank_speed = \"3.141592653589793 rad/s\""));
    EXPECT_TRUE(contains(text, "clearance_y = 0.0001  # m\n"));
    EXPECT_TRUE(contains(text, "crank_speed = 3.141592653589793  # rad/s\n"));
    EXPECT_TRUE(contains(text, "method = \"auto\"\n"));
    EXPECT_TRUE(contains(text, "# slider_mass = 0.1872  # kg, derived: density x slider_length x way_width x way_depth\n")) << text;
}

TEST(ResolvedScene, WhatFollowsStillFollowsWhenItsSourceVaries) {
    Scene const scene = scene_of(resolved_toml(
        scene_of("schema = 1\n[study.vary]\n\"mechanism.slider_mass\" = {dist=\"const\", value=0.3744}")));
    EXPECT_NEAR(member_inputs(scene, 0).slider_inertia_x, 2 * 2.028e-5, 1e-18);
}

}  // namespace
}  // namespace slideway::resolved_test
