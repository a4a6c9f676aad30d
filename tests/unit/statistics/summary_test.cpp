#include "host/statistics/summary.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::summary_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Quantile, InterpolatesAsType7) {
    std::vector<double> const four{1, 2, 4, 8};
    // h = 3p: 0.75 lies between the first two, 1.5 between the middle two, 2.7 between the last two.
    EXPECT_DOUBLE_EQ(quantile(four, 0.25), 1.75);
    EXPECT_DOUBLE_EQ(quantile(four, 0.5), 3);
    EXPECT_DOUBLE_EQ(quantile(four, 0.9), 6.8);
    EXPECT_EQ(quantile(four, 0), 1);
    EXPECT_EQ(quantile(four, 1), 8);
    EXPECT_EQ(quantile(std::vector<double>{7}, 0.3), 7);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Quantile, MeetsAnInfiniteNeighbourOnlyWhereItInterpolates) {
    std::vector<double> const values{1, 2, infinity};
    EXPECT_EQ(quantile(values, 0.5), 2);
    EXPECT_EQ(quantile(values, 0.75), infinity);
}

TEST(Summary, OfKnownNumbers) {
    Summary const s = summarise(std::vector<double>{8, 2, 4, 2});
    EXPECT_EQ(s.count, 4u);
    EXPECT_EQ(s.missing, 0u);
    EXPECT_DOUBLE_EQ(s.mean, 4);
    EXPECT_DOUBLE_EQ(s.sd, std::sqrt(24.0 / 3));  // 16 + 4 + 0 + 4
    EXPECT_EQ(s.min, 2);
    EXPECT_EQ(s.median, 3);
    EXPECT_EQ(s.max, 8);
}

TEST(Summary, LeavesNanOutAndCountsIt) {
    Summary const s = summarise(std::vector<double>{nan, 1, nan, 3, -nan});
    EXPECT_EQ(s.count, 2u);
    EXPECT_EQ(s.missing, 3u);
    EXPECT_EQ(s.mean, 2);
    EXPECT_EQ(s.median, 2);
    EXPECT_EQ(s.min, 1);
    EXPECT_EQ(s.max, 3);
}

TEST(Summary, OfNothingIsNan) {
    for (auto const& values : {std::vector<double>{}, std::vector<double>{nan, nan}}) {
        Summary const s = summarise(values);
        EXPECT_EQ(s.count, 0u);
        EXPECT_EQ(s.missing, values.size());
        for (double const x : {s.mean, s.sd, s.min, s.median, s.max}) EXPECT_TRUE(std::isnan(x));
    }
}

TEST(Summary, OfOneNumberHasNoSpread) {
    Summary const s = summarise(std::vector<double>{5});
    EXPECT_EQ(s.mean, 5);
    EXPECT_EQ(s.median, 5);
    EXPECT_TRUE(std::isnan(s.sd));
}

TEST(Summary, KeepsASmallSpreadOnALargeMean) {
    // Offsets of 2^-20 about 2^20 are exact; the sum of squares of the raw values would drown them.
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) values.push_back(0x1p20 + (i % 2 == 0 ? 0x1p-20 : -0x1p-20));
    Summary const s = summarise(values);
    EXPECT_DOUBLE_EQ(s.mean, 0x1p20);
    EXPECT_NEAR(s.sd, 0x1p-20 * std::sqrt(1000.0 / 999), 1e-12 * 0x1p-20);
}

TEST(Summary, OfAnInfiniteNumberHasNoSpread) {
    Summary const s = summarise(std::vector<double>{1, infinity});
    EXPECT_EQ(s.mean, infinity);
    EXPECT_TRUE(std::isnan(s.sd));
    EXPECT_EQ(s.max, infinity);
}

TEST(MeanInterval, IsThatOfStudent) {
    // Mean 3, sd √2.5, n = 5; t(4, 0.975) = 2.776445, t(4, 0.95) = 2.131847 of the printed tables.
    Summary const s = summarise(std::vector<double>{1, 2, 3, 4, 5});
    Interval const wide = mean_interval(s), narrow = mean_interval(s, 0.9);
    EXPECT_NEAR(wide.low, 3 - 2.776445 * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(wide.high, 3 + 2.776445 * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(narrow.high, 3 + 2.131847 * std::sqrt(0.5), 1e-6);
}

TEST(MeanInterval, NeedsASpread) {
    EXPECT_TRUE(std::isnan(mean_interval(summarise(std::vector<double>{5})).low));
    EXPECT_TRUE(std::isnan(mean_interval(summarise(std::vector<double>{1, infinity})).high));
    Interval const constant = mean_interval(summarise(std::vector<double>{2, 2, 2}));
    EXPECT_EQ(constant.low, 2);
    EXPECT_EQ(constant.high, 2);
}

}  // namespace
}  // namespace slideway::summary_test
