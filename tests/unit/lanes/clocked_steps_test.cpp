// Steps by the clocks of impacts: the same motion as by steps of time, for less, whatever law, damping and friction there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/steppers/contact_clock.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::clocked_steps_test {
namespace {

constexpr double clearance = 5e-4, crank_speed = 47;

testing::RunOptions options_of(Parts const& parts, Method method, double tolerance, double end) {
    testing::RunOptions o;
    o.parts = parts;
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end;
    return o;
}

std::vector<Inputs> starts(Parts const& parts, std::size_t count) {
    auto members = testing::scattered_starts(count, clearance, crank_speed, parts.law);
    for (auto& in : members) {
        in = testing::with_own(in, parts.law, 50);
        in.chi_line = in.chi_surface = 10;
        in.restitution = 0.6;
        in.vy = in.y > 0 ? 0.1 : -0.1;
    }
    return members;
}

/// Largest distance of two runs' states, in the scales of the joint.
double distance(testing::EnsembleResult const& a, testing::EnsembleResult const& b, std::size_t i) {
    double const tilt = 1e-2;  // 2c/L
    double const scale[state_size] = {clearance, clearance, clearance * crank_speed, clearance * crank_speed, tilt, tilt, tilt,
                                      tilt * crank_speed, tilt * crank_speed, tilt * crank_speed};
    double largest = 0;
    for (int k = 0; k < state_size; ++k) {
        auto const at = static_cast<std::size_t>(k);
        largest = std::max(largest, std::abs(a.states[i][at] - b.states[i][at]) / scale[k]);
    }
    return largest;
}

class ClockedStepsOf : public ::testing::TestWithParam<Mechanism> {};

TEST_P(ClockedStepsOf, GoWhereStepsOfTimeGoUnderEveryLaw) {
    // A slider that nothing drives meets more edges in the same time, and errors grow with each.
    for (Law const law : testing::every_law()) {
        for (Damping const damping : testing::dampings_of(info(law))) {
            // Steps of time that end at changes of the contacts are the better ones: they are no measure.
            double const driven = info(law).switches ? 1e-6 : 1e-5;
            double const least = GetParam() == Mechanism::free_slider ? 2e-5 : driven;
            for (bool const friction : {false, true}) {
                Parts const parts{law, damping, friction, friction, GetParam()};
                // The first impact or two; the law that switches needs its switches located by the other method too.
                double const end = 6e-3;
                auto const members = starts(parts, 8);
                auto by_time = options_of(parts, Method::dopri5, 1e-12, end);
                by_time.settings.locate_modes = info(law).switches && damping != Damping::restitution;
                auto const want = testing::run(best_isa(), by_time, members);
                auto const found = testing::run(best_isa(), options_of(parts, Method::verner65, 1e-9, end), members);
                by_time.settings.rtol = by_time.settings.atol = 1e-9;
                auto const usual = testing::run(best_isa(), by_time, members);
                double onsets = 0;
                for (std::size_t i = 0; i < members.size(); ++i) {
                    auto const what = std::string(info(law).name) + ", damping " + std::to_string(static_cast<int>(damping)) +
                                      (friction ? ", friction" : "") + ", member " + std::to_string(i);
                    ASSERT_EQ(found.records[i].status, Status::finished) << what;
                    ASSERT_EQ(want.records[i].status, Status::finished) << what;
                    EXPECT_LT(distance(found, want, i), std::max(least, 10 * distance(usual, want, i))) << what;
                    EXPECT_EQ(found.value(i, Quantity::contact_onsets), want.value(i, Quantity::contact_onsets)) << what;
                    // Steps do not end where a bed's load vanishes, which it does smoothly: its times of modes are as good as they are long.
                    double const close = (law == Law::foundation ? 4e-3 : 1e-3) * end;
                    for (int mode = 0; mode < 4; ++mode) {
                        EXPECT_NEAR(found.value(i, Quantity::mode_time, mode), want.value(i, Quantity::mode_time, mode), close)
                            << what << ", mode " << mode;
                    }
                    onsets += want.value(i, Quantity::contact_onsets);
                }
                EXPECT_GE(onsets, 8) << "nothing to see without impacts";
            }
        }
    }
}

std::string name_of_mechanism(::testing::TestParamInfo<Mechanism> const& of) { return std::string(info(of.param).name); }
INSTANTIATE_TEST_SUITE_P(EveryMechanism, ClockedStepsOf,
                         ::testing::Values(Mechanism::slider_crank, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::free_slider), name_of_mechanism);

/// A slider that starts flat bounces flat where its law lets it do so by steps of time: tilts of the size of the step's error would grow a
/// thousandfold with every few landings, and the motion would be another one.
TEST(ClockedSteps, LeaveAFlatSliderFlat) {
    int flat = 0;
    for (Law const law : testing::every_law()) {
        Parts parts{law, testing::dampings_of(info(law)).front()};
        parts.mechanism = Mechanism::free_slider;
        std::vector<Inputs> members;
        for (int i = 0; i < 8; ++i) {
            Inputs in = testing::with_own(testing::golden_start(1e-4, 1, law), law, 50);
            in.z = in.roll = in.yaw = in.pitch = 0;
            in.vy = 0.05 + 0.025 * i;
            members.push_back(in);
        }
        auto const by_time = testing::run(best_isa(), options_of(parts, Method::dopri5, 1e-12, 0.02), members);
        auto const by_clock = testing::run(best_isa(), options_of(parts, Method::verner65, 1e-9, 0.02), members);
        auto const is_flat = [](auto const& state) { return std::ranges::all_of(std::span(state).subspan(4, 6), [](double x) { return x == 0; }); };
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (!is_flat(by_time.states[i])) continue;
            ++flat;
            EXPECT_TRUE(is_flat(by_clock.states[i])) << info(law).name << ' ' << i;
            EXPECT_NEAR(by_clock.states[i][0], by_time.states[i][0], 1e-5 * 1e-4) << info(law).name << ' ' << i;
        }
    }
    EXPECT_GE(flat, 12);
}

TEST(ClockedSteps, BeginInsideImpactsToo) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto members = starts(parts, 8);
    for (auto& in : members) {
        in.y = in.y > 0 ? 1.002 * clearance : -1.002 * clearance;
        in.z = in.roll = in.yaw = in.pitch = 0;
        in.vy = in.vz > 0 ? 0.05 : -0.05;
    }
    members[1].pitch = members[2].roll = 1e-5;
    members[3].y = -clearance - 1e-12;
    auto const run = [&](Method method, double tolerance) {
        auto options = options_of(parts, method, tolerance, 2e-3);
        options.settings.max_steps = 10'000;
        return testing::run(best_isa(), options, members);
    };
    auto const want = run(Method::dopri5, 1e-11), usual = run(Method::dopri5, 1e-9), found = run(Method::verner65, 1e-9);
    for (std::size_t i = 0; i < members.size(); ++i) {
        ASSERT_EQ(want.records[i].status, Status::finished) << i;
        ASSERT_EQ(found.records[i].status, Status::finished) << i;
        EXPECT_LT(distance(found, want, i), std::max(1e-6, 10 * distance(usual, want, i))) << i;
    }
}

/// A pair that parts is left within its face by what its parting is off by: deeper, at loose tolerances, than a touch is located to.  It must
/// not be met there again and again.
TEST(ClockedSteps, LeavePartingsBehindAtLooseTolerances) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto options = options_of(parts, Method::verner65, 1e-2, 0.05);
    options.settings.max_steps = 20'000;
    auto members = testing::scattered_starts(512, clearance, crank_speed, parts.law);
    for (auto& in : members) {
        in.roll = in.yaw = in.pitch = in.vy = in.vz = in.wx = in.wy = in.wz = 0;
        in.chi_line = in.chi_surface = 10;
    }
    auto const r = testing::run(best_isa(), options, members);
    std::vector<double> costs;
    for (auto const& record : r.records) {
        EXPECT_NE(record.status, Status::max_steps);
        costs.push_back(static_cast<double>(record.rhs_evaluations));
    }
    std::ranges::sort(costs);
    EXPECT_LT(costs.back(), 20 * costs[costs.size() / 2]);
}

double percentile95(testing::EnsembleResult const& r) {
    std::vector<double> residuals;
    for (std::size_t i = 0; i < r.records.size(); ++i) residuals.push_back(std::abs(r.value(i, Quantity::energy_residual)));
    std::ranges::sort(residuals);
    return residuals[residuals.size() * 95 / 100];
}

double evaluations(testing::EnsembleResult const& r) {
    double sum = 0;
    for (auto const& record : r.records) sum += static_cast<double>(record.rhs_evaluations);
    return sum / static_cast<double>(r.records.size());
}

TEST(ClockedSteps, NeedFewerEvaluationsForTheSameEnergy) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto const members = starts(parts, 48);
    struct Pair { double by_time, by_clock, share; };
    for (auto const& [time_tolerance, clock_tolerance, share] : {Pair{1e-7, 4e-6, 0.7}, Pair{1e-8, 8e-7, 0.6}}) {
        auto const by_time = testing::run(best_isa(), options_of(parts, Method::dopri5, time_tolerance, 0.05), members);
        auto const by_clock = testing::run(best_isa(), options_of(parts, Method::verner65, clock_tolerance, 0.05), members);
        EXPECT_LT(percentile95(by_clock), percentile95(by_time)) << time_tolerance;
        EXPECT_LT(evaluations(by_clock), share * evaluations(by_time)) << time_tolerance;
    }
}

TEST(ClockedSteps, EndWherePairsTouchWithoutBeingMadeAgain) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto const result = testing::run(best_isa(), options_of(parts, Method::verner65, 1e-4, 0.05), starts(parts, 48));
    double accepted = 0, rejected = 0, onsets = 0;
    for (std::size_t i = 0; i < result.records.size(); ++i) {
        accepted += static_cast<double>(result.records[i].steps_accepted);
        rejected += static_cast<double>(result.records[i].steps_rejected);
        onsets += result.value(i, Quantity::contact_onsets);
    }
    EXPECT_GT(onsets, 500);
    EXPECT_LT(rejected, onsets) << "one step made again for each touch would be more";
    EXPECT_LT(rejected, 0.08 * accepted);
}

/// Integrals run over what is left of a step, and so do those of the accelerations, which nothing else controls.
TEST(ClockedSteps, IntegrateUpToWhereTheyEndEarly) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto const members = starts(parts, 8);
    auto const run = [&](Method method, double tolerance) {
        return testing::run(best_isa(), options_of(parts, method, tolerance, 6e-3), members);
    };
    auto const want = run(Method::dopri5, 1e-11), found = run(Method::verner65, 1e-8);
    struct Integral { Quantity quantity; int columns; double tolerance = 1e-5; };
    for (auto const& [quantity, columns, tolerance] :
         {Integral{Quantity::mean_normal_force, 1}, Integral{Quantity::mean_apex_force, 8}, Integral{Quantity::rms_crank_torque, 1},
          Integral{Quantity::drive_work, 1}, Integral{Quantity::friction_loss, 1}, Integral{Quantity::damping_loss, 1},
          Integral{Quantity::rms_acceleration, 3}, Integral{Quantity::acceleration_area, 2, 1e-3}}) {  // of an absolute value, which has kinks
        for (int column = 0; column < columns; ++column) {
            double largest = 0;
            for (std::size_t i = 0; i < members.size(); ++i) largest = std::max(largest, std::abs(want.value(i, quantity, column)));
            for (std::size_t i = 0; i < members.size(); ++i) {
                EXPECT_NEAR(found.value(i, quantity, column), want.value(i, quantity, column), tolerance * largest)
                    << "quantity " << static_cast<int>(quantity) << ' ' << column << ", member " << i;
            }
        }
    }
}

TEST(ClockedSteps, SampleInsideImpacts) {
    Parts const parts{Law::conservative, Damping::rate, true, false};
    auto const members = starts(parts, 8);
    std::vector<double> times;
    for (int i = 0; i <= 3000; ++i) times.push_back(2e-6 * i);  // an impact takes some 2e-4 s
    auto const sampled = [&](Method method, double tolerance) {
        auto o = options_of(parts, method, tolerance, times.back());
        o.series = selection_of(Series::normal_force);
        o.sample_times = times;
        return testing::run(best_isa(), o, members);
    };
    auto const want = sampled(Method::dopri5, 1e-11), found = sampled(Method::verner65, 1e-8);
    double const highest = *std::ranges::max_element(want.series);
    ASSERT_GT(highest, 100) << "there are impacts [N]";
    for (std::size_t k = 0; k < want.series.size(); ++k) {
        ASSERT_NEAR(found.series[k], want.series[k], 2e-4 * highest) << "sample " << k % times.size();
    }
}

TEST(ContactClock, StepsToTheTimeThatIsAskedFor) {
    // u = 3e-3 √m and δ' = 0.2 m/s: δ = u² + δ' t, and the clock's step is the change of u over δ'.
    ContactClock<double> const sinking{5, 3e-3, 0.2};
    double const time = 1e-5, end = std::sqrt(9e-6 + 0.2 * time);
    EXPECT_NEAR(sinking.own_of(time), (end - 3e-3) / 0.2, 1e-15);
    EXPECT_NEAR(sinking.time_of(sinking.own_of(time)), time, 1e-18);
    // Going out at 0.2 m/s it parts after u²/0.2 s; longer steps take no longer.
    ContactClock<double> const rising{5, 3e-3, -0.2};
    EXPECT_NEAR(rising.time_of(1), 9e-6 / 0.2, 1e-15);
    EXPECT_NEAR(rising.ending(0.0145), 0.015, 1e-15) << "what would nearly get there goes there";
    EXPECT_EQ(rising.ending(0.01), 0.01);
    EXPECT_GT(sinking.way_out(), 1e10);
    ContactClock<double> const none{-1, 0, 0};
    EXPECT_EQ(none.own_of(1e-3), 1e-3);
    EXPECT_EQ(none.time_of(1e-3), 1e-3);
}

TEST(ClockedStep, MovesTimeAndRootTogether) {
    // δ = u² whatever the pace: δ' dt/ds = 2u du/ds.
    double const start = 2e-3, rate = 0.15;
    for (double const deep : {0.0, 1.0}) {
        ClockedStep<double> const step{1e-3, {5, start, rate}, {5, 1.5 * start, rate}, deep};
        for (double const root : {0.5 * start, start, 1.5 * start}) {
            EXPECT_NEAR(rate * step.pace(root), 2 * root * step.root_rate(root, rate), 1e-18) << deep;
        }
        EXPECT_NEAR(step.pace_at_start(), 2 * start, 1e-18);
        // 1.5 √(2/(1 + 1.5²)) where it is deep
        EXPECT_NEAR(step.pace_at_end() / step.pace_at_start(), deep > 0 ? 1.1766968108291043 : 1.5, 1e-14);
    }
    ClockedStep<double> const by_time{1e-3, {-1, 0, 0}, {-1, 0, 0}, 0};
    EXPECT_EQ(by_time.pace_at_end(), 1);
    EXPECT_EQ(by_time.root_rate(0, rate), 0);
}

}  // namespace
}  // namespace slideway::clocked_steps_test
