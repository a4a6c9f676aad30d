// The oracle's springs and dampers at the apices held against numbers computed by pencil, and its books over time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/oracle/spatial_runs.hpp"
#include "tests/unit/oracle/oracle_fixture.hpp"

namespace kelvin_voigt_test {
namespace {

using oracle::Case;
using oracle::Pairs;
using oracle::Result;
using oracle::State;
using oracle::testing::evaluate;
using oracle::testing::joined;
using oracle::testing::seed;
using oracle::testing::sum;
using oracle::testing::Triple;
using slideway::Damping;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;
using slideway::Parts;

constexpr double depth = 1e-6;  // of the pressed states [m]

Triple modes(Result const& r) { return {r.surfaces, r.lines, r.points}; }

/// A free slider that lies flat on the top of the way, 1 µm deep; 5 N for each of its apices.
Case pressed_flat() {
    Case c;
    c.parts.law = Law::kelvin_voigt;
    c.parts.mechanism = Mechanism::free_slider;
    c.inputs = oracle::completed({});
    c.inputs.law_a = 5e6, c.inputs.law_b = 0;
    c.state[0] = -(c.inputs.clearance_y + depth);
    return c;
}

Case pressed_by_one_apex() {
    Case c = oracle::testing::on_one_apex();
    c.parts = pressed_flat().parts;
    c.inputs.law_a = 5e6;
    return c;
}

TEST(KelvinVoigt, FourApicesOfAFlatSliderBearAlike) {
    Result const r = evaluate(pressed_flat());
    EXPECT_EQ(modes(r), (Triple{1, 0, 0}));
    EXPECT_EQ(r.faces[oracle::top], oracle::FaceKind::surface);
    // kδ = 5e6 N/m x 1 µm at each; U = 4 x 5e6 x (1e-6)²/2.
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(r.fn_y[apex - 1], 5, 1e-12);
    for (int apex : {2, 3, 6, 7}) EXPECT_EQ(r.fn_y[apex - 1], 0);
    EXPECT_EQ(sum(joined({}, r.fn_z)), 0);
    EXPECT_NEAR(r.normal_force[1], 20, 1e-11);
    EXPECT_NEAR(r.contact_potential, 1e-5, 1e-17);
    EXPECT_NEAR(r.derivative[2], 20 / (7800 * 0.04 * 0.02 * 0.03) - 9.81, 1e-10);
    for (int i : {3, 7, 8, 9}) EXPECT_NEAR(r.derivative[i], 0, 1e-9) << i;
    EXPECT_EQ(r.power_damping, 0);
}

TEST(KelvinVoigt, DampersPushWithTheRateAndNeverPull) {
    Case c = pressed_flat();
    c.inputs.law_b = 100;
    auto const at_speed = [&c](double down) {
        c.state[2] = -down;
        return evaluate(c);
    };
    // 2 cm/s in: 5 N + 100 N s/m x 0.02 m/s = 7 N each; 4 x 2 N x 0.02 m/s = 0.16 W.
    Result const in = at_speed(0.02);
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(in.fn_y[apex - 1], 7, 1e-12);
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(in.elastic_y[apex - 1], 5, 1e-12);
    EXPECT_NEAR(in.power_damping, 0.16, 1e-13);
    EXPECT_NEAR(in.contact_potential, 1e-5, 1e-17);
    // 2 cm/s out: 3 N each, which takes as much.
    Result const out = at_speed(-0.02);
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(out.fn_y[apex - 1], 3, 1e-12);
    EXPECT_NEAR(out.power_damping, 0.16, 1e-13);
    // 8 cm/s out: 5 N - 8 N is cut off at 0, and what the springs give back is lost: 4 x 5 N x 0.08 m/s.
    Result const torn = at_speed(-0.08);
    EXPECT_EQ(sum(joined(torn.fn_y, torn.fn_z)), 0);
    EXPECT_NEAR(torn.power_damping, 1.6, 1e-12);
    EXPECT_NEAR(torn.contact_potential, 1e-5, 1e-17);
    EXPECT_EQ(modes(torn), (Triple{1, 0, 0}));
    EXPECT_NEAR(torn.derivative[2], -9.81, 1e-14);
}

TEST(KelvinVoigt, StiffnessFollowsFromAQuarterOfTheFace) {
    Case c = pressed_flat();
    c.inputs.law_a = slideway::follows;
    // Y: E A/(4 l) = 2.07e11 x 0.04 x 0.03/(4 x 0.02) = 3.105e9 N/m.
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(evaluate(c).fn_y[apex - 1], 3105, 1e-8);
    // The face as a whole is as stiff as the surface of the paper's law.
    Case paper = c;
    paper.parts.law = Law::paper;
    EXPECT_NEAR(evaluate(c).normal_force[1], evaluate(paper).normal_force[1], 1e-8);
    EXPECT_NEAR(evaluate(c).contact_potential, evaluate(paper).contact_potential, 1e-14);
    // Z: 2.07e11 x 0.04 x 0.02/(4 x 0.03) = 1.38e9 N/m.
    Case aside = c;
    aside.state = {};
    aside.state[1] = aside.inputs.clearance_z + depth;
    for (int apex : {3, 4, 7, 8}) EXPECT_NEAR(evaluate(aside).fn_z[apex - 1], 1380, 1e-8);
    // Two bodies, 2 x 1e11 x 3e11/4e11 = 1.5e11 Pa, on half the thickness: 1.5e11 x 0.0012/(4 x 0.01) = 4.5e9 N/m.
    c.inputs.slider_young_modulus = 1e11, c.inputs.way_young_modulus = 3e11, c.inputs.thickness_y = 0.01;
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(evaluate(c).fn_y[apex - 1], 4500, 1e-8);
    EXPECT_NEAR(evaluate(c).contact_potential, 4 * 4.5e9 * 1e-12 / 2, 1e-13);
}

TEST(KelvinVoigt, AnApexAlonePushesAlongTheFaceOfTheSlider) {
    Case c = pressed_by_one_apex();
    c.inputs.law_b = 100;
    c.state[2] = 0.02;
    Result const r = evaluate(c);
    EXPECT_EQ(modes(r), (Triple{0, 0, 1}));
    EXPECT_EQ(r.faces[oracle::bottom], oracle::FaceKind::points);
    // P3 at ρ = (20 mm, -10 mm - y, -15 mm); n = Rz(1e-3) Rx(1e-3) e_Y; δ' = n_y vy.
    double const s = std::sin(1e-3), k = std::cos(1e-3), y = c.state[0];
    double const load = 5 + 100 * k * k * 0.02;
    EXPECT_NEAR(r.fn_y[2], load, 1e-9);
    EXPECT_NEAR(sum(joined(r.fn_y, r.fn_z)), load, 1e-9);
    EXPECT_NEAR(r.contact_potential, 5e6 * 1e-12 / 2, 1e-15);
    EXPECT_NEAR(r.power_damping, 100 * (k * k * 0.02) * (k * k * 0.02), 1e-12);
    // f = -F n, its X left out of the force.
    EXPECT_EQ(r.normal_force[0], 0);
    EXPECT_NEAR(r.normal_force[1], -load * k * k, 1e-9);
    EXPECT_NEAR(r.normal_force[2], -load * s, 1e-9);
    double const fx = load * s * k, fy = -load * k * k, fz = -load * s, rx = 0.02, ry = -0.01 - y, rz = -0.015;
    EXPECT_NEAR(r.normal_torque[0], ry * fz - rz * fy, 1e-10);
    EXPECT_NEAR(r.normal_torque[1], rz * fx - rx * fz, 1e-10);
    EXPECT_NEAR(r.normal_torque[2], rx * fy - ry * fx, 1e-10);
}

TEST(KelvinVoigt, AnApexIsHeldBackByFriction) {
    Case c = pressed_by_one_apex();
    c.parts.friction = true;
    c.state[11] = 0.05;  // beyond the slip speed: μd = 0.1
    Result const r = evaluate(c);
    // The slip is the velocity without its part along n, n_x = -sin cos: 0.05 √(1 - n_x²) m/s against 0.1 x 5 N.
    double const nx = -std::sin(1e-3) * std::cos(1e-3), across = std::sqrt(1 - nx * nx);
    EXPECT_NEAR(r.fn_y[2], 5, 1e-9);
    EXPECT_NEAR(r.power_friction, 0.1 * 5 * 0.05 * across, 1e-11);
    EXPECT_NEAR(r.derivative[11] * c.inputs.slider_mass, -0.5 * across, 1e-9);
    EXPECT_NEAR(r.power_damping, 0, 1e-15);
    // A force that is cut off rubs no more.
    c.inputs.law_b = 1e4;
    c.state[2] = -0.01;
    EXPECT_EQ(evaluate(c).power_friction, 0);
    EXPECT_NEAR(evaluate(c).derivative[11], 0, 1e-14);
}

TEST(KelvinVoigt, LinesAndSurfacesAreButNamesOfApices) {
    Case c = pressed_flat();
    c.state[6] = 1e-5;  // lifts the front end by 0.4 µm against the rear one: a tilted surface
    Result const tilted = evaluate(c);
    EXPECT_EQ(modes(tilted), (Triple{1, 0, 0}));
    // The rear lies 0.2 µm deeper than the middle, the front as much less.
    EXPECT_NEAR(tilted.fn_y[4], 6, 1e-4);
    EXPECT_NEAR(tilted.fn_y[0], 4, 1e-4);
    c.state[6] = 1e-4;  // by 4 µm: the rear edge alone
    Result const edge = evaluate(c);
    EXPECT_EQ(modes(edge), (Triple{0, 1, 0}));
    EXPECT_NEAR(edge.fn_y[4], 15, 1e-2);
    EXPECT_NEAR(edge.fn_y[7], 15, 1e-2);
    EXPECT_EQ(edge.fn_y[0], 0);
    c.inputs.edge_radius = 1e3;  // of no line is the domain asked
    EXPECT_FALSE(evaluate(c).contact_domain);
    EXPECT_EQ(evaluate(c).fn_y, edge.fn_y);
}

TEST(KelvinVoigt, EachPairOfAnyStateFollowsItsOwnDepthAndRate) {
    int touching = 0, cut_off = 0, following = 0;
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        for (Case const& c : oracle::make_cases(seed + 5, 500, mechanism, Law::kelvin_voigt)) {
            Result const r = evaluate(c);
            Inputs const& in = c.inputs;
            double const modulus = 2 / (1 / in.slider_young_modulus + 1 / in.way_young_modulus);
            bool const follows = std::isnan(in.law_a);
            double const y = follows ? modulus * in.slider_length * in.way_depth / (4 * in.thickness_y) : in.law_a;
            double const z = follows ? modulus * in.slider_length * in.way_width / (4 * in.thickness_z) : in.law_a;
            Pairs const depths = joined(r.pen_y, r.pen_z), rates = joined(r.rate_y, r.rate_z);
            Pairs const forces = joined(r.fn_y, r.fn_z);
            double potential = 0, loss = 0, loss_scale = 0;
            for (std::size_t i = 0; i < 16; ++i) {
                double const elastic = (i < 8 ? y : z) * std::max(depths[i], 0.0);
                double const viscous = depths[i] > 0 ? in.law_b * rates[i] : 0;
                double const force = std::max(elastic + viscous, 0.0);
                EXPECT_NEAR(forces[i], force, 1e-13 * (elastic + std::abs(viscous)));
                potential += elastic * std::max(depths[i], 0.0) / 2;
                loss += (force - elastic) * rates[i];
                loss_scale += (force + elastic) * std::abs(rates[i]);
                touching += depths[i] > 0, cut_off += depths[i] > 0 && force == 0;
                following += depths[i] > 0 && follows;
            }
            EXPECT_NEAR(r.contact_potential, potential, 1e-13 * potential);
            EXPECT_NEAR(r.power_damping, loss, 1e-12 * loss_scale);
            EXPECT_GE(r.power_damping, -1e-12 * loss_scale);
            EXPECT_FALSE(r.contact_domain);
        }
    }
    EXPECT_GT(touching, 1500);
    EXPECT_GT(cut_off, 300);
    EXPECT_GT(following, 500);
}

TEST(KelvinVoigt, CountsItsModesAsTheOtherLawsDoAndHasNoneOfTheirNumbers) {
    auto const published = oracle::make_cases(seed + 6, 600);
    auto const cases = oracle::make_cases(seed + 6, 600, Mechanism::slider_crank, Law::kelvin_voigt);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Case c = cases[i];
        Result const r = evaluate(c);
        EXPECT_EQ(modes(r), modes(evaluate(published[i])));
        c.inputs.eta = 0.5, c.inputs.chi_line = 20, c.inputs.chi_surface = 30, c.inputs.restitution = 0.3;
        c.inputs.point_stiffness = 1e7, c.inputs.hertz_exponent = 2, c.inputs.edge_radius = c.inputs.apex_radius = 1e-3;
        c.inputs.slider_poisson_ratio = c.inputs.way_poisson_ratio = 0.1;
        Result const other = evaluate(c);
        EXPECT_EQ(other.derivative, r.derivative);
        EXPECT_EQ(other.contact_potential, r.contact_potential);
    }
}

/// Thrown against the way with some spin and tilt, through a tight clearance: it bounces between the faces.
Case thrown() {
    Case c = pressed_flat();
    c.inputs.clearance_y = 2e-5, c.inputs.clearance_z = 3e-5;
    c.state = {0, 0, -0.05, 0.03, 2e-4, -1e-4, 1e-4, 0.5, -0.3, 1, 0, 0.02};
    return c;
}

TEST(KelvinVoigt, KeepsEnergyWithoutDampersAndFriction) {
    Case const c = thrown();
    auto const run = oracle::spatial_run(c.inputs, c.parts, c.state, 4e-3L, 2e-6L);
    double const kinetic = 0.5 * c.inputs.slider_mass * (0.05 * 0.05 + 0.03 * 0.03);
    EXPECT_GT(run.changes, 20);
    EXPECT_NE(run.state[2], c.state[2]);
    EXPECT_NEAR(static_cast<double>(run.energy_change), 0, 1e-8 * kinetic);
    EXPECT_EQ(run.damping, 0);
    EXPECT_EQ(run.friction, 0);
}

TEST(KelvinVoigt, LosesToItsDampersWhatIsMissing) {
    Case c = thrown();
    c.inputs.law_b = 30;
    double const kinetic = 0.5 * c.inputs.slider_mass * (0.05 * 0.05 + 0.03 * 0.03);
    auto const run = oracle::spatial_run(c.inputs, c.parts, c.state, 4e-3L, 2e-6L);
    EXPECT_GT(run.changes, 20);
    EXPECT_GT(run.damping, 0.05 * kinetic);
    EXPECT_NEAR(static_cast<double>(run.residual()), 0, 1e-6 * kinetic);
    // With friction too, and a drive.
    c.parts.friction = true;
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        if (oracle::name_of(mechanism).ends_with("_motor")) continue;  // whose motor these cases have not
        c.parts.mechanism = mechanism;
        auto const driven = oracle::spatial_run(c.inputs, c.parts, c.state, 2e-3L, 2e-6L);
        EXPECT_GT(driven.damping, 0.02 * kinetic) << oracle::name_of(mechanism);
        EXPECT_GT(driven.friction, 0.001 * kinetic) << oracle::name_of(mechanism);
        EXPECT_NEAR(static_cast<double>(driven.residual()), 0, 1e-6 * kinetic) << oracle::name_of(mechanism);
    }
}

TEST(KelvinVoigt, LeavesAWallAtTheSpeedOfALinearOscillatorThatNothingPulls) {
    // m δ'' + 4c δ' + 4k δ = 0 from δ = 0, δ' = v until the force is zero, δ'' = 0; free from there.  With α = 2c/m and
    // w = √(4k/m - α²): δ' = v exp(-αt) (cos wt - α/w sin wt), and δ'' = 0 at wt = π - atan(2αw/(w² - α²)).
    Case c = pressed_flat();
    c.inputs.gravity = 0;
    c.inputs.law_b = 400;
    double const m = c.inputs.slider_mass, speed = 0.1, rate = 2 * 400 / m;
    double const w = std::sqrt(4 * 5e6 / m - rate * rate);
    double const phase = std::numbers::pi - std::atan(2 * rate * w / (w * w - rate * rate));
    double const returned = -std::exp(-rate * phase / w) * (std::cos(phase) - rate / w * std::sin(phase));
    EXPECT_NEAR(returned, 0.3537, 1e-4);
    c.state = {-0.9e-4, 0, -speed};  // 10 µm to go
    auto const run = oracle::spatial_run(c.inputs, c.parts, c.state, 1e-3L, 1e-6L);
    EXPECT_NEAR(run.state[2], returned * speed, 1e-9 * speed);
    double const lost = m * speed * speed * (1 - returned * returned) / 2;
    EXPECT_NEAR(static_cast<double>(run.damping), lost, 1e-8 * lost);
}

}  // namespace
}  // namespace kelvin_voigt_test
