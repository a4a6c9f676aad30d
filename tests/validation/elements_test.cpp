// Springs, stops, the ground's motion and gravity of any direction (model.md 14): closed forms, and the energy audit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "host/config/piece_function.hpp"
#include "kernels/laws/restitution.hpp"
#include "tests/support/loaded_member.hpp"

namespace slideway::elements_test {
namespace {

using std::numbers::pi;
using testing::afloat;
using testing::every_mechanism;
using testing::Loaded;
using testing::options;
using testing::Pieces;
using testing::run;

/// Along X from an anchor at x = −0.1.
Load& add_spring(Loaded& l, double stiffness, double damping, double rest_length) {
    Load& load = l.loads.emplace_back();
    load.kind = LoadKind::spring, load.along = true;
    load.anchor[0] = l.number(-0.1);
    load.stiffness = l.number(stiffness), load.damping = l.number(damping), load.rest_length = l.number(rest_length);
    return load;
}

Load& add_stop(Loaded& l, double position, double stiffness) {
    Load& load = l.loads.emplace_back();
    load.kind = LoadKind::stop;
    load.anchor[0] = l.number(position), load.stiffness = l.number(stiffness);
    return load;
}

void add_ground(Loaded& l, PieceTable const& table, std::array<double, 3> const& scales) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Load& load = l.loads.emplace_back();
        load.kind = LoadKind::ground_motion, load.over = LoadArgument::time, load.table = table;
        load.force[axis] = l.number(scales[axis]);
    }
}

TEST(Springs, AlongXSwingAsADampedOscillator) {
    // m x'' = −k (x + 0.1 − 0.1) − c x' from x = 0.03 at rest.
    double const m = complete_inputs(afloat()).slider_mass, k = 2000, omega = std::sqrt(k / m), zeta = 0.05, c = 2 * zeta * omega * m;
    Loaded l{afloat(), {}};
    add_spring(l, k, c, 0.1);
    l.in.x = 0.03;
    double const t = 7 * 2 * pi / omega, damped = omega * std::sqrt(1 - zeta * zeta), decay = std::exp(-zeta * omega * t);
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-13));
    double const x = 0.03 * decay * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
    double const v = -0.03 * decay * omega * omega / damped * std::sin(damped * t);
    EXPECT_NEAR(r.states[0][10], x, 1e-10 * 0.03);
    EXPECT_NEAR(r.states[0][11], v, 1e-10 * 0.03 * omega);
    double const energy = 0.5 * k * 0.03 * 0.03, left = 0.5 * k * x * x + 0.5 * m * v * v;
    EXPECT_NEAR(r.value(0, Quantity::energy_change), left - energy, 1e-10 * energy);
    EXPECT_NEAR(r.value(0, Quantity::spring_loss), energy - left, 1e-10 * energy);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-12 * energy);
    EXPECT_EQ(r.value(0, Quantity::load_work), 0);
}

TEST(Springs, WithTheirPreloadPullTowardsTheAnchor) {
    // A tension without stiffness: x'' = −T/m.
    Loaded l{afloat(), {}};
    add_spring(l, 0, 0, 0).preload = l.number(3);
    double const m = complete_inputs(l.in).slider_mass, t = 0.05;
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-12));
    EXPECT_NEAR(r.states[0][10], -1.5 * t * t / m, 1e-13);
    EXPECT_NEAR(r.value(0, Quantity::energy_change), 0, 1e-13) << "its potential is in E";
}

TEST(Springs, OffTheCentreKeepEnergyWhileTheyTurnTheSlider) {
    // From anchors beside the slider to its corners: it swings about all axes.
    Loaded l{afloat(), {}};
    l.in.clearance_y = l.in.clearance_z = 0.05;
    for (double const side : {1.0, -1.0}) {
        Load& load = l.loads.emplace_back();
        load.kind = LoadKind::spring;
        load.anchor[0] = l.number(0.05 * side), load.anchor[1] = l.number(0.04), load.anchor[2] = l.number(-0.02 * side);
        load.point[0] = l.number(0.02 * side), load.point[1] = l.number(0.01);
        load.stiffness = l.number(side > 0 ? 300 : 200), load.rest_length = l.number(0.03);
    }
    double least = 1;
    for (double const tolerance : {1e-7, 1e-10, 1e-13}) {
        auto const r = run(l, options(l, Mechanism::free_slider, 0.5, tolerance));
        EXPECT_GT(std::abs(r.states[0][6]) + std::abs(r.states[0][5]), 1e-2) << "it turns";
        EXPECT_EQ(r.value(0, Quantity::load_work), 0);
        EXPECT_EQ(r.value(0, Quantity::spring_loss), 0);
        double const potential = 0.5 * 300 * 0.02 * 0.02;
        EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * potential);
        least = std::abs(r.value(0, Quantity::energy_residual)) / potential;
    }
    EXPECT_LT(least, 1e-11);
}

constexpr double approach = 0.2, stiffness = 1e6;
/// Of a slider that flies at 0.2 m/s onto a stop at 1 mm, some while after it has left.
struct BounceResult { double x, vx, loss, change, residual, on_stop; };
BounceResult bounce(double damping, double dissipation, double side, double rtol = 1e-12) {
    Loaded l{afloat(), {}};
    Load& load = add_stop(l, 1e-3 * side, stiffness);
    load.side = side, load.damping = l.number(damping), load.dissipation = l.number(dissipation);
    l.in.vx = approach * side;
    double const m = complete_inputs(l.in).slider_mass;
    auto o = options(l, Mechanism::free_slider, 0.02, rtol);
    o.settings.max_step = std::sqrt(m / stiffness);
    auto const r = run(l, o);
    return {r.states[0][10] * side, r.states[0][11] * side, r.value(0, Quantity::spring_loss), r.value(0, Quantity::energy_change),
            r.value(0, Quantity::energy_residual), std::sqrt(m / stiffness)};
}

TEST(Stops, ReturnASliderAfterHalfAPeriod) {
    for (double const side : {1.0, -1.0}) {
        auto const r = bounce(0, 0, side);
        double const half_period = pi * r.on_stop, touch = 1e-3 / approach;
        EXPECT_NEAR(r.vx, -approach, 1e-9 * approach);
        EXPECT_NEAR(r.x, 1e-3 - approach * (0.02 - touch - half_period), 1e-9 * 1e-3);
        EXPECT_NEAR(r.change, 0, 1e-11);
        EXPECT_EQ(r.loss, 0);
        EXPECT_NEAR(r.residual, 0, 1e-11);
    }
}

TEST(Stops, WithADashpotNeverPull) {
    // k δ + c δ' ends before δ does: tan(ω_d t) = −2 ζ √(1 − ζ²)/(1 − 2 ζ²).
    Loaded const probe{afloat(), {}};
    double const m = complete_inputs(probe.in).slider_mass, omega = std::sqrt(stiffness / m);
    double const zeta = 0.2, root = std::sqrt(1 - zeta * zeta), damped = omega * root;
    auto const r = bounce(2 * zeta * omega * m, 0, 1);
    double const end = (pi - std::atan2(2 * zeta * root, 1 - 2 * zeta * zeta)) / damped, decay = std::exp(-zeta * omega * end);
    double const depth = approach / damped * decay * std::sin(damped * end);
    double const speed = approach * decay * (std::cos(damped * end) - zeta / root * std::sin(damped * end));
    EXPECT_NEAR(r.vx, speed, 1e-8 * approach);
    EXPECT_NEAR(r.x, 1e-3 + depth + speed * (0.02 - 1e-3 / approach - end), 1e-8 * 1e-3);
    double const energy = 0.5 * m * approach * approach;
    EXPECT_NEAR(r.loss, energy - 0.5 * m * speed * speed, 1e-8 * energy);
    EXPECT_NEAR(r.residual, 0, 1e-9 * energy);
}

TEST(Stops, WithDissipationReturnTheRestitutionOfTheirSpeed) {
    for (double const e : {0.9, 0.5, 0.2}) {
        auto const r = bounce(0, restitution_slope(e) / approach, 1);
        EXPECT_NEAR(r.vx, -e * approach, 1e-9 * approach) << e;
        double const energy = 0.5 * complete_inputs(afloat()).slider_mass * approach * approach;
        EXPECT_NEAR(r.loss, (1 - e * e) * energy, 1e-9 * energy);
        EXPECT_NEAR(r.residual, 0, 1e-9 * energy);
    }
}

TEST(Stops, ErrWithinTheTolerance) {
    for (double const rtol : {1e-5, 1e-7, 1e-9}) {
        EXPECT_NEAR(bounce(0, 0, 1, rtol).vx, -approach, 200 * rtol * approach) << rtol;
        EXPECT_NEAR(bounce(0, restitution_slope(0.5) / approach, 1, rtol).vx, -0.5 * approach, 200 * rtol * approach) << rtol;
    }
}

TEST(GroundMotion, LeavesASliderBehindThatNothingHolds) {
    // Of the resting slider the ground sees −∬a: of a sine, −A (t/w − sin(w t)/w²), and of its spline as much.
    std::vector<double> places, values;
    double const w = 2 * pi * 25, strength = 4;
    for (int i = 0; i <= 2000; ++i) places.push_back(i * 0.2 / 2000), values.push_back(std::sin(w * places.back()));
    PieceFunction const sine(places, values, Interpolation::spline, false);
    Loaded l{afloat(), {}};
    add_ground(l, sine.table(), {strength, 0.1 * strength, -0.2 * strength});
    double const t = 0.09, v = -strength * (1 - std::cos(w * t)) / w, x = -strength * (t / w - std::sin(w * t) / (w * w));
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-13));
    double const largest = strength * t / w;
    EXPECT_NEAR(r.states[0][10], x, 1e-9 * largest);
    EXPECT_NEAR(r.states[0][11], v, 1e-9 * strength / w);
    EXPECT_NEAR(r.states[0][0], 0.1 * x, 1e-10 * largest);
    EXPECT_NEAR(r.states[0][1], -0.2 * x, 1e-10 * largest);
    double const work = 0.5 * complete_inputs(l.in).slider_mass * v * v * 1.05;
    EXPECT_NEAR(r.value(0, Quantity::ground_work), work, 1e-9 * work);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-11 * work);
}

/// What of a run does not depend on how its weight is said.
constexpr Quantity of_motion[] = {Quantity::drive_work, Quantity::rms_crank_torque, Quantity::mean_normal_force, Quantity::rms_acceleration};

void expect_same_motion(testing::EnsembleResult const& a, testing::EnsembleResult const& b, Mechanism mechanism, double share) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(info(mechanism).states); ++i)
        EXPECT_NEAR(a.states[0][i], b.states[0][i], share * (1e-4 + std::abs(a.states[0][i]))) << i;
    for (Quantity const q : of_motion)
        EXPECT_NEAR(a.value(0, q), b.value(0, q), share * std::abs(a.value(0, q)) + 1e-12) << quantity_table[static_cast<int>(q)].name;
}

TEST(GroundMotion, ThatIsConstantIsGravityTheOtherWay) {
    // Rod and crank included: torque and work of the drive, and forces of contact, are those under weight.
    Pieces const constant({{0, 1, 0, 0, 0}}, 1);
    for (Mechanism const mechanism : every_mechanism) {
        bool const planar = mechanism == Mechanism::planar_slider_crank;
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Loaded heavy{{}, {}};
            heavy.in.gravity = 30, heavy.in.inclination = 0.4, heavy.in.cross_inclination = planar ? 0 : 2;
            heavy.in.crank_speed = 20, heavy.in.restitution = 0.5, heavy.in.rod_mass_center = 0.3;
            Loaded shaken = heavy;
            shaken.in.gravity = 0;
            double const g = 30, b = 0.4, c = heavy.in.cross_inclination;
            add_ground(shaken, constant.table(), {g * std::sin(b), g * std::cos(b) * std::cos(c), g * std::cos(b) * std::sin(c)});
            // Before the first touches have made small differences large.
            double const t = rigid ? 0.02 : 0.004;
            auto of = options(heavy, mechanism, t, 1e-11), with = options(shaken, mechanism, t, 1e-11);
            for (auto* o : {&of, &with}) {
                o->parts.rigid = rigid;
                if (rigid) o->parts.damping = Damping::restitution;
            }
            auto const a = run(heavy, of), b2 = run(shaken, with);
            expect_same_motion(a, b2, mechanism, rigid ? 1e-6 : 1e-7);
            EXPECT_EQ(a.value(0, Quantity::ground_work), 0);
            EXPECT_GT(std::abs(b2.value(0, Quantity::ground_work)), 1e-6);
        }
    }
}

TEST(Gravity, AcrossTheWayIsItsForceOnTheSlider) {
    // A slider that nothing drives, rigid, on an incline that leans to its side too: it slides down, held by friction.
    Loaded heavy{{}, {}};
    heavy.in.inclination = 0.5, heavy.in.cross_inclination = 0.7, heavy.in.friction_static = heavy.in.friction_kinetic = 0.1;
    Loaded pushed = heavy;
    pushed.in.gravity = 0;
    double const weight = complete_inputs(heavy.in).slider_mass * heavy.in.gravity;
    double const down = weight * std::cos(0.5);
    pushed.loads.emplace_back();
    pushed.put(pushed.loads[0].force, {-weight * std::sin(0.5), -down * std::cos(0.7), -down * std::sin(0.7)});
    auto of = options(heavy, Mechanism::free_slider, 0.2, 1e-10), with = options(pushed, Mechanism::free_slider, 0.2, 1e-10);
    for (auto* o : {&of, &with}) o->parts.rigid = o->parts.friction = true, o->parts.damping = Damping::restitution;
    for (Loaded* one : {&heavy, &pushed}) one->in.restitution = 0, one->in.y = one->in.z = -1e-4;
    auto const a = run(heavy, of), b = run(pushed, with);
    double const acceleration = -9.81 * (std::sin(0.5) - 0.1 * std::cos(0.5) * (std::cos(0.7) + std::sin(0.7)));
    EXPECT_NEAR(a.states[0][11], acceleration * 0.2, 1e-8);
    EXPECT_NEAR(b.states[0][11], acceleration * 0.2, 1e-8);
    EXPECT_NEAR(a.states[0][10], b.states[0][10], 1e-9);
    EXPECT_NEAR(a.value(0, Quantity::energy_change), -a.value(0, Quantity::friction_loss), 1e-9 * weight);
    EXPECT_NEAR(b.value(0, Quantity::load_work), weight * std::sin(0.5) * -b.states[0][10], 1e-9 * weight);
}

/// Of every kind one, off the centre.
Loaded with_every_element(Mechanism mechanism, PieceTable const& wave, double crank_speed) {
    bool const planar = mechanism == Mechanism::planar_slider_crank;
    Loaded l{{}, {}};
    l.in.crank_speed = crank_speed, l.in.vy = 0.01;
    double const x = mechanism == Mechanism::free_slider || mechanism == Mechanism::carriage ? 0
                     : mechanism == Mechanism::scotch_yoke                                  ? l.in.crank_length
                                                                                            : l.in.crank_length + l.in.rod_length;
    Load& spring = l.loads.emplace_back();
    spring.kind = LoadKind::spring;
    spring.anchor[0] = l.number(x - 0.1), spring.anchor[1] = l.number(0.05);
    if (!planar) spring.anchor[2] = l.number(0.02);
    spring.point[0] = l.number(0.01);
    spring.stiffness = l.number(300), spring.damping = l.number(2), spring.rest_length = l.number(0.1), spring.preload = l.number(1);
    Load& stop = add_stop(l, x + (mechanism == Mechanism::free_slider || mechanism == Mechanism::carriage ? 2e-4 : -2e-4), 2e5);
    stop.dissipation = l.number(1), stop.point[1] = l.number(5e-3);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        Load& ground = l.loads.emplace_back();
        ground.kind = LoadKind::ground_motion, ground.over = LoadArgument::time, ground.table = wave;
        ground.force[axis] = l.number(axis == 0 ? 10 : -5);
    }
    if (mechanism == Mechanism::free_slider) l.in.vx = 0.1;
    return l;
}

TEST(Elements, DriveTheAuditOfEveryMechanismToRounding) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, -1, 0, 1}}, 2, true);
    for (Mechanism const mechanism : every_mechanism) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Loaded l = with_every_element(mechanism, wave.table(), 40);
            l.in.restitution = rigid ? 0.5 : 1;
            for (double const tolerance : {1e-6, 1e-9}) {
                auto o = options(l, mechanism, 0.1, tolerance);
                o.parts.rigid = rigid, o.parts.friction = true;
                if (rigid) o.parts.damping = Damping::restitution;
                auto const r = run(l, o);
                double work = r.value(0, Quantity::spring_loss);
                for (Quantity const q : {Quantity::ground_work, Quantity::drive_work}) work += std::abs(r.value(0, q));
                EXPECT_GT(std::abs(r.value(0, Quantity::ground_work)), 1e-6);
                EXPECT_GT(r.value(0, Quantity::spring_loss), 1e-5);
                EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
                EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * work) << work;
            }
        }
    }
}

TEST(Elements, AreTheSameInEveryLane) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, -1, 0, 1}}, 2, true);
    for (Mechanism const mechanism : every_mechanism) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Loaded l = with_every_element(mechanism, wave.table(), 40);
            l.in.restitution = rigid ? 0.5 : 1, l.in.cross_inclination = mechanism == Mechanism::planar_slider_crank ? 0 : 0.3;
            auto o = options(l, mechanism, 0.03, 1e-7);
            o.parts.rigid = rigid, o.parts.friction = true;
            if (rigid) o.parts.damping = Damping::restitution;
            std::vector<Inputs> members(7, complete_inputs(l.in, info(mechanism)));
            for (std::size_t i = 0; i < members.size(); ++i) members[i].vy += 1e-3 * static_cast<double>(i);
            testing::expect_one_motion_on_all(o, members);
        }
    }
}

}  // namespace
}  // namespace slideway::elements_test
