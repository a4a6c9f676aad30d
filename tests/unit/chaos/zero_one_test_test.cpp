#include "host/chaos/zero_one_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::zero_one_test_test {
namespace {

TEST(ZeroOneTest, ChaosIsOne) {
    EXPECT_GT(zero_one_test(logistic_series(2000, 4)).k, 0.95);
    EXPECT_GT(zero_one_test(henon_series(2000)).k, 0.95);
    EXPECT_GT(zero_one_test(lorenz_series(2000, 0.4)).k, 0.95);
}

TEST(ZeroOneTest, RegularMotionIsZero) {
    EXPECT_LT(std::abs(zero_one_test(logistic_series(2000, 3.55)).k), 0.1);
    EXPECT_LT(std::abs(zero_one_test(sine_series(2000, 7.3)).k), 0.1);
    auto const quasi_periodic =
        sum(sine_series(2000, 2 * std::numbers::pi), sine_series(2000, 2 * std::numbers::pi / std::sqrt(3), 0.5));
    EXPECT_LT(std::abs(zero_one_test(quasi_periodic).k), 0.1);
}

TEST(ZeroOneTest, NeedsThinningOfDenseSamples) {
    // 150 samples per average period: over a tenth of them the series is smooth.
    auto const dense = lorenz_series(20000, 0.01);
    EXPECT_LT(zero_one_test(dense).k, 0.6);
    ZeroOneTest const thinned = zero_one_test(dense, {.stride = zero_one_stride(150)});
    EXPECT_EQ(thinned.points, 541u);
    EXPECT_GT(thinned.k, 0.95);
}

TEST(ZeroOneTest, StrideLeavesFourSamplesPerPeriod) {
    EXPECT_EQ(zero_one_stride(150), 37u);
    EXPECT_EQ(zero_one_stride(8), 2u);
    EXPECT_EQ(zero_one_stride(7.9), 1u);
    EXPECT_EQ(zero_one_stride(std::numeric_limits<double>::quiet_NaN()), 1u);
}

TEST(ZeroOneTest, DoesNotSeeUnitAndOrigin) {
    auto series = logistic_series(1000, 3.9);
    double const k = zero_one_test(series).k;
    for (double& x : series) x = 1024 * x + 4096;
    EXPECT_NEAR(zero_one_test(series).k, k, 1e-6);
}

TEST(ZeroOneTest, MedianIsOverAllFrequencies) {
    ZeroOneTest const test = zero_one_test(logistic_series(500, 4), {.frequencies = 7});
    ASSERT_EQ(test.k_c.size(), 7u);
    auto sorted = test.k_c;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(test.k, sorted[3]);
    EXPECT_EQ(zero_one_test(logistic_series(500, 4), {.max_points = 300}).points, 300u);
}

TEST(ZeroOneTest, OfTwoTonesIsRegularWhereverItAnswers) {
    for (int i = 0; i < 60; ++i) {
        double const period = 4.8 + 0.48 * (i % 10), ratio = 1.1 + 0.3236 * (i / 10), share = 0.3 + 0.1 * (i % 7);
        for (std::size_t const n : {139u, 200u, 299u, 300u, 400u, 1000u}) {
            ZeroOneTest const test = zero_one_test(sum(sine_series(n, period), sine_series(n, period / ratio, share)));
            EXPECT_EQ(test.points, n);
            EXPECT_EQ(std::isnan(test.k), n < 300) << n;
            EXPECT_FALSE(test.k > 0.2) << n << ' ' << i;
        }
    }
    for (std::size_t const n : {300u, 500u}) {
        for (double const period : {4.1, 5.3, 7.9}) EXPECT_LT(zero_one_test(sine_series(n, period)).k, 0.1) << n;
        EXPECT_LT(zero_one_test(logistic_series(n, 3.55)).k, 0.1) << n;
        EXPECT_GT(zero_one_test(logistic_series(n, 4)).k, 0.95) << n;
        EXPECT_GT(zero_one_test(lorenz_series(n, 0.37)).k, 0.95) << n;
    }
}

TEST(ZeroOneTest, HasNoAnswerOutsideItsDomain) {
    EXPECT_TRUE(std::isnan(zero_one_test(std::vector<double>(500, 1.0)).k));
    EXPECT_TRUE(std::isnan(zero_one_test(white_series(299)).k));
    auto series = white_series(500);
    series[7] = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(zero_one_test(series).k));
    EXPECT_TRUE(std::isnan(zero_one_test({}).k));
}

}  // namespace
}  // namespace slideway::testing::zero_one_test_test
