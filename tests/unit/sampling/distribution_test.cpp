#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/sampling/distribution.hpp"
#include "tests/unit/sampling/samples.hpp"

namespace slideway::distribution_test {
namespace {

using Kind = Distribution::Kind;
using testing::normal_cdf;

Distribution triangular(double low, double mode, double high) { return {Kind::triangular, 0, 0, low, high, mode}; }
Distribution lognormal(double mean, double sd, double low = 0) { return {Kind::lognormal, mean, sd, low}; }
Distribution weibull(double scale, double shape, double low = 0) {
    return {Kind::weibull, 0, 0, low, 0, 0, scale, shape};
}
Distribution uniform(double low, double high) { return {Kind::uniform, 0, 0, low, high}; }
Distribution truncated(double mean, double sd, double low, double high) {
    return {Kind::truncated_normal, mean, sd, low, high};
}
Distribution values(std::vector<double> list) {
    Distribution distribution{Kind::values};
    distribution.list = std::move(list);
    return distribution;
}

std::vector<double> const probabilities = {0x1p-53, 1e-9, 1e-3, 0.1, 0.25, 0.3, 0.5, 0.7, 0.9, 0.999, 1 - 1e-9};

TEST(Distribution, TriangularQuantilesInvertItsParabolas) {
    Distribution const d = triangular(-1, 0.5, 4);  // Φ(mode) = 1.5/5
    for (double const u : probabilities) {
        double const x = d.quantile(u);
        double const cdf = x < 0.5 ? (x + 1) * (x + 1) / 7.5 : 1 - (4 - x) * (4 - x) / 17.5;
        EXPECT_NEAR(cdf, u, 4e-16) << u;
    }
    EXPECT_NEAR(d.quantile(0.3), 0.5, 1e-14);
    // A mode on a bound: one straight side.
    EXPECT_NEAR(triangular(0, 0, 1).quantile(0.75), 0.5, 1e-15);
    EXPECT_NEAR(triangular(0, 1, 1).quantile(0.25), 0.5, 1e-15);
}

TEST(Distribution, WeibullQuantilesInvertItsExponential) {
    Distribution const d = weibull(2, 1.5);
    for (double const u : probabilities) {
        EXPECT_NEAR(-std::expm1(-std::pow(d.quantile(u) / 2, 1.5)) / u, 1, 2e-15) << u;
        EXPECT_EQ(weibull(2, 1.5, 3).quantile(u), 3 + d.quantile(u)) << u;
    }
    EXPECT_NEAR(weibull(2, 1).quantile(0.5), 2 * std::numbers::ln2, 1e-15);  // exponential
    EXPECT_NEAR(weibull(2, 2).quantile(1 - std::exp(-1)), 2, 1e-15);         // Rayleigh
}

TEST(Distribution, LognormalLogarithmsAreNormal) {
    double const e = std::numbers::e;
    // sd² = mean² (e^(σ²) − 1): mean e^½ and sd e^½ √(e − 1) are those of μ = 0, σ = 1.
    Distribution const d = lognormal(std::sqrt(e), std::sqrt(e * (e - 1)));
    EXPECT_NEAR(d.quantile(0.5), 1, 1e-15);
    EXPECT_NEAR(std::log(d.quantile(0.975)), 1.959963984540054, 1e-14);
    EXPECT_NEAR(std::log(d.from_standard_normal(-3)), -3, 1e-14);
    Distribution const shifted = lognormal(std::sqrt(e) + 10, std::sqrt(e * (e - 1)), 10);
    EXPECT_NEAR(shifted.quantile(0.5), 11, 2e-15 * 11);
}

TEST(Distribution, ListedValuesAreEquallyLikely) {
    Distribution const d = values({3, -1, 7, 2});
    EXPECT_EQ(d.quantile(0x1p-53), 3);
    EXPECT_EQ(d.quantile(0.25 - 0x1p-53), 3);
    EXPECT_EQ(d.quantile(0.25), -1);
    EXPECT_EQ(d.quantile(0.5), 7);
    EXPECT_EQ(d.quantile(0.75), 2);
    EXPECT_EQ(d.quantile(1 - 0x1p-53), 2);
    EXPECT_EQ(d.from_standard_normal(-9), 3);
    EXPECT_EQ(d.from_standard_normal(-0.1), -1);
    EXPECT_EQ(d.from_standard_normal(9), 2);
    EXPECT_EQ(values({5}).quantile(0.99), 5);
}

struct Moments {
    double mean, sd;
};

/// ∫ Q(Φ(z)) φ(z) dz and the like by the trapezoidal rule, which converges exponentially for smooth integrands.
Moments moments(std::function<double(double)> const& value_at) {
    double const h = 1.0 / 4096;
    double mean = 0, square = 0;
    auto const density = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); };
    for (int i = -8 * 4096; i <= 8 * 4096; ++i) mean += h * density(i * h) * value_at(i * h);
    for (int i = -8 * 4096; i <= 8 * 4096; ++i) {
        double const x = value_at(i * h) - mean;
        square += h * density(i * h) * x * x;
    }
    return {mean, std::sqrt(square)};
}

void expect_moments(Distribution const& d, Moments const& expected, double tolerance = 1e-8) {
    Moments const by_quantile = moments([&](double z) { return d.quantile(normal_cdf(z)); });
    Moments const by_normal = moments([&](double z) { return d.from_standard_normal(z); });
    for (Moments const& found : {by_quantile, by_normal}) {
        EXPECT_NEAR(found.mean, expected.mean, tolerance * (std::abs(expected.mean) + expected.sd));
        EXPECT_NEAR(found.sd, expected.sd, tolerance * expected.sd);
    }
}

TEST(Distribution, MomentsAreThoseGiven) {
    expect_moments({Kind::normal, 3, 0.25}, {3, 0.25});
    expect_moments(lognormal(5, 2), {5, 2});
    expect_moments(lognormal(5, 2, -4), {5, 2});
    expect_moments(lognormal(1e-4, 1e-5), {1e-4, 1e-5});
}

TEST(Distribution, MomentsAreThoseOfTheFormulas) {
    expect_moments(uniform(-2, 3), {0.5, 5 / std::sqrt(12.0)});
    double const a = -1, b = 4, c = 0.5;
    expect_moments(triangular(a, c, b),
                   {(a + b + c) / 3, std::sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18)},
                   1e-6);  // a kink at the mode
    double const mean = std::tgamma(1 + 1 / 1.5);
    expect_moments(weibull(2, 1.5, 3), {3 + 2 * mean, 2 * std::sqrt(std::tgamma(1 + 2 / 1.5) - mean * mean)});
    // Cut symmetrically at ±1 sd: variance 1 − 2 φ(1)/(Φ(1) − Φ(−1)).
    double const density = std::exp(-0.5) / std::sqrt(2 * std::numbers::pi);
    expect_moments(truncated(2, 3, -1, 5), {2, 3 * std::sqrt(1 - 2 * density / (normal_cdf(1) - normal_cdf(-1)))});
    expect_moments(values({1, 2, 6}), {3, std::sqrt(14.0 / 3)}, 2e-4);  // steps
}

TEST(Distribution, StandardNormalsMapByTheirProbability) {
    std::vector<Distribution> const all = {uniform(-2, 3),      triangular(-1, 0.5, 4),   {Kind::normal, 3, 2},
                                           lognormal(5, 2, -1), truncated(1, 2, -1, 1.5), weibull(2, 1.5, 3)};
    for (Distribution const& d : all) {
        for (double z = -5; z <= 4; z += 0.125) {
            double const expected = d.quantile(normal_cdf(z));
            EXPECT_NEAR(d.from_standard_normal(z), expected, 1e-10 * std::abs(expected) + 1e-12)
                << static_cast<int>(d.kind) << " " << z;
        }
    }
    Distribution const normal{Kind::normal, 3, 2};
    EXPECT_EQ(normal.from_standard_normal(8.75), 20.5);
    EXPECT_EQ((Distribution{Kind::constant, 4}.from_standard_normal(2)), 4);
}

TEST(Distribution, UpperTailsMirrorTheLowerOnes) {
    for (double z = 0; z <= 9; z += 0.25) {
        double const tail = std::erfc(z / std::sqrt(2.0)) / 2;  // Φ(−z); near its bound 0 a value has all its digits
        EXPECT_NEAR(uniform(-1, 0).from_standard_normal(z) / -tail, 1, 1e-14) << z;
        EXPECT_EQ(triangular(-3, -2, 0).from_standard_normal(z), -triangular(0, 2, 3).from_standard_normal(-z)) << z;
        EXPECT_NEAR(truncated(1, 2, -1, 4).from_standard_normal(z), -truncated(-1, 2, -4, 1).from_standard_normal(-z),
                    1e-14)
            << z;
        EXPECT_NEAR(weibull(1, 1).from_standard_normal(z) / -std::log(tail), 1, 1e-14) << z;  // exponential
    }
    // Uncut on the side of interest, the cut normal is the normal to all digits that z has.
    EXPECT_NEAR(truncated(0, 1, -40, 40).from_standard_normal(9), 9, 1e-14);
}

TEST(Distribution, CutTailsKeepTheirDigits) {
    // Q(Φ(z)) = x has (Φ(−x) − Φ(−b))/(Φ(−a) − Φ(−b)) = Φ(−z), here in extended precision.
    auto const tail = [](long double z) { return std::erfc(z / std::sqrt(2.0L)); };
    for (double z = 0; z <= 6; z += 0.25) {
        double const x = truncated(0, 1, 3, 8).from_standard_normal(z);
        long double const expected = tail(z) / 2;
        long double const found = (tail(x) - tail(8)) / (tail(3) - tail(8));
        EXPECT_NEAR(static_cast<double>(found / expected), 1, 2e-14) << z;
    }
}

TEST(Distribution, ExtremesAreFiniteAndWithinTheSupport) {
    double const most = std::numeric_limits<double>::max();
    struct Case {
        Distribution distribution;
        double low, high;
    };
    std::vector<Case> const cases = {{uniform(-1e-5, 1e-5), -1e-5, 1e-5},
                                     {triangular(1e-4, 1e-4, 2e-4), 1e-4, 2e-4},
                                     {triangular(1, 1 + 1e-15, 1 + 2e-15), 1, 1 + 2e-15},
                                     {{Kind::normal, 0, 1}, -9, 9},
                                     {lognormal(1, 1e-9), 0.99, 1.01},
                                     {lognormal(1, 1e200), 0, most},
                                     {lognormal(3, 1, 2), 2, most},
                                     {weibull(1, 1e-3), 0, most},
                                     {weibull(1, 500, -1), -1, 1},
                                     {truncated(0, 1, 30, 31), 30, 31},
                                     {truncated(0, 1, -31, -30), -31, -30},
                                     {truncated(0, 1, -1000, -30), -1000, -30},
                                     {truncated(0, 1, 30, 1000), 30, 1000},
                                     {truncated(0, 1e-3, -1, 1), -1, 1},
                                     {values({1, 2, 3}), 1, 3}};
    for (auto const& [d, low, high] : cases) {
        auto const expect_within = [&d = d, low = low, high = high](double x, double at) {
            EXPECT_TRUE(std::isfinite(x) && x >= low && x <= high)
                << static_cast<int>(d.kind) << " " << at << ": " << x;
        };
        for (double const u : {0x1p-53, 3 * 0x1p-53, 0.5 - 0x1p-53, 0.5 + 0x1p-53, 1 - 3 * 0x1p-53, 1 - 0x1p-53}) {
            expect_within(d.quantile(u), u);
        }
        for (double z = -9; z <= 9; z += 0.5) expect_within(d.from_standard_normal(z), z);
        if (d.kind == Kind::normal) continue;
        for (double const z : {-1e3, -38.0, 38.0, 1e3}) expect_within(d.from_standard_normal(z), z);
    }
}

TEST(Distribution, QuantilesDoNotFall) {
    for (Distribution const& d : {uniform(-2, 3), triangular(-1, 0.5, 4), lognormal(5, 2), truncated(1, 2, -1, 1.5),
                                  weibull(2, 0.7), values({1, 2, 3})}) {
        double last = -std::numeric_limits<double>::infinity();
        for (double z = -9; z <= 9; z += 1.0 / 64) {
            double const x = d.from_standard_normal(z);
            EXPECT_GE(x, last - 1e-15 * std::abs(x)) << static_cast<int>(d.kind) << " " << z;
            last = x;
        }
    }
}

}  // namespace
}  // namespace slideway::distribution_test
