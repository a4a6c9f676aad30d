// The steppers as the lanes use them: observed orders, stiff problems, and what a step must not do.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/models/models.hpp"

namespace slideway::steppers_test {
namespace {

using testing::OscillatorInputs;
using testing::TrackerInputs;

constexpr Isa isa = Isa::scalar;

class Steppers : public ::testing::Test {
protected:
    void SetUp() override {
        if (!is_supported(isa)) GTEST_SKIP() << "this machine has no fused multiply-add";
    }
};

/// Exact state of an oscillator: x = C cos ωt + (v/ω) sin ωt + a/(ω² − 1) cos t.
std::array<double, 2> oscillation(OscillatorInputs const& in, double t) {
    double const w = in.frequency, pulled = in.force / (w * w - 1), c = in.x - pulled;
    return {c * std::cos(w * t) + in.v / w * std::sin(w * t) + pulled * std::cos(t),
            -c * w * std::sin(w * t) + in.v * std::cos(w * t) - pulled * std::sin(t)};
}

double error_with(Method method, OscillatorInputs const& in, double step) {
    double const end = 3;
    auto const r = testing::run(isa, testing::equal_steps(method, step, end), std::vector{in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    EXPECT_EQ(r.records[0].steps_rejected, 0u);
    EXPECT_LE(std::abs(static_cast<double>(r.records[0].steps_accepted) - end / step), 5);
    auto const want = oscillation(in, end);
    return std::hypot(r.states[0] - want[0], r.states[1] - want[1]);
}

double observed_order(Method method, OscillatorInputs const& in, double step) {
    return std::log2(error_with(method, in, step) / error_with(method, in, step / 2));
}

TEST_F(Steppers, HaveTheirOrderOnAForcedOscillator) {
    OscillatorInputs const in{.frequency = 2, .force = 1.5, .x = 0.7, .v = -0.4};
    EXPECT_NEAR(observed_order(Method::dopri5, in, 0.05), 5, 0.2);
    EXPECT_NEAR(observed_order(Method::dop853, in, 0.5), 8, 0.3);
    EXPECT_NEAR(observed_order(Method::verner65, in, 0.1), 6, 0.4);
    EXPECT_NEAR(observed_order(Method::bs32, in, 0.01), 3, 0.2);
    EXPECT_NEAR(observed_order(Method::rk4, in, 0.02), 4, 0.2);
    EXPECT_NEAR(observed_order(Method::ros34pw2, in, 0.01), 3, 0.2);
}

TEST_F(Steppers, SamplesOfDop853AreAsGoodAsItsSteps) {
    OscillatorInputs const in{.frequency = 2, .force = 1.5, .x = 0.7, .v = -0.4};
    std::vector<double> times;
    for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);
    auto const largest_error = [&](double step) {
        auto const r = testing::run(isa, testing::equal_steps(Method::dop853, step, 3), std::vector{in}, times);
        double largest = 0;
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const want = oscillation(in, times[k]);
            largest = std::max(largest, std::hypot(r.series[k] - want[0], r.series[times.size() + k] - want[1]));
        }
        return largest;
    };
    // Steps three times as long as the samples are apart: without the continuous extension's own stages this is 1e-3.
    EXPECT_LT(largest_error(0.3), 2e-8);
    EXPECT_NEAR(std::log2(largest_error(0.5) / largest_error(0.25)), 8, 0.7);
}

TEST_F(Steppers, StiffMethodKeepsItsOrderWithAnyJacobian) {
    for (double const jacobian : {0.0, 0.5, 0.9, 1.0, 2.0}) {
        OscillatorInputs const in{.frequency = 2, .force = 1.5, .x = 0.7, .v = -0.4, .jacobian = jacobian};
        EXPECT_NEAR(observed_order(Method::ros34pw2, in, 0.01), 3, 0.2) << jacobian;
    }
}

/// Prothero & Robinson's problem from a consistent start.
double tracking_error(double rate, double step, double by_time = 0, double bends = 0) {
    auto const settings = testing::equal_steps(Method::ros34pw2, step, 2.0);
    auto const r = testing::run(isa, settings, std::vector{TrackerInputs{.rate = rate, .by_time = by_time, .bends = bends}});
    return std::abs(r.states[0] - std::sin(2.0));
}

TEST_F(Steppers, StiffMethodTracksTheBetterTheStiffer) {
    // A stiffly accurate method's error is in proportion to 1/λ where h λ is large.
    for (double const rate : {-1e4, -1e6, -1e8}) {
        EXPECT_NEAR(tracking_error(rate, 0.1) / tracking_error(100 * rate, 0.1), 100, 5) << rate;
    }
    EXPECT_LT(tracking_error(-1e12, 0.1), 1e-14);
    // And falls with h² there, of the three orders of h elsewhere.
    EXPECT_NEAR(std::log2(tracking_error(-1e6, 0.1) / tracking_error(-1e6, 0.05)), 2, 0.2);
    EXPECT_NEAR(std::log2(tracking_error(-1.0, 0.1) / tracking_error(-1.0, 0.05)), 3, 0.2);
}

TEST_F(Steppers, StiffMethodTracksWhatMovesWithTime) {
    // y' = λ (y − sin t) + cos t, whose linearisation has no column for t.  On a linear problem with the exact λ the stages' h²γ_i ∂f/∂t cancel:
    // bᵀ(I − hλ(α + Γ))⁻¹Γ1 = 0.  So errors are those of the same problem with a column (tests/validation/stiff_test.cpp has problems that gain).
    for (double const rate : {-1e4, -1e6, -1e8}) {
        EXPECT_NEAR(tracking_error(rate, 0.1, 1) / tracking_error(100 * rate, 0.1, 1), 100, 5) << rate;
        EXPECT_NEAR(tracking_error(rate, 0.1, 1) / tracking_error(rate, 0.1), 1, 0.05) << rate;
    }
    EXPECT_NEAR(std::log2(tracking_error(-1e6, 0.1, 1) / tracking_error(-1e6, 0.05, 1)), 2, 0.2);
    EXPECT_NEAR(std::log2(tracking_error(-1.0, 0.1, 1) / tracking_error(-1.0, 0.05, 1)), 3, 0.2);
}

TEST_F(Steppers, ABendMovesStagesOfTheStiffMethodAlone) {
    // A shift that is quadratic in t commutes with a method of order 2 on a linear problem, whatever its size: steps end where they did.
    for (double const bends : {1.0, 7.0}) {
        for (double const rate : {-1e6, -1e4, -1.0}) {
            EXPECT_NEAR(tracking_error(rate, 0.1, 1, bends) / tracking_error(rate, 0.1, 1), 1, 1e-3) << rate;
        }
    }
}

TEST_F(Steppers, StiffMethodForgetsAnInconsistentStartAtOnce) {
    // R(∞) = 0: one step of any length brings y onto its track, as far as the track is straight.
    IntegratorSettings settings = testing::equal_steps(Method::ros34pw2, 10.0, 1e-2);
    auto const r = testing::run(isa, settings, std::vector{TrackerInputs{.rate = -1e14, .y = 1000}});
    EXPECT_EQ(r.records[0].steps_accepted, 1u);
    EXPECT_NEAR(r.states[0], std::sin(1e-2), 1e-7);
}

TEST_F(Steppers, AnUnsolvedLinearSystemIsRejected) {
    // γ = 0.4359; whatever the error, no step beyond h = 1e-3/γ counts.
    auto const settings = testing::equal_steps(Method::ros34pw2, 0.1, 1.0);
    auto const r = testing::run(isa, settings, std::vector{TrackerInputs{.solvable_below = 1e-3}});
    EXPECT_EQ(r.records[0].status, Status::finished);
    EXPECT_GE(static_cast<double>(r.records[0].steps_accepted), 0.43586652 / 1e-3);
    EXPECT_GT(r.records[0].steps_rejected, 10u);
    EXPECT_NEAR(r.states[0], std::sin(1.0), 1e-6);
}

TEST_F(Steppers, AMatrixThatIsNeverSolvedEndsTheMember) {
    auto const settings = testing::equal_steps(Method::ros34pw2, 0.1, 1.0);
    for (double const bound : {-1.0, follows}) {
        auto const r = testing::run(isa, settings, std::vector{TrackerInputs{.solvable_below = bound}});
        EXPECT_EQ(r.records[0].status, Status::nonfinite);
        EXPECT_EQ(r.records[0].steps_accepted, 0u);
        EXPECT_EQ(r.records[0].time, 0);
        EXPECT_EQ(r.states[0], 0);
    }
}

TEST_F(Steppers, NoStepEndsWhereThereIsNoDerivative) {
    // sin τ passes 0.5 at π/6.  Beyond the wall every stage is NaN: the steps must close up to it and the member end before.
    double const met = std::asin(0.5);
    for (auto const method : {Method::automatic, Method::dopri5, Method::bs32, Method::ros34pw2, Method::rk4}) {
        auto settings = testing::equal_steps(method, 0.01, 1.0);
        settings.rtol = settings.atol = settings.stiff_tolerance = 1e-6;
        auto const r = testing::run(isa, settings, std::vector{TrackerInputs{.wall = 0.5}});
        EXPECT_EQ(r.records[0].status, Status::nonfinite) << name_of(method);
        EXPECT_LE(r.states[0], 0.5) << name_of(method);
        EXPECT_NEAR(r.states[1], r.records[0].time, 1e-14) << name_of(method);
        EXPECT_NEAR(r.records[0].time, met, method == Method::rk4 ? 0.01 : 1e-5) << name_of(method);
    }
}

TEST_F(Steppers, NoStiffStepEndsBeyondTheWallThatItsStagesMissed) {
    // Without error control long steps end elsewhere than their last stage.
    std::vector<TrackerInputs> members;
    for (int i = 0; i < 300; ++i) {
        for (double const rate : {-1.0, -10.0, -100.0, 5.0})
            members.push_back({.rate = rate, .wall = 0.1 + 0.8 * i / 300});
    }
    auto const r = testing::run(isa, testing::equal_steps(Method::ros34pw2, 0.3, 2.0), members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_LE(r.states[2 * i], members[i].wall) << i;
        EXPECT_EQ(r.records[i].status, Status::nonfinite) << i;
    }
}

TEST_F(Steppers, StiffStepsEndWhereSamplesAreWanted) {
    auto settings = testing::equal_steps(Method::ros34pw2, 0.1, 1.0);
    settings.rtol = settings.atol = settings.stiff_tolerance = 1e-6;
    std::vector<double> const times = {0.0, 0.03, 0.3, 0.3, 0.3 + 1e-9, 0.9, 1.0};
    for (double const rate : {-1e2, -1e5, -1e9}) {
        TrackerInputs const in{.rate = rate, .y = 0.2};  // beside its track: the start is what is sampled at 0
        auto const r = testing::run(isa, settings, std::vector{in}, times);
        EXPECT_EQ(r.series[0], 0.2);
        for (std::size_t i = 0; i < times.size(); ++i) {
            EXPECT_NEAR(r.series[times.size() + i], times[i], 1e-15) << "τ' = 1 tells the time of the sample";
            if (i > 1) {
                EXPECT_NEAR(r.series[i], std::sin(times[i]), 1e-5) << rate << " at " << times[i];
            }
        }
    }
}

TEST_F(Steppers, ASampleIsTheStateOfAStiffRunThatEndsThere) {
    auto settings = testing::equal_steps(Method::ros34pw2, 0.1, 1.0);
    settings.rtol = settings.atol = settings.stiff_tolerance = 1e-5;
    auto const in = std::vector{TrackerInputs{.rate = -50, .y = 0.2}};
    for (double const time : {0.07, 0.31, 0.77}) {
        settings.end_time = 1.0;
        auto const sampled = testing::run(isa, settings, in, {time});
        settings.end_time = time;
        EXPECT_NEAR(sampled.series[0], testing::run(isa, settings, in).states[0], 1e-15);
    }
}

TEST_F(Steppers, AFixedStepEndsAtTheEndTime) {
    for (double const step : {0.1, 0.3, 0.7, 1.0, 5.0}) {
        auto const r = testing::run(isa, testing::equal_steps(Method::rk4, step, 1.0), std::vector{OscillatorInputs{}});
        EXPECT_EQ(r.records[0].status, Status::finished);
        EXPECT_EQ(r.records[0].time, 1.0);
        EXPECT_EQ(r.records[0].steps_accepted, static_cast<std::uint64_t>(std::ceil(1.0 / step - 1e-9))) << step;
    }
}

TEST_F(Steppers, CostWhatTheirStagesCost) {
    // One evaluation at the start; then the stages but the first, which the last step left behind.
    struct {
        Method method;
        unsigned evaluations;
    } const costs[] = {{Method::dopri5, 6}, {Method::bs32, 3}, {Method::ros34pw2, 5}, {Method::rk4, 4}};
    for (auto const& [method, evaluations] : costs) {
        auto settings = testing::equal_steps(method, 0.05, 3.0);
        settings.rtol = settings.atol = settings.stiff_tolerance = 1e-7;
        settings.max_step = settings.stiff_max_step = 1;
        auto const r = testing::run(isa, settings, std::vector{OscillatorInputs{.frequency = 9}});
        auto const& record = r.records[0];
        auto const tried = record.steps_accepted + record.steps_rejected;
        EXPECT_EQ(record.rhs_evaluations, 1 + evaluations * tried) << name_of(method);
        EXPECT_EQ(record.jacobian_evaluations, method == Method::ros34pw2 ? tried : 0) << name_of(method);
        EXPECT_EQ(record.stiff_steps, method == Method::ros34pw2 ? record.steps_accepted : 0) << name_of(method);
    }
}

TEST_F(Steppers, MeetTheToleranceTheyAreGiven) {
    // Global errors of a few cycles: within some ten times the tolerance, and falling with it.
    for (auto const method : {Method::dopri5, Method::bs32, Method::ros34pw2}) {
        double last = 1;
        for (double const tolerance : {1e-4, 1e-6, 1e-8}) {
            auto settings = testing::equal_steps(method, 1.0, 3.0);
            settings.rtol = settings.atol = settings.stiff_tolerance = tolerance;
            OscillatorInputs const in{.frequency = 3, .force = 1, .x = 0.5};
            auto const r = testing::run(isa, settings, std::vector{in});
            auto const want = oscillation(in, 3.0);
            double const error = std::hypot(r.states[0] - want[0], r.states[1] - want[1]);
            EXPECT_LT(error, 30 * tolerance) << name_of(method);
            EXPECT_LT(error, last / 10) << name_of(method);
            last = error;
        }
    }
}

TEST_F(Steppers, StiffToleranceIsAFloorForRingingAlone) {
    // What is faster than the longest step may ring at the stiff tolerance; slow motion meets the other.
    auto settings = testing::equal_steps(Method::ros34pw2, 1.0, 0.0);
    auto const steps = [&](double frequency, double tolerance, double floor) {
        settings.rtol = settings.atol = tolerance;
        settings.stiff_tolerance = floor;
        settings.stiff_max_step = 0.1;
        settings.end_time = 9 / frequency;
        OscillatorInputs const in{.frequency = frequency, .x = 0.5};
        return static_cast<double>(testing::run(isa, settings, std::vector{in}).records[0].steps_accepted);
    };
    EXPECT_LT(steps(1e6, 1e-9, 1e-4), 1.2 * steps(1e6, 1e-4, 1e-4));
    EXPECT_GT(steps(3, 1e-9, 1e-4), 10 * steps(3, 1e-4, 1e-4));
    EXPECT_EQ(steps(3, 1e-3, 1e-6), steps(3, 1e-3, 1e-3));
    EXPECT_GT(steps(3, 1e-6, 1e-6), 3 * steps(3, 1e-4, 1e-4));
}

}  // namespace
}  // namespace slideway::steppers_test
