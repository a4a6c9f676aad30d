#include "host/chaos/delay_embedding.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::cc_method_test {
namespace {

double deviation(std::vector<double> const& x) {
    double mean = 0, squares = 0;
    for (double const value : x) mean += value / static_cast<double>(x.size());
    for (double const value : x) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(x.size() - 1));
}

/// C(m, N, r) by its definition.
double correlation_integral(std::vector<double> const& x, std::size_t m, double r) {
    std::size_t const points = x.size() - (m - 1);
    double within = 0;
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t j = i + 1; j < points; ++j) {
            double distance = 0;
            for (std::size_t k = 0; k < m; ++k) distance = std::max(distance, std::abs(x[i + k] - x[j + k]));
            within += distance <= r;
        }
    }
    return 2 * within / static_cast<double>(points * (points - 1));
}

/// S(m, N, r, t) by its definition.
double dependence(std::vector<double> const& x, std::size_t m, double r, std::size_t t) {
    double sum = 0;
    for (std::size_t s = 0; s < t; ++s) {
        std::vector<double> part;
        for (std::size_t i = s; part.size() < x.size() / t; i += t) part.push_back(x[i]);
        sum += correlation_integral(part, m, r) - std::pow(correlation_integral(part, 1, r), static_cast<double>(m));
    }
    return sum / static_cast<double>(t);
}

TEST(CcMethod, CurvesAreThoseOfTheDefinition) {
    auto const series = lorenz_series(150, 0.03);
    double const sigma = deviation(series);
    CcCurves const curves = cc_curves(series, {.longest = 7});
    ASSERT_EQ(curves.mean.size(), 7u);
    for (std::size_t t = 1; t <= 7; ++t) {
        double mean = 0, spread = 0;
        for (std::size_t m = 2; m <= 5; ++m) {
            double low = 1, high = -1;
            for (int j = 1; j <= 4; ++j) {
                double const s = dependence(series, m, j * sigma / 2, t);
                mean += s / 16;
                low = std::min(low, s);
                high = std::max(high, s);
            }
            spread += (high - low) / 4;
        }
        EXPECT_NEAR(curves.mean[t - 1], mean, 1e-12) << t;
        EXPECT_NEAR(curves.spread[t - 1], spread, 1e-12) << t;
        EXPECT_NEAR(curves.correlation[t - 1], spread + std::abs(mean), 1e-12) << t;
    }
}

TEST(CcMethod, DelayOfLorenzIsThePublishedOne) {
    // 0.16 to 0.20 by Kim, Eykholt and Salas; here 3,000 points of x with (10, 28, 8/3), 0.01 apart.
    for (double const start : {1.0, 2.0, -4.0}) {
        CcChoice const choice = cc_choice(cc_curves(lorenz_series(3000, 0.01, start), {.longest = 60}));
        ASSERT_TRUE(choice.delay());
        EXPECT_GE(*choice.delay(), 16u) << start;
        EXPECT_LE(*choice.delay(), 20u) << start;
        EXPECT_EQ(choice.delay(), choice.first_minimum);
    }
}

TEST(CcMethod, NoiseHasNoDependence) {
    CcCurves const curves = cc_curves(white_series(3000), {.longest = 20});
    for (double const s : curves.mean) EXPECT_NEAR(s, 0, 0.01);
    // A sine depends on its past at all delays.
    CcCurves const sine = cc_curves(sine_series(3000, 40.7), {.longest = 20});
    for (double const s : sine.mean) EXPECT_GT(s, 0.05);
}

TEST(CcMethod, ReadsItsCurves) {
    CcCurves curves;
    curves.mean = {0.5, 0.4, 0.3, 0.1, 0.05, -0.01, 0.02, -0.1, 0.03};
    // The dip at 2 is not the least within two samples; that at 5 is.
    curves.spread = {0.5, 0.3, 0.31, 0.2, 0.1, 0.2, 0.15, 0.02, 0.3};
    for (std::size_t i = 0; i < 9; ++i) curves.correlation.push_back(curves.spread[i] + std::abs(curves.mean[i]));
    CcChoice const choice = cc_choice(curves);
    EXPECT_EQ(choice.first_zero, 6u);
    EXPECT_EQ(choice.first_minimum, 5u);
    EXPECT_EQ(choice.window, 8u);
    EXPECT_EQ(choice.delay(), 5u);
    curves.spread = {9, 8, 7, 6, 5, 4, 3, 2, 1};
    EXPECT_EQ(cc_choice(curves).first_minimum, std::nullopt);
    EXPECT_EQ(cc_choice(curves).delay(), 6u);
}

TEST(CcMethod, UsesNoMorePointsThanAllowed) {
    auto const series = lorenz_series(500, 0.03);
    std::vector<double> const beginning(series.begin(), series.begin() + 200);
    CcCurves const cut = cc_curves(series, {.longest = 5, .max_points = 200}),
                   whole = cc_curves(beginning, {.longest = 5});
    EXPECT_EQ(cut.points, 200u);
    EXPECT_EQ(cut.mean, whole.mean);
    EXPECT_EQ(cc_curves(beginning).mean.size(), 20u);  // parts of ten samples
}

TEST(CcMethod, OfAConstantIsEmpty) {
    EXPECT_TRUE(cc_curves(std::vector<double>(100, 2.0)).mean.empty());
    EXPECT_TRUE(cc_curves(std::vector<double>{}).mean.empty());
    EXPECT_TRUE(cc_curves(std::vector<double>(100, std::nan(""))).mean.empty());
    EXPECT_EQ(cc_choice({}).delay(), std::nullopt);
    EXPECT_EQ(cc_choice({}).window, std::nullopt);
}

}  // namespace
}  // namespace slideway::testing::cc_method_test
