// The pair's coefficients against the order conditions, and its order on a problem with a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/steppers/dormand_prince.hpp"
#include "tests/unit/kernels/logistic.hpp"

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

/// x'' = −x as a system; one fixed step of h from (x, v) with stage derivatives kept.
struct Oscillator {
    double y[2] = {1.0, 0.0}, end[2], k[7][2];

    void step(double h) {
        auto const f = [](double const* s, double* d) { d[0] = s[1], d[1] = -s[0]; };
        f(y, k[0]);
        double at[2];
        DormandPrince::stage_state<1>(y, k, h, at), f(at, k[1]);
        DormandPrince::stage_state<2>(y, k, h, at), f(at, k[2]);
        DormandPrince::stage_state<3>(y, k, h, at), f(at, k[3]);
        DormandPrince::stage_state<4>(y, k, h, at), f(at, k[4]);
        DormandPrince::stage_state<5>(y, k, h, at), f(at, k[5]);
        DormandPrince::stage_state<6>(y, k, h, end), f(end, k[6]);
    }
    void advance() { y[0] = end[0], y[1] = end[1]; }
};

double observed_order(auto const& error) { return std::log2(error(0.2) / error(0.1)); }

TEST(DormandPrince, HasOrderFiveOnAnOscillator) {
    auto const error = [](double h) {
        Oscillator o;
        for (int i = 0; i < static_cast<int>(std::lround(4 / h)); ++i) o.step(h), o.advance();
        return std::hypot(o.y[0] - std::cos(4.0), o.y[1] + std::sin(4.0));
    };
    EXPECT_NEAR(observed_order(error), 5.0, 0.2);
}

TEST(DormandPrince, DenseOutputHasOrderFourInsideTheStep) {
    for (double const theta : {0.1, 0.37, 0.5, 0.8}) {
        auto const local = [theta](double h) {
            Oscillator o;
            o.step(h);
            double const x = DormandPrince::dense(o.k, 0, o.y[0], o.end[0], h, theta);
            double const v = DormandPrince::dense(o.k, 1, o.y[1], o.end[1], h, theta);
            return std::hypot(x - std::cos(theta * h), v + std::sin(theta * h));
        };
        EXPECT_NEAR(observed_order(local), 5.0, 0.3) << "local error of order h^5 at " << theta;
    }
}

TEST(DormandPrince, DenseOutputMeetsBothEnds) {
    Oscillator o;
    o.step(0.3);
    testing::expect_dense_meets_ends<DormandPrince>(o, 0.3, 1e-16);
}

}  // namespace
}  // namespace slideway::dormand_prince_test
