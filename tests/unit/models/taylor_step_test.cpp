// Steps of Taylor series on a problem in closed form, alone and through the lanes.
#include "tests/models/taylor_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/integrate.hpp"
#include "tests/models/plain_model.hpp"
#include "tests/unit/steppers/logistic.hpp"

namespace slideway::taylor_step_test {
namespace {

/// y' = r (y (1 − y) + b cos t), τ' = 1: the logistic equation where b is 0.
struct Growth : Analytic<PlainModel<2>> {
    struct Inputs { double start = 0.2, rate = 1, force = 0; };
    template <class Real> struct Parameters { Real rate, force; };

    template <bool Full, class Real>
    static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p, Memory<Real> const&, Real* rates, Report<Real>*) {
        rates[0] = p.rate * fma(p.force, sincos(t).cos, s[0] * (Real(1.0) - s[0]));
        rates[1] = Real(1.0);
        return Faults<Real>::none();
    }
    static Parameters<double> parameters(Inputs const& in) { return {in.rate, in.force}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.start, s[1] = 0; }
};

/// x'' = −x, a sine, of whose coefficients at x = 0 every other one is 0.
struct Swing : Analytic<PlainModel<2>> {
    struct Inputs { double x = 0, v = 1; };
    template <class Real> struct Parameters { Real stiffness; };
    template <bool Full, class Real>
    static Faults<Real> derivative(Real, Real const* s, Parameters<Real> const& p, Memory<Real> const&, Real* rates, Report<Real>*) {
        rates[0] = s[1];
        rates[1] = negated(p.stiffness * s[0]);
        return Faults<Real>::none();
    }
    static Parameters<double> parameters(Inputs const&) { return {1}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.x, s[1] = in.v; }
};

double exact(double t) { return testing::Logistic<DormandPrince>::exact(t); }

/// What one step of a method comes to.
template <int order> struct OneStep {
    double end, error, inside;
    explicit OneStep(double h, double theta = 0.4) {
        Pack<Growth, double> pack{Growth{}};
        pack.needs = {};
        pack.state.constants.parameters = Growth::parameters({});
        auto& c = pack.state.course;
        c.t = 0;
        Growth::initial_state({}, c.y);
        TaylorStep<order, Growth, double> stepper;
        Attempt<Growth, double> attempt;
        attempt.step = h;
        stepper.attempt(pack, pack.start(), attempt);
        end = attempt.end[0];
        double state[2], errors[2];
        stepper.errors(attempt, errors);
        error = errors[0];
        stepper.dense(pack.start(), attempt, theta, state);
        inside = std::abs(state[0] - exact(theta * h));
    }
};

template <int order> void expect_order() {
    auto const local = [](double h) { return std::abs(OneStep<order>(h).end - exact(h)); };
    auto const estimate = [](double h) { return OneStep<order>(h).error; };
    auto const inside = [](double h) { return OneStep<order>(h).inside; };
    // Over two halvings, for coefficients of the logistic function come and go.
    auto const fallen = [](auto const& error, double h) { return 0.5 * std::log2(error(h) / error(h / 4)); };
    EXPECT_NEAR(fallen(local, 2), order + 1, 1.0);
    EXPECT_NEAR(fallen(inside, 2), order + 1, 1.0);
    // The last term, or in steps so short that it is the smaller a part of the one before.
    EXPECT_NEAR(fallen(estimate, 2), order - 0.5, 0.8);
}

TEST(TaylorStep, HasTheOrderOfItsSeriesAndAnEstimateOfItsLastTerms) {
    expect_order<6>();
    expect_order<8>();
    expect_order<9>();
    expect_order<12>();
}

struct Finished {
    MemberRecord record;
    double state[2];
    std::vector<double> samples;
};

template <class Model> Finished integrated(typename Model::Inputs const& in, double tolerance, double end, std::vector<double> times = {}) {
    Finished f;
    f.samples.resize(2 * times.size());
    BlockOf<typename Model::Inputs> block;
    block.inputs = &in;
    block.members = 1;
    block.settings = {.rtol = tolerance, .atol = tolerance, .end_time = end};
    block.sample_times = times.data();
    block.samples = times.size();
    block.series = 3;
    block.series_values = f.samples.data();
    block.records = &f.record;
    block.final_states = f.state;
    integrate<Model, double>(block);
    return f;
}

TEST(TaylorStep, MeetsItsToleranceAtEveryOrderOfTheLadder) {
    for (double const tolerance : {1e-3, 1e-6, 1e-8, 1e-9, 1e-11, 1e-12, 1e-14}) {
        auto const f = integrated<Growth>({}, tolerance, 5);
        ASSERT_EQ(f.record.status, Status::finished);
        EXPECT_NEAR(f.state[0], exact(5), 2 * tolerance + 1e-15) << tolerance;
    }
}

TEST(TaylorStep, TakesFewStepsAtTightTolerances) {
    auto const steps = [](double tolerance) { return integrated<Growth>({}, tolerance, 20).record.steps_accepted; };
    EXPECT_LT(static_cast<double>(steps(1e-13)), 1.6 * static_cast<double>(steps(1e-9))) << "the order grows instead";
}

TEST(TaylorStep, SamplesInsideStepsAreAsGoodAsTheirEnds) {
    std::vector<double> times;
    for (int i = 1; i < 100; ++i) times.push_back(0.05 * i);
    auto const f = integrated<Growth>({}, 1e-12, 5, times);
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(f.samples[i], exact(times[i]), 2e-12) << times[i];
}

TEST(TaylorStep, KnowsTheTime) {
    // A force that depends on it, against another method.
    Growth::Inputs const in{.rate = 0.7, .force = 0.3};
    auto const f = integrated<Growth>(in, 1e-13, 6);
    BlockOf<Growth::Inputs> block;
    MemberRecord record;
    double state[2];
    block.inputs = &in;
    block.members = 1;
    block.settings = {.method = Method::dop853, .rtol = 1e-13, .atol = 1e-13, .end_time = 6};
    block.records = &record;
    block.final_states = state;
    integrate<Growth, double>(block);
    EXPECT_NEAR(f.state[0], state[0], 1e-12);
    EXPECT_NEAR(f.state[1], 6, 1e-12);
}

TEST(TaylorStep, SymmetryThatTakesTheLastTermAwayDoesNotTakeTheError) {
    // At x = 0 every even coefficient of x vanishes, and of v every odd one.
    for (double const tolerance : {1e-4, 1e-8, 1e-12}) {
        auto const f = integrated<Swing>({}, tolerance, 10);
        EXPECT_NEAR(f.state[0], std::sin(10.0), 20 * tolerance) << tolerance;
    }
}

TEST(TaylorStep, AMemberThatGrowsBeyondAllBoundsEndsWithAStatus) {
    // From below 0 the logistic equation goes to −∞ at t = ln(1 − 1/y₀).
    auto const f = integrated<Growth>({.start = -0.5}, 1e-9, 5);
    EXPECT_NE(f.record.status, Status::finished);
    EXPECT_NEAR(f.record.time, std::log(3.0), 1e-3);
}

}  // namespace
}  // namespace slideway::taylor_step_test
