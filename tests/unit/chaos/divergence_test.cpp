#include "host/chaos/divergence.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::divergence_test {
namespace {

struct Embedding {
    std::size_t delay, dimension, theiler, longest;
    double period;
};

std::optional<Growth> growth_of(std::vector<double> const& series, double spacing, Embedding const& e) {
    DelayEmbedding const embedding(series, e.delay, e.dimension);
    DivergenceCurve const curve = divergence_curve(embedding, e.theiler, e.longest);
    auto const window = growth_window(curve, embedding.span(), e.period);
    return window ? fit_growth(curve, *window, spacing) : std::nullopt;
}

constexpr Embedding flow{17, 5, 150, 500, 150}, map{1, 3, 4, 50, 4};

TEST(Divergence, OfLorenzIsItsExponent) {
    // 5,000 points are 50 units of time: single stretches scatter by a tenth about the exponent, so take the mean of ten.
    double mean = 0, worst = 0, error = 0;
    for (int i = 1; i <= 10; ++i) {
        auto const growth = growth_of(lorenz_series(5000, 0.01, i), 0.01, flow);
        ASSERT_TRUE(growth);
        mean += growth->exponent / 10;
        worst = std::max(worst, std::abs(growth->exponent / 0.9056 - 1));
        EXPECT_GT(growth->line.r_squared, 0.98);
        EXPECT_LT(std::abs(growth->exponent - 0.9056), 3 * growth->error) << i;
        error += growth->error / 10;
    }
    EXPECT_LT(error, 0.25);
    EXPECT_NEAR(mean / 0.9056, 1, 0.1);
    EXPECT_LT(worst, 0.35);
}

TEST(Divergence, OfALongerLorenzSeriesIsItsExponent) {
    auto const growth = growth_of(lorenz_series(20000, 0.01), 0.01, flow);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent / 0.9056, 1, 0.1);
}

TEST(Divergence, OfTheLogisticMapIsTheLogarithmOfTwo) {
    auto const growth = growth_of(logistic_series(3000, 4), 1, map);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent, std::log(2), 0.02);
    // Per unit of time, not per sample.
    EXPECT_NEAR(growth_of(logistic_series(3000, 4), 0.1, map)->exponent, 10 * std::log(2), 0.2);
}

TEST(Divergence, OfHenonsMapIsItsExponent) {
    auto const growth = growth_of(henon_series(3000), 1, {1, 2, 4, 50, 3});
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent / 0.419, 1, 0.05);
}

TEST(Divergence, OfPeriodicMotionIsNone) {
    std::vector<std::vector<double>> const series{
        sine_series(5000, 62.83), sine_series(5000, 50),  // the second repeats to rounding
        sum(sine_series(5000, 62.83), sine_series(5000, 62.83 / std::numbers::sqrt2, 0.5)),
        sum(sine_series(5000, 62.83), sine_series(5000, 62.83 / 3))};
    for (auto const& x : series) {
        auto const growth = growth_of(x, 1, {15, 5, 63, 600, 60});
        EXPECT_LT(growth ? growth->rise : 0, 0.3);
    }
    auto const cycle = growth_of(logistic_series(3000, 3.55), 1, map);
    EXPECT_LT(cycle ? cycle->rise : 0, 0.1);
}

TEST(Divergence, OfNoiseHasNoLine) {
    // Distances jump to those of strangers at once.
    EXPECT_FALSE(growth_of(white_series(3000), 1, map));
}

TEST(Divergence, RepeatedPointsMakeNoInfinity) {
    auto series = lorenz_series(3000, 0.01);
    for (double& x : series) x = std::round(x);
    DivergenceCurve const curve = divergence_curve(DelayEmbedding(series, 17, 3), 100, 300);
    ASSERT_EQ(curve.mean_log.size(), 301u);
    for (std::size_t k = 0; k < curve.mean_log.size(); ++k) {
        EXPECT_TRUE(std::isfinite(curve.mean_log[k])) << k;
        EXPECT_LE(curve.pairs[k], curve.pairs[0]) << k;
    }
    EXPECT_LT(curve.pairs[50], curve.pairs[0]);  // some have met
    EXPECT_TRUE(std::isfinite(curve.saturation));
}

TEST(Divergence, OfAConstantOrAShortSeriesIsEmpty) {
    std::vector<double> const constant(500, 1.0);
    EXPECT_TRUE(divergence_curve(DelayEmbedding(constant, 1, 2), 1, 50).mean_log.empty());
    auto const series = white_series(50);
    EXPECT_TRUE(divergence_curve(DelayEmbedding(series, 1, 2), 1, 50).mean_log.empty());
    EXPECT_FALSE(growth_window({}, 1, 1));
    EXPECT_FALSE(fit_growth({}, {0, 5}, 1));
}

/// A steep start, a line of the slope 0.01 with a swing of the period 40, and saturation.
DivergenceCurve made_curve() {
    DivergenceCurve curve{{}, {}, 3, {}};
    for (int k = 0; k < 800; ++k) {
        double const line = -4 + 0.01 * k + 0.05 * std::sin(2 * std::numbers::pi * k / 40);
        double const start = 0.5 * std::exp(-k / 10.0);
        curve.mean_log.push_back(std::min(line - start, 3.0));
        curve.pairs.push_back(1000);
    }
    curve.without.assign(10, curve.mean_log);
    return curve;
}

TEST(GrowthWindow, IsTheLineBetweenStartAndSaturation) {
    DivergenceCurve const curve = made_curve();
    auto const window = growth_window(curve, 60, 40);
    ASSERT_TRUE(window);
    EXPECT_GE(window->first, 30u);  // half of the embedding window
    EXPECT_LE(window->last, 560u);  // 0.7 of the way up
    EXPECT_GE(window->last - window->first + 1, 60u);
    auto const growth = fit_growth(curve, *window, 0.1);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent, 0.1, 0.001);
    EXPECT_NEAR(growth->error, 0, 1e-12);  // no part differs
}

TEST(GrowthWindow, IsTheUsersIfGiven) {
    DivergenceCurve const curve = made_curve();
    auto const growth = fit_growth(curve, {750, 799}, 1);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent, 0, 1e-12);
    EXPECT_FALSE(fit_growth(curve, {750, 800}, 1));
    EXPECT_FALSE(fit_growth(curve, {7, 7}, 1));
}

TEST(Growth, OfALineIsBeyondAPowerOfTimeAndOfALogarithmNot) {
    auto const grown = [](auto law) {
        DivergenceCurve curve{{}, {}, 9, {}};
        for (int k = 0; k < 200; ++k) {
            curve.mean_log.push_back(law(k) + 0.02 * std::sin(k));
            curve.pairs.push_back(9);
        }
        curve.without.assign(10, curve.mean_log);
        return fit_growth(curve, {40, 199}, 1)->is_beyond_a_power();
    };
    EXPECT_TRUE(grown([](int k) { return 0.01 * k; }));
    for (double const power : {0.5, 1.0, 2.0}) EXPECT_FALSE(grown([&](int k) { return power * std::log1p(k); })) << power;
    EXPECT_FALSE(grown([](int) { return 1.0; }));
}

TEST(Growth, ErrorIsThatOfTheJackknife) {
    // Slopes 1 … 10 of the rests: (n-1)/n Σ(s - s̄)² = 0.9·82.5.
    DivergenceCurve curve{{0, 1, 2}, {9, 9, 9}, 5, {}};
    for (int s = 1; s <= 10; ++s) curve.without.push_back({0, 1.0 * s, 2.0 * s});
    EXPECT_NEAR(fit_growth(curve, {0, 2}, 1)->error, std::sqrt(0.9 * 82.5), 1e-12);
}

}  // namespace
}  // namespace slideway::testing::divergence_test
