// The pair's coefficients against the order conditions, and its order on a problem with a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/steppers/dormand_prince.hpp"
#include "kernels/steppers/verner65.hpp"
#include "tests/unit/steppers/logistic.hpp"

namespace slideway::dormand_prince_test {
namespace {

constexpr DormandPrinceTableau w{};

double dot_b(double const* b, auto const& f) {
    double sum = 0;
    for (int i = 0; i < 7; ++i) sum += b[i] * f(i);
    return sum;
}
double a_times(int i, auto const& f) {
    double sum = 0;
    for (int j = 0; j < i; ++j) sum += w.a[i][j] * f(j);
    return sum;
}

TEST(DormandPrince, MeetsTheOrderConditions) {
    auto const one = [](int) { return 1.0; };
    auto const c = [](int i) { return w.c[i]; };
    auto const power = [](int n) { return [n](int i) { return std::pow(w.c[i], n); }; };
    for (int i = 0; i < 7; ++i) EXPECT_NEAR(a_times(i, one), w.c[i], 1e-15) << "row " << i;
    // Trees of up to five nodes (Hairer, Nørsett & Wanner 1993, II.2).
    auto const ac = [&](int i) { return a_times(i, c); };
    auto const ac2 = [&](int i) { return a_times(i, power(2)); };
    auto const ac3 = [&](int i) { return a_times(i, power(3)); };
    auto const aac = [&](int i) { return a_times(i, ac); };
    auto const aac2 = [&](int i) { return a_times(i, ac2); };
    auto const acac = [&](int i) { return a_times(i, [&](int j) { return w.c[j] * ac(j); }); };
    auto const aaac = [&](int i) { return a_times(i, aac); };
    auto const check = [&](double const* b, int order, double zero_or_one) {
        double const u = zero_or_one;
        EXPECT_NEAR(dot_b(b, one), u, 1e-14);
        EXPECT_NEAR(dot_b(b, c), u / 2, 1e-14);
        EXPECT_NEAR(dot_b(b, power(2)), u / 3, 1e-14);
        EXPECT_NEAR(dot_b(b, ac), u / 6, 1e-14);
        EXPECT_NEAR(dot_b(b, power(3)), u / 4, 1e-14);
        EXPECT_NEAR(dot_b(b, [&](int i) { return w.c[i] * ac(i); }), u / 8, 1e-14);
        EXPECT_NEAR(dot_b(b, ac2), u / 12, 1e-14);
        EXPECT_NEAR(dot_b(b, aac), u / 24, 1e-14);
        if (order < 5) return;
        EXPECT_NEAR(dot_b(b, power(4)), 1.0 / 5, 1e-14);
        EXPECT_NEAR(dot_b(b, [&](int i) { return w.c[i] * w.c[i] * ac(i); }), 1.0 / 10, 1e-14);
        EXPECT_NEAR(dot_b(b, [&](int i) { return ac(i) * ac(i); }), 1.0 / 20, 1e-14);
        EXPECT_NEAR(dot_b(b, [&](int i) { return w.c[i] * ac2(i); }), 1.0 / 15, 1e-14);
        EXPECT_NEAR(dot_b(b, ac3), 1.0 / 20, 1e-14);
        EXPECT_NEAR(dot_b(b, [&](int i) { return w.c[i] * aac(i); }), 1.0 / 30, 1e-14);
        EXPECT_NEAR(dot_b(b, acac), 1.0 / 40, 1e-14);
        EXPECT_NEAR(dot_b(b, aac2), 1.0 / 60, 1e-14);
        EXPECT_NEAR(dot_b(b, aaac), 1.0 / 120, 1e-14);
    };
    check(w.b, 5, 1.0);
    // The error weights vanish on every tree of up to four nodes: the embedded method has order 4.
    check(w.e, 4, 0.0);
}

double observed_order(auto const& error) { return std::log2(error(0.2) / error(0.1)); }

TEST(DormandPrince, HasOrderFiveOnAnOscillator) { EXPECT_NEAR(observed_order(testing::oscillator_error<DormandPrince>), 5.0, 0.2); }

TEST(DormandPrince, DenseOutputHasOrderFourInsideTheStep) {
    for (double const theta : {0.1, 0.37, 0.5, 0.8}) {
        auto const local = [theta](double h) { return testing::inner_oscillator_error<DormandPrince>(h, theta); };
        EXPECT_NEAR(observed_order(local), 5.0, 0.3) << "local error of order h^5 at " << theta;
    }
}

TEST(DormandPrince, DenseOutputMeetsBothEnds) {
    testing::Oscillator<DormandPrince> o;
    o.step(0.3);
    testing::expect_dense_meets_ends<DormandPrince>(o, 0.3, 1e-16);
}

/// What lanes with clocks or with ends inside of steps are compiled for has the bits of the numbers that others choose.
template <class Pair> void expect_same_bits() {
    auto const& pair = pair_numbers<Pair>();
    testing::Oscillator<Pair> o;
    o.step(0.7);
    double slope[2], inside[2];
    PairNumbers::combine(pair.e, pair.stages, o.k, slope);
    pair.dense(o.k, o.y, o.end, 0.7, 0.3, inside);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(Pair::error_slope(o.k, i), slope[i]);
        EXPECT_EQ(Pair::dense(o.k, i, o.y[i], o.end[i], 0.7, 0.3), inside[i]);
    }
    Pair::each_stage([&](auto s) {
        double want[2], got[2];
        Pair::template stage_state<s>(o.y, o.k, 0.7, want);
        pair.stage_state(s, o.y, o.k, 0.7, got);
        for (int i = 0; i < 2; ++i) EXPECT_EQ(want[i], got[i]) << "stage " << s;
    });
}

TEST(PairNumbers, HaveTheBitsOfTheirMethods) {
    expect_same_bits<DormandPrince>();
    expect_same_bits<Verner65>();
}

}  // namespace
}  // namespace slideway::dormand_prince_test
