// The classical method: coefficients against the order conditions, order on a problem with a closed form, and equal steps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernels/steppers/runge_kutta4.hpp"
#include "tests/models/fixed_step.hpp"
#include "tests/models/lorenz.hpp"
#include "tests/unit/steppers/logistic.hpp"

namespace slideway::runge_kutta4_test {
namespace {

constexpr RungeKutta4 w{};

TEST(RungeKutta4, MeetsTheOrderConditions) {
    auto const dot_b = [](auto const& f) {
        double sum = 0;
        for (int i = 0; i < 5; ++i) sum += w.b[i] * f(i);
        return sum;
    };
    auto const a_times = [](int i, auto const& f) {
        double sum = 0;
        for (int j = 0; j < i; ++j) sum += w.a[i][j] * f(j);
        return sum;
    };
    auto const c = [](int i) { return w.c[i]; };
    auto const ac = [&](int i) { return a_times(i, c); };
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(a_times(i, [](int) { return 1.0; }), w.c[i], 1e-15) << "row " << i;
    // Trees of up to four nodes (Hairer, Nørsett & Wanner 1993, II.2).
    EXPECT_NEAR(dot_b([](int) { return 1.0; }), 1, 1e-15);
    EXPECT_NEAR(dot_b(c), 1.0 / 2, 1e-15);
    EXPECT_NEAR(dot_b([&](int i) { return c(i) * c(i); }), 1.0 / 3, 1e-15);
    EXPECT_NEAR(dot_b(ac), 1.0 / 6, 1e-15);
    EXPECT_NEAR(dot_b([&](int i) { return c(i) * c(i) * c(i); }), 1.0 / 4, 1e-15);
    EXPECT_NEAR(dot_b([&](int i) { return c(i) * ac(i); }), 1.0 / 8, 1e-15);
    EXPECT_NEAR(dot_b([&](int i) { return a_times(i, [&](int j) { return c(j) * c(j); }); }), 1.0 / 12, 1e-15);
    EXPECT_NEAR(dot_b([&](int i) { return a_times(i, ac); }), 1.0 / 24, 1e-15);
    // The fifth stage is the end of the step.
    for (int j = 0; j < 4; ++j) EXPECT_EQ(w.a[4][j], w.b[j]);
    EXPECT_EQ(w.c[4], 1.0);
}

double observed_order(auto const& error) { return std::log2(error(0.1) / error(0.05)); }

TEST(RungeKutta4, HasOrderFourOnAnOscillator) { EXPECT_NEAR(observed_order(testing::oscillator_error<RungeKutta4>), 4.0, 0.2); }

TEST(RungeKutta4, CubicInsideTheStepIsOffByTheFourthPower) {
    for (double const theta : {0.1, 0.37, 0.5, 0.8}) {
        auto const local = [theta](double h) { return testing::inner_oscillator_error<RungeKutta4>(h, theta); };
        EXPECT_NEAR(observed_order(local), 4.0, 0.3) << "at " << theta;
    }
}

TEST(RungeKutta4, CubicInsideTheStepMeetsBothEnds) {
    testing::Oscillator<RungeKutta4> o;
    o.step(0.3);
    testing::expect_dense_meets_ends<RungeKutta4>(o, 0.3, 1e-16);
}

/// x' = λ x + t^3, whose equal steps have a closed form per step: R(z) x plus Simpson's rule where λ = 0.
struct Driven {
    struct Inputs {
        double lambda = 0, start = 1;
    };
    static constexpr int size = 1;
    static constexpr bool has_contacts = false;
    template <class Real> struct Parameters { Real lambda; };
    template <class Real> struct Report {};
    template <class Real> using Memory = NoMemory<Real>;
    template <bool Full, class Real>
    static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p, Memory<Real> const&, Real* rates,
                                   Report<Real>*) {
        rates[0] = p.lambda * s[0] + t * t * t;
        return Faults<Real>::none();
    }
    static Parameters<double> parameters(Inputs const& in) { return {in.lambda}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.start; }
};

TEST(FixedStep, IntegratesACubicOfTimeExactly) {
    // Simpson's rule, which the method is where x' depends on t alone, is exact for cubics: x = 1 + t⁴/4.
    Driven::Inputs const in;
    double x = 0;
    fixed_step<Driven, double>({&in, 1, 0.25, 12, &x});
    EXPECT_NEAR(x, 1 + std::pow(3.0, 4) / 4, 1e-13);
}

TEST(FixedStep, EveryMemberHasItsParametersAndItsStart) {
    // Without the drive a step multiplies by R(z) = 1 + z + z²/2 + z³/6 + z⁴/24; start late times cancel it in differences.
    std::vector<Driven::Inputs> in;
    for (int i = 0; i < 7; ++i) in.push_back({-0.3 * i, 1.0 + i});
    std::vector<double> x(7), undisturbed(7);
    fixed_step<Driven, double>({in.data(), 7, 0.5, 3, x.data()});
    for (auto& member : in) member.start = 0;
    fixed_step<Driven, double>({in.data(), 7, 0.5, 3, undisturbed.data()});
    for (int i = 0; i < 7; ++i) {
        double const z = -0.3 * i * 0.5;
        double const growth = std::pow(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4))), 3);
        auto const j = static_cast<std::size_t>(i);
        EXPECT_NEAR(x[j] - undisturbed[j], (1.0 + i) * growth, 1e-14 * (1 + std::abs(x[j]))) << "member " << i;
    }
}

TEST(FixedStep, TakesTheStepsOfTheStepper) {
    Lorenz::Inputs const in;
    double got[3];
    fixed_step<Lorenz, double>({&in, 1, 0.01, 50, got});

    auto const p = Lorenz::parameters(in);
    Lorenz::Report<double> report;
    auto const rates = [&](double const* s, double* d) { Lorenz::derivative<false>(0.0, s, p, {}, d, &report); };
    auto const& pair = pair_numbers<RungeKutta4>();
    double y[3], at[3], k[5][3];
    Lorenz::initial_state(in, y);
    for (int n = 0; n < 50; ++n) {
        rates(y, k[0]);
        for (int s = 1; s < 5; ++s) pair.stage_state(s, y, k, 0.01, at), rates(at, k[s]);
        for (int i = 0; i < 3; ++i) y[i] = at[i];
    }
    for (int i = 0; i < 3; ++i) EXPECT_EQ(got[i], y[i]) << "component " << i;
}

TEST(FixedStep, NoMembersTouchNoMemory) { fixed_step<Lorenz, double>({nullptr, 0, 0.01, 50, nullptr}); }

}  // namespace
}  // namespace slideway::runge_kutta4_test
