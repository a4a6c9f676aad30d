// Cranks that turn freely, by what they have turned: ends and samples lie on their angles, whatever the crank's speed (model.md 15).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::turns_test {
namespace {

using std::numbers::pi;

constexpr double turn = 2 * pi;

testing::RunOptions options(Mechanism mechanism, double turns, std::size_t samples, double tolerance, DriveBy by = DriveBy::torque) {
    testing::RunOptions o;
    o.parts.law = Law::conservative;
    o.parts.mechanism = mechanism;
    o.parts.drive = {.by = by};
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = 20;
    o.turns = turns * turn;
    o.series = selections::of({Series::y, Series::vy, Series::crank_angle, Series::crank_angular_velocity});
    for (std::size_t i = 0; i <= samples; ++i) o.sample_times.push_back(o.turns * static_cast<double>(i) / static_cast<double>(samples));
    return o;
}

/// A slider in weightless flight within a joint that it does not reach.
Inputs afloat() {
    Inputs in;
    in.gravity = 0;
    in.clearance_y = in.clearance_z = 5e-3;
    in.crank_speed = 0;
    return in;
}

/// Number `series` of those of `options`, in the order of the table.
double const* row(testing::EnsembleResult const& r, testing::RunOptions const& o, Series of, std::size_t member = 0) {
    std::size_t place = 0;
    for (int i = 0; i < static_cast<int>(of); ++i) place += selects(o.series, static_cast<Series>(i)) ? 1 : 0;
    return &r.series[(place * r.records.size() + member) * o.sample_times.size()];
}

std::size_t angle_of(Mechanism mechanism) { return mechanism == Mechanism::planar_slider_crank ? 0 : 10; }

/// A slider in its joint, on a motor or a crank that runs on.
Inputs at_work() {
    Inputs in;
    in.crank_speed = 9, in.vy = 0.02, in.start_angle = 0.7, in.restitution = 0.6;
    in.drive_torque = 0.4, in.drive_no_load_speed = 25, in.drive_inertia = 4e-3;
    return in;
}

TEST(Turns, AFlywheelComesToItsAnglesWhenItsAccelerationSays) {
    // θ = ½ α t², of a flywheel beside which the slider is nothing, either way round.
    for (double const way : {1.0, -1.0}) {
        Inputs in = afloat();
        in.drive_inertia = 1e9 * complete_inputs(in).slider_mass * in.crank_length * in.crank_length;
        double const acceleration = 30;
        in.drive_torque = way * acceleration * in.drive_inertia, in.start_angle = 0.4;
        auto const o = options(Mechanism::scotch_yoke_motor, 3.5, 140, 1e-12);
        auto const r = testing::run(best_isa(), o, {complete_inputs(in, info(o.parts.mechanism))});
        ASSERT_EQ(r.records[0].status, Status::finished);
        EXPECT_NEAR(r.states[0][10], 0.4 + way * 3.5 * turn, 1e-11);
        EXPECT_NEAR(r.records[0].time, std::sqrt(2 * 3.5 * turn / acceleration), 1e-8);
        EXPECT_EQ(r.clock.back(), r.records[0].time);
        EXPECT_EQ(r.clock.front(), 0);
        for (std::size_t k = 0; k < o.sample_times.size(); ++k) {
            EXPECT_NEAR(row(r, o, Series::crank_angle)[k], 0.4 + way * o.sample_times[k], 1e-11) << k;
            EXPECT_NEAR(r.clock[k], std::sqrt(2 * o.sample_times[k] / acceleration), 1e-8) << k;
        }
    }
}

TEST(Turns, EndAndSamplesLieOnTheirAnglesByEveryMethod) {
    struct Case { Mechanism mechanism; Method method; bool rigid; };
    std::vector<Case> cases;
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        if (method != Method::moreau_jean && method != Method::ros34pw2) cases.push_back({Mechanism::slider_crank_motor, method, false});
        if (method == Method::automatic || method == Method::moreau_jean || method == Method::verner65)
            cases.push_back({Mechanism::planar_slider_crank, method, true});
    }
    cases.push_back({Mechanism::planar_slider_crank, Method::automatic, false});
    cases.push_back({Mechanism::scotch_yoke_motor, Method::automatic, false});
    for (auto const& [mechanism, method, rigid] : cases) {
        for (double const way : {1.0, -1.0}) {
            if (way < 0 && method != Method::automatic) continue;
            SCOPED_TRACE(std::string(info(mechanism).name) + " " + method_table[static_cast<std::size_t>(method)].name + (rigid ? " rigid" : ""));
            auto o = options(mechanism, 0.3, 20, 1e-7);
            o.settings.method = method, o.settings.fixed_step = method == Method::rk4 ? 2e-6 : 2e-5;
            o.parts.rigid = rigid, o.parts.friction = true, o.parts.damping = rigid || method != Method::rk4 ? Damping::restitution : Damping::point;
            Inputs in = at_work();
            in.crank_speed *= way, in.drive_torque *= way;
            auto const r = testing::run(best_isa(), o, {complete_inputs(in, info(mechanism))});
            ASSERT_EQ(r.records[0].status, Status::finished);
            EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
            EXPECT_NEAR(r.states[0][angle_of(mechanism)], 0.7 + way * o.turns, 1e-11);
            EXPECT_EQ(r.clock.back(), r.records[0].time);
            for (std::size_t k = 0; k < o.sample_times.size(); ++k) {
                EXPECT_NEAR(row(r, o, Series::crank_angle)[k], 0.7 + way * o.sample_times[k], 1e-10) << k;
                if (k > 0) {
                    EXPECT_GT(r.clock[k], r.clock[k - 1]) << k;
                }
            }
        }
    }
}

TEST(Turns, SamplesAreThoseOfTheirTimes) {
    // The same motor, asked at the times that the angles had: the motion does not know how it is sampled.
    for (Mechanism const mechanism : {Mechanism::slider_crank_motor, Mechanism::planar_slider_crank}) {
        auto const o = options(mechanism, 0.3, 30, 1e-9);
        std::vector<Inputs> const members{complete_inputs(at_work(), info(mechanism))};
        auto const by_turns = testing::run(best_isa(), o, members);
        auto by_time = o;
        by_time.turns = 0, by_time.sample_times = by_turns.clock, by_time.settings.end_time = by_turns.clock.back();
        auto const r = testing::run(best_isa(), by_time, members);
        ASSERT_EQ(r.records[0].status, Status::finished);
        for (std::size_t k = 0; k < o.sample_times.size(); ++k) {
            EXPECT_NEAR(row(r, by_time, Series::crank_angle)[k], 0.7 + o.sample_times[k], 1e-7) << k;
            EXPECT_NEAR(row(r, by_time, Series::y)[k], row(by_turns, o, Series::y)[k], 1e-8) << k;
        }
        EXPECT_LT(std::abs(by_turns.value(0, Quantity::energy_residual)), 1e-6 * std::abs(by_turns.value(0, Quantity::drive_work)));
        EXPECT_NEAR(by_turns.value(0, Quantity::drive_work), r.value(0, Quantity::drive_work), 1e-7);
        double modes = 0;
        for (int i = 0; i < 4; ++i) modes += by_turns.value(0, Quantity::mode_time, i);
        EXPECT_NEAR(modes, by_turns.records[0].time, 1e-9);
    }
}

TEST(Turns, AHugeFlywheelIsSampledAsADrivenCrankIs) {
    struct Pair { Mechanism driven, free; };
    for (auto const [driven, free] : {Pair{Mechanism::slider_crank, Mechanism::slider_crank_motor}, Pair{Mechanism::scotch_yoke, Mechanism::scotch_yoke_motor}}) {
        SCOPED_TRACE(info(free).name);
        Inputs in;
        in.crank_speed = 20, in.vy = 0.02, in.start_angle = 0.7;
        auto o = options(free, 0.05, 40, 1e-10, DriveBy::nothing);
        in.drive_inertia = 1e6;
        auto const b = testing::run(best_isa(), o, {complete_inputs(in, info(free))});
        ASSERT_EQ(b.records[0].status, Status::finished);
        auto even = o;
        even.parts.mechanism = driven, even.parts.drive = {}, even.turns = 0, even.settings.end_time = o.turns / 20;
        even.series = selections::of({Series::y, Series::vy});
        for (double& at : even.sample_times) at /= 20;
        auto const a = testing::run(best_isa(), even, {complete_inputs(in, info(driven))});
        for (std::size_t k = 0; k < o.sample_times.size(); ++k) {
            EXPECT_NEAR(b.clock[k], even.sample_times[k], 1e-9) << k;
            EXPECT_NEAR(row(b, o, Series::y)[k], row(a, even, Series::y)[k], 1e-9) << k;
        }
    }
}

TEST(Turns, WhoDoesNotComeToTheEndInTimeSaysSo) {
    // A brake stops the crank after 2.6 turns: ω² = 2 α θ; it then turns back, and comes to its end the other way.
    Inputs in = afloat();
    in.drive_inertia = 1e9 * complete_inputs(in).slider_mass * in.crank_length * in.crank_length;
    in.drive_torque = -8 * in.drive_inertia, in.crank_speed = std::sqrt(2 * 8 * 2.6 * turn);
    auto o = options(Mechanism::scotch_yoke_motor, 4, 8, 1e-10);
    double const stops = in.crank_speed / 8;
    o.settings.end_time = stops + 1;
    auto const members = std::vector{complete_inputs(in, info(o.parts.mechanism))};
    auto const late = testing::run(best_isa(), o, members);
    EXPECT_EQ(late.records[0].status, Status::out_of_time);
    EXPECT_EQ(late.records[0].time, o.settings.end_time);
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(std::isnan(late.clock[k]), k > 5) << k;  // samples every half turn
    o.settings.end_time = 30;
    auto const back = testing::run(best_isa(), o, members);
    EXPECT_EQ(back.records[0].status, Status::finished);
    EXPECT_NEAR(back.states[0][10], -4 * turn, 1e-10);
    EXPECT_NEAR(back.records[0].time, stops + std::sqrt(2 * 6.6 * turn / 8), 1e-6);
    in.drive_torque = 0, in.crank_speed = 0;
    auto const rests = testing::run(best_isa(), o, {complete_inputs(in, info(o.parts.mechanism))});
    EXPECT_EQ(rests.records[0].status, Status::out_of_time);
}

TEST(Turns, HaveTheSameBitsInEveryInstructionSet) {
    for (Mechanism const mechanism : {Mechanism::slider_crank_motor, Mechanism::scotch_yoke_motor, Mechanism::planar_slider_crank}) {
        for (bool const rigid : {false, true}) {
            if (rigid && mechanism != Mechanism::planar_slider_crank) continue;
            std::vector<Inputs> members;
            for (int i = 0; i < 19; ++i) {
                Inputs in = at_work();
                in.vy = 0.003 * i, in.crank_speed = (i % 2 == 0 ? 1 : -1) * (5 + i), in.drive_torque = (i % 3 == 0 ? -1 : 1) * (0.1 + 0.05 * i);
                members.push_back(complete_inputs(in, info(mechanism)));
            }
            auto o = options(mechanism, 0.6, 24, 1e-6);
            o.parts.rigid = rigid, o.parts.damping = Damping::restitution;
            o.settings.end_time = 0.5;
            auto const scalar = testing::run(Isa::scalar, o, members);
            for (Isa const isa : testing::isas_beside_scalar()) {
                auto const other = testing::run(isa, o, members);
                for (std::size_t i = 0; i < members.size(); ++i) {
                    EXPECT_EQ(scalar.records[i].status, other.records[i].status) << i;
                    EXPECT_EQ(scalar.records[i].rhs_evaluations, other.records[i].rhs_evaluations) << i;
                    EXPECT_EQ(scalar.states[i], other.states[i]) << info(mechanism).name << " " << i;
                }
                auto const same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
                EXPECT_TRUE(std::ranges::equal(scalar.clock, other.clock, same));
                EXPECT_TRUE(std::ranges::equal(scalar.series, other.series, same));
            }
        }
    }
}

}  // namespace
}  // namespace slideway::turns_test
