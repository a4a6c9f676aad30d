// Drives of mechanisms (model.md 15): closed forms, and the energy audit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/load_table.hpp"

namespace slideway::drives_test {
namespace {

using std::numbers::pi;
using testing::Pieces;

testing::RunOptions options(Mechanism mechanism, DrivePlan const& drive, double seconds, double tolerance) {
    testing::RunOptions o;
    o.parts.law = Law::conservative;
    o.parts.mechanism = mechanism;
    o.parts.drive = drive;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = seconds;
    return o;
}

testing::EnsembleResult run(Inputs const& in, testing::RunOptions const& o) {
    auto const r = testing::run(best_isa(), o, {complete_inputs(in, info(o.parts.mechanism))});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return r;
}

/// A slider in weightless flight within a joint that it does not reach.
Inputs afloat() {
    Inputs in;
    in.gravity = 0;
    in.clearance_y = in.clearance_z = 5e-3;
    return in;
}

/// ∫ over [0, end] by Gauss's rule of five points on many parts.
template <class Function> double integral(Function const& f, double end) {
    constexpr double at[] = {0, 0.5384693101056831, 0.9061798459386640}, weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    constexpr int parts = 400;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        double const half = end / parts / 2, middle = (2 * i + 1) * half;
        sum += half * weight[0] * f(middle);
        for (int k = 1; k < 3; ++k) sum += half * weight[k] * (f(middle - half * at[k]) + f(middle + half * at[k]));
    }
    return sum;
}

TEST(Drives, MotorRunsAYokeUpAsItsEnergySays) {
    // From rest under a constant torque ½(J + M r² sin²θ) θ'² = T θ, so t = ∫ 2 √((J + M r² sin²u²)/2T) du with θ = u².
    for (double const share : {1.0, 1e6}) {  // of the flywheel's inertia over the slider's
        Inputs in = afloat();
        in.crank_speed = 0;
        double const slider = complete_inputs(in).slider_mass * in.crank_length * in.crank_length;
        in.drive_inertia = share * slider, in.drive_torque = 40 * in.drive_inertia;
        double const turned = 7.3;
        auto const inertia = [&](double angle) { return in.drive_inertia + slider * std::sin(angle) * std::sin(angle); };
        double const time = integral([&](double u) { return 2 * std::sqrt(inertia(u * u) / (2 * in.drive_torque)); }, std::sqrt(turned));
        auto const r = run(in, options(Mechanism::scotch_yoke_motor, {.by = DriveBy::torque}, time, 1e-13));
        EXPECT_NEAR(r.states[0][10], turned, 1e-10 * turned) << share;
        double const speed = std::sqrt(2 * in.drive_torque * turned / inertia(turned));
        EXPECT_NEAR(r.states[0][11], speed, 1e-10 * speed) << share;
        EXPECT_NEAR(r.value(0, Quantity::drive_work), in.drive_torque * turned, 1e-10 * in.drive_torque * turned);
    }
}

TEST(Drives, CrossAnAngleOnceATurn) {
    // The same yoke: it is at 90° + 360° k when the quadrature says, running up from rest.
    Inputs in = afloat();
    in.crank_speed = 0;
    double const slider = complete_inputs(in).slider_mass * in.crank_length * in.crank_length;
    in.drive_inertia = 2 * slider, in.drive_torque = 40 * in.drive_inertia;
    in = complete_inputs(in);
    auto const o = options(Mechanism::scotch_yoke_motor, {.by = DriveBy::torque}, 1.5, 1e-11);
    constexpr std::size_t room = 20, width = 13;
    double sections[room * width];
    MemberRecord record;
    MemberClock const clock{1.5, 0, 0};
    Block block;
    block.inputs = &in, block.members = 1, block.records = &record, block.settings = o.settings, block.clocks = &clock;
    block.crossings = {.on = CrossingPlan::On::state, .direction = CrossingPlan::Direction::rising, .turns = true, .index = 10, .level = pi / 2, .room = room};
    block.section_values = sections;
    double state[12];
    block.final_states = state;
    find_instance(best_isa(), o.parts).run(block);
    ASSERT_EQ(record.status, Status::finished);
    ASSERT_EQ(record.crossings, static_cast<std::uint64_t>(std::floor((state[10] - pi / 2) / (2 * pi))) + 1);
    EXPECT_GT(record.crossings, 4u);
    auto const inertia = [&](double angle) { return in.drive_inertia + slider * std::sin(angle) * std::sin(angle); };
    for (std::size_t k = 0; k < record.crossings; ++k) {
        double const angle = pi / 2 + 2 * pi * static_cast<double>(k);
        double const time = integral([&](double u) { return 2 * std::sqrt(inertia(u * u) / (2 * in.drive_torque)); }, std::sqrt(angle));
        EXPECT_NEAR(sections[k * width], time, 1e-8) << k;
        EXPECT_NEAR(sections[k * width + 11], angle, 1e-9) << k;
    }
}

TEST(Drives, MotorWhoseTorqueFallsComesToItsSpeed) {
    // J θ'' = T0 (1 − θ'/ω0) − c θ', of a flywheel beside which the slider is nothing: θ' = ω1 (1 − exp(−t/τ)).
    Inputs in = afloat();
    in.crank_speed = 0;
    in.drive_inertia = 1e6 * complete_inputs(in).slider_mass * in.crank_length * in.crank_length;
    in.drive_torque = 100 * in.drive_inertia, in.drive_no_load_speed = 60, in.drive_viscous = 0.4 * in.drive_inertia;
    double const rate = 100.0 / 60 + 0.4, end = 100 / rate, t = 1.3;
    auto const r = run(in, options(Mechanism::scotch_yoke_motor, {.by = DriveBy::torque}, t, 1e-12));
    EXPECT_NEAR(r.states[0][11], end * (1 - std::exp(-rate * t)), 1e-6 * end);
    EXPECT_NEAR(r.states[0][10], end * (t - (1 - std::exp(-rate * t)) / rate), 1e-5);
    // Backwards as forwards.
    Inputs back = in;
    back.drive_torque = -in.drive_torque;
    auto const other = run(back, options(Mechanism::scotch_yoke_motor, {.by = DriveBy::torque}, t, 1e-12));
    EXPECT_NEAR(other.states[0][11], -r.states[0][11], 1e-11 * end);
    // The same torque over speed as a table.
    Pieces const falls({{0, 1, -1.0 / 60, 0, 0}}, 60);
    in.drive_no_load_speed = 0;
    auto const table = run(in, options(Mechanism::scotch_yoke_motor, {.by = DriveBy::torque, .table = &falls.table(), .over = LoadArgument::crank_speed}, t, 1e-12));
    EXPECT_NEAR(table.states[0][11], r.states[0][11], 1e-11 * end);
}

TEST(Drives, FlywheelHoldsTheSpeedOfADrivenCrank) {
    // With an inertia beyond all else the crank turns on at the speed it starts with: all mechanisms move as driven ones.
    struct Pair { Mechanism driven, free; };
    for (auto const [driven, free] : {Pair{Mechanism::slider_crank, Mechanism::slider_crank_motor}, Pair{Mechanism::scotch_yoke, Mechanism::scotch_yoke_motor},
                                      Pair{Mechanism::planar_slider_crank, Mechanism::planar_slider_crank}}) {
        SCOPED_TRACE(info(free).name);
        Inputs in;
        in.crank_speed = 20, in.vy = 0.02, in.start_angle = 0.7;
        auto const a = run(in, options(driven, {}, 0.02, 1e-10));
        in.drive_inertia = 1e5;
        auto const b = run(in, options(free, {.by = DriveBy::nothing}, 0.02, 1e-10));
        EXPECT_GT(a.value(0, Quantity::contact_onsets), 0);
        EXPECT_NEAR(b.states[0][free == Mechanism::planar_slider_crank ? 0 : 10], 0.7 + 20 * 0.02, 1e-8);
        for (int i : {1, 2, 3}) {
            auto const at = static_cast<std::size_t>(i);
            EXPECT_NEAR(a.states[0][at], b.states[0][at], 1e-5 * (1e-3 + std::abs(a.states[0][at]))) << i;
        }
    }
}

TEST(Drives, ProfileOfConstantSpeedMovesAsConstantSpeedDoes) {
    Pieces const even({{0, 0, 1, 0, 0}, {0.013, 0.013, 1, 0, 0}}, 9);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::planar_slider_crank}) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Inputs in;
            in.crank_speed = 20, in.vy = 0.02, in.start_angle = 0.7, in.restitution = 0.5;
            auto with = options(mechanism, {}, 0.02, 1e-9);
            with.parts.rigid = rigid;
            if (rigid) with.parts.damping = Damping::restitution;
            auto const a = run(in, with);
            in.drive_scale = 20, in.profile_speed = 1;
            with.parts.drive = {.by = DriveBy::profile, .table = &even.table()};
            auto const b = run(in, with);
            for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(a.states[0][i], b.states[0][i], 1e-6 * (1e-4 + std::abs(a.states[0][i]))) << i;
            EXPECT_NEAR(a.value(0, Quantity::drive_work), b.value(0, Quantity::drive_work), 1e-6 * std::abs(a.value(0, Quantity::drive_work)) + 1e-9);
        }
    }
}

TEST(Drives, ProfileGivesACarriageTheEnergyOfItsSpeed) {
    // x = 2 t² up a slope: W = ½ M (4 t)² + M g sin β x, whatever happens across the way.
    Pieces const even({{0, 0, 0, 2, 0}}, 1);
    Inputs in;
    in.inclination = 0.3;
    double const t = 0.25;
    auto const r = run(in, options(Mechanism::carriage, {.by = DriveBy::profile, .table = &even.table()}, t, 1e-10));
    double const m = complete_inputs(in).slider_mass, work = m * (8 * t * t + in.gravity * std::sin(0.3) * 2 * t * t);
    EXPECT_NEAR(r.value(0, Quantity::drive_work), work, 1e-9 * work);
}

TEST(Drives, KeepTheAuditOfEveryMechanismToRounding) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, 1, 0, 0}}, 2, true), profile({{0, 0, 30, 40, -90, 100}, {0.6, 45.36, 57.6, 0, 0}}, 2);
    struct Drive { Mechanism mechanism; DrivePlan plan; };
    DrivePlan const motor{.by = DriveBy::torque, .table = &wave.table(), .over = LoadArgument::crank_angle}, given{.by = DriveBy::profile, .table = &profile.table()};
    for (auto const& [mechanism, plan] :
         {Drive{Mechanism::slider_crank, given}, Drive{Mechanism::scotch_yoke, given}, Drive{Mechanism::planar_slider_crank, given},
          Drive{Mechanism::slider_crank_motor, motor}, Drive{Mechanism::scotch_yoke_motor, motor}, Drive{Mechanism::planar_slider_crank, motor},
          Drive{Mechanism::carriage, given}}) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Inputs in;
            in.crank_speed = 30, in.vy = 0.01, in.restitution = rigid ? 0.5 : 1;
            in.drive_torque = 0.3, in.drive_no_load_speed = 90, in.drive_viscous = 1e-3, in.drive_inertia = 1e-3;
            if (mechanism == Mechanism::carriage) in.drive_scale = 0.01;
            if (plan.by == DriveBy::profile) in.profile_speed = 30;
            Load load;
            load.force[0] = 0, in.load_a = -4;
            if (info(mechanism).drive == DriveKind::crank) load.crank_torque = 1, in.load_b = -0.05;
            for (double const tolerance : {1e-6, 1e-9}) {
                auto o = options(mechanism, plan, 0.1, tolerance);
                o.parts.rigid = rigid, o.parts.friction = true, o.parts.loads = {&load, 1};
                if (rigid) o.parts.damping = Damping::restitution;
                auto const r = run(in, o);
                double const work = std::abs(r.value(0, Quantity::load_work)) + std::abs(r.value(0, Quantity::drive_work));
                EXPECT_GT(work, 1e-3);
                EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
                EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * work) << tolerance << " " << work;
            }
        }
    }
}

TEST(Drives, ByAHeavyFlywheelAreAtConstantSpeedWithRigidContacts) {
    for (auto const& [driven, turning] : {std::pair{Mechanism::slider_crank, Mechanism::slider_crank_motor}, std::pair{Mechanism::scotch_yoke, Mechanism::scotch_yoke_motor}}) {
        SCOPED_TRACE(info(driven).name);
        Inputs in;
        in.crank_speed = 30, in.vy = 0.01, in.restitution = 0.5, in.drive_inertia = 1e5;
        auto const moved = [&](Mechanism mechanism, DrivePlan const& plan) {
            auto o = options(mechanism, plan, 0.1, 1e-10);
            o.parts.rigid = o.parts.friction = true;
            o.parts.damping = Damping::restitution;
            return run(in, o);
        };
        auto const by_drive = moved(driven, {}), by_flywheel = moved(turning, {.by = DriveBy::nothing});
        EXPECT_GT(by_drive.value(0, Quantity::contact_onsets), 1);
        EXPECT_EQ(by_flywheel.value(0, Quantity::contact_onsets), by_drive.value(0, Quantity::contact_onsets));
        for (std::size_t i = 0; i < state_size; ++i) EXPECT_NEAR(by_flywheel.states[0][i], by_drive.states[0][i], 1e-7) << i;
        EXPECT_NEAR(by_flywheel.states[0][10], in.start_angle + 30 * 0.1, 1e-8);
    }
}

TEST(Drives, OnEveryInstructionSetHaveTheSameBits) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, 1, 0, 0}}, 2, true), profile({{0, 0, 30, 40, -90, 100}, {0.6, 45.36, 57.6, 0, 0}}, 2);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::planar_slider_crank, Mechanism::slider_crank_motor,
                                      Mechanism::scotch_yoke_motor}) {
        bool const turns = info(mechanism).may_turn_freely;
        DrivePlan const plan = turns ? DrivePlan{.by = DriveBy::torque, .table = &wave.table(), .over = LoadArgument::crank_angle}
                                     : DrivePlan{.by = DriveBy::profile, .table = &profile.table()};
        std::vector<Inputs> members;
        for (int i = 0; i < 9; ++i) {
            Inputs in;
            in.crank_speed = 30, in.vy = 0.01 * i, in.drive_torque = 0.3 + 0.02 * i, in.drive_inertia = 1e-3, in.drive_scale = 1 + 0.1 * i, in.restitution = 0.5;
            members.push_back(complete_inputs(in, info(mechanism)));
        }
        for (bool const rigid : {false, true}) {
            auto o = options(mechanism, plan, 0.03, 1e-7);
            o.parts.rigid = rigid;
            if (rigid) o.parts.damping = Damping::restitution;
            auto const scalar = testing::run(Isa::scalar, o, members);
            for (Isa const isa : testing::isas_beside_scalar()) EXPECT_EQ(testing::run(isa, o, members).states, scalar.states) << info(mechanism).name << " " << rigid;
        }
    }
}

}  // namespace
}  // namespace slideway::drives_test
