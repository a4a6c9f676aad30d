// Loads on mechanisms (model.md 14): closed forms, and the energy audit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/loaded_member.hpp"

namespace slideway::loads_test {
namespace {

using std::numbers::pi;
using testing::afloat;
using testing::every_mechanism;
using testing::Loaded;
using testing::options;
using testing::Pieces;
using testing::run;

TEST(Loads, PushAFreeSliderAlongTheAxesOfTheGround) {
    Loaded l{afloat(), {{}}};
    l.put(l.loads[0].force, {3, 0.2, -0.1});
    double const t = 0.02;
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-10));
    double const m = complete_inputs(l.in).slider_mass;
    EXPECT_NEAR(r.states[0][10], 1.5 * t * t / m, 1e-14);
    EXPECT_NEAR(r.states[0][11], 3 * t / m, 1e-13);
    EXPECT_NEAR(r.states[0][0], 0.1 * t * t / m, 1e-15);
    EXPECT_NEAR(r.states[0][1], -0.05 * t * t / m, 1e-15);
    double const work = (9 + 0.04 + 0.01) * t * t / (2 * m);
    EXPECT_NEAR(r.value(0, Quantity::load_work), work, 1e-12 * work);
    EXPECT_NEAR(r.value(0, Quantity::energy_change), work, 1e-12 * work);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-12 * work);
}

TEST(Loads, OffTheCentreTurnTheSlider) {
    // A force along its own Y at p = (a, 0, 0) turns it about Z alone: α = a F/I.
    Loaded l{afloat(), {{}}};
    l.loads[0].turns_with_slider = true;
    l.put(l.loads[0].force, {0, 0.05, 0});
    l.put(l.loads[0].point, {0.02, 0, 0});
    double const t = 0.01;
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-11));
    auto const in = complete_inputs(l.in);
    double const a = 0.02 * 0.05 / in.slider_inertia_z;
    EXPECT_NEAR(r.states[0][9], a * t, 1e-12 * a * t);
    EXPECT_NEAR(r.states[0][6], 0.5 * a * t * t, 1e-12 * a * t * t);
    // It turns with the slider: vx' = −F sin ψ/M, vy' = F cos ψ/M, ψ = ½ a t².
    EXPECT_NEAR(r.states[0][11], -0.05 / in.slider_mass * a * t * t * t / 6, 1e-9 * 0.05 / in.slider_mass * t);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-12 * r.value(0, Quantity::load_work));
}

TEST(Loads, OfATorqueSpinTheSlider) {
    Loaded l{afloat(), {{}}};
    l.put(l.loads[0].torque, {1e-4, 0, 0});
    double const t = 0.02;
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-11));
    double const a = 1e-4 / complete_inputs(l.in).slider_inertia_x;
    EXPECT_NEAR(r.states[0][7], a * t, 1e-11 * a * t);
    EXPECT_NEAR(r.states[0][4], 0.5 * a * t * t, 1e-11 * a * t * t);
}

TEST(Loads, OverXAndItsSpeedAreASpringAndADamper) {
    // m x'' = −k x − c x': both as tables, whose scale is the member's.
    Pieces const straight({{-1, -1, 1, 0, 0}, {0.01, 0.01, 1, 0, 0}}, 1), steep({{-100, -100, 1, 0, 0}}, 100);
    Loaded l{afloat(), {{}, {}}};
    double const k = 2000, m = complete_inputs(l.in).slider_mass, zeta = 0.05, omega = std::sqrt(k / m), c = 2 * zeta * omega * m;
    l.in.x = 0.03;
    l.loads[0].force[0] = l.number(-k), l.loads[0].over = LoadArgument::x, l.loads[0].table = straight.table();
    l.loads[1].force[0] = l.number(-1), l.loads[1].scale = l.number(c), l.loads[1].over = LoadArgument::vx, l.loads[1].table = steep.table();
    double const t = 7 * 2 * pi / omega, damped = omega * std::sqrt(1 - zeta * zeta);
    auto o = options(l, Mechanism::free_slider, t, 1e-13);
    auto const r = run(l, o);
    double const decay = std::exp(-zeta * omega * t), share = zeta * omega / damped;
    double const x = 0.03 * decay * (std::cos(damped * t) + share * std::sin(damped * t));
    EXPECT_NEAR(r.states[0][10], x, 1e-10 * 0.03);
    EXPECT_NEAR(r.states[0][11], -0.03 * decay * omega * omega / damped * std::sin(damped * t), 1e-10 * 0.03 * omega);
    // What is left of the spring's energy is not in E: loads are work from outside.
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-10 * k * 0.03 * 0.03);
}

TEST(Loads, OverTimeGiveTheImpulseOfTheirTable) {
    // Up from 0 to 1 and down again, once and then repeated: ∫F dt = F/2 of a repeat.
    std::vector<PieceTable::Piece> const hat{{0, 0, 100, 0, 0}, {0.01, 1, -100, 0, 0}};
    for (bool const repeats : {false, true}) {
        Pieces const table(hat, 0.02, repeats);
        Loaded l{afloat(), {{}}};
        l.loads[0].force[0] = l.number(0.3), l.loads[0].over = LoadArgument::time, l.loads[0].table = table.table();
        auto const r = run(l, options(l, Mechanism::free_slider, 0.06, 1e-12));
        double const speed = 0.3 * 0.01 / complete_inputs(l.in).slider_mass;
        EXPECT_NEAR(r.states[0][11], (repeats ? 3 : 1) * speed, 1e-9 * speed);
    }
}

TEST(Loads, DriveTheAuditOfEveryMechanismToRounding) {
    // Over the crank's angle, time and x, with and without the slider's turning; contacts too.
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, -1, 0, 1}}, 2, true);
    for (Mechanism const mechanism : every_mechanism) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Loaded l{{}, {{}, {}, {}}};
            l.in.crank_speed = 40, l.in.vy = 0.01, l.in.restitution = rigid ? 0.5 : 1;
            bool const has_crank = info(mechanism).drive == DriveKind::crank;
            l.put(l.loads[0].force, {-5, 1, 0.5});
            l.put(l.loads[0].point, {0.01, 2e-3, -1e-3});
            l.loads[0].over = has_crank ? LoadArgument::crank_angle : LoadArgument::time;
            l.loads[0].table = wave.table();
            l.loads[1].turns_with_slider = true;
            l.put(l.loads[1].force, {2, -3, 0});
            l.loads[1].torque[2] = l.number(1e-3);
            l.loads[1].scale = l.number(0.7);
            l.loads[2].crank_torque = has_crank ? l.number(-0.1) : Load::none;
            double last = 0;
            for (double const tolerance : {1e-6, 1e-9}) {
                auto o = options(l, mechanism, 0.1, tolerance);
                o.parts.rigid = rigid, o.parts.friction = true;
                if (rigid) o.parts.damping = Damping::restitution;
                auto const r = run(l, o);
                double const work = std::abs(r.value(0, Quantity::load_work)) + std::abs(r.value(0, Quantity::drive_work));
                EXPECT_GT(work, 1e-3);
                EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
                last = std::abs(r.value(0, Quantity::energy_residual)) / work;
                EXPECT_LT(last, 200 * tolerance) << r.value(0, Quantity::load_work) << " " << r.value(0, Quantity::drive_work);
            }
        }
    }
}

TEST(Loads, OnTheCrankAreTheDrivesAlone) {
    // Held at its speed the crank moves as without: only the drive's torque and work are less by the load's.
    Loaded without{{}, {}}, with{{}, {{}}};
    with.loads[0].crank_torque = with.number(0.25);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::planar_slider_crank}) {
        double const t = 0.02;  // no longer, for steps differ: the work of the load is controlled too
        auto const a = run(without, options(without, mechanism, t, 1e-9)), b = run(with, options(with, mechanism, t, 1e-9));
        EXPECT_NEAR(a.states[0][0], b.states[0][0], 1e-9);
        double const work = 0.25 * without.in.crank_speed * t;
        EXPECT_NEAR(b.value(0, Quantity::load_work), work, 1e-12 * work);
        EXPECT_NEAR(b.value(0, Quantity::drive_work), a.value(0, Quantity::drive_work) - work, 2e-6 * work) << info(mechanism).name;
    }
}

TEST(Loads, PressASliderAtRestOntoItsWay) {
    // N = M g + F, rigid and compliant; friction holds up to μ_s N.
    for (bool const rigid : {false, true}) {
        Loaded l{{}, {{}}};
        l.put(l.loads[0].force, {4, -50, 0});
        l.in.y = -1e-4, l.in.restitution = 0.5;
        l.in.chi_line = l.in.chi_surface = 1e3;
        auto o = options(l, Mechanism::free_slider, 0.2, 1e-8);
        o.parts.rigid = rigid, o.parts.friction = rigid;
        o.parts.damping = rigid ? Damping::restitution : Damping::rate;
        auto const r = run(l, o);
        auto const in = complete_inputs(l.in);
        double const push = in.slider_mass * in.gravity + 50;
        EXPECT_NEAR(r.value(0, Quantity::mean_normal_force), push, (rigid ? 1e-9 : 2e-2) * push);
        if (rigid) EXPECT_NEAR(r.states[0][10], 0, 1e-12) << "it slides under " << 4 / push;
        else EXPECT_NEAR(r.states[0][10], 2 / in.slider_mass * 0.04, 1e-6);
    }
}

}  // namespace
}  // namespace slideway::loads_test
