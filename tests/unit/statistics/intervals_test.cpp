#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "host/statistics/summary.hpp"

namespace slideway::intervals_test {
namespace {

double uniform(std::mt19937_64& engine) { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; }

std::vector<double> first_numbers(int n) {
    std::vector<double> numbers(static_cast<std::size_t>(n));
    std::iota(numbers.begin(), numbers.end(), 1.0);
    return numbers;
}

TEST(QuantileInterval, OfTheMedianHasTheRanksOfTheTables) {
    // Two-sided 95 % ranks of the sign test's interval (Conover 1999, table A3): n = 10: 2 and 9; n = 20: 6 and 15;
    // n = 50: 18 and 33.
    struct Case {
        int n;
        double low, high;
    };
    for (Case const& c : {Case{6, 1, 6}, Case{10, 2, 9}, Case{20, 6, 15}, Case{50, 18, 33}}) {
        Interval const interval = quantile_interval(first_numbers(c.n), 0.5);
        EXPECT_EQ(interval.low, c.low) << c.n;
        EXPECT_EQ(interval.high, c.high) << c.n;
    }
}

TEST(QuantileInterval, HasNoBoundThatTooFewDrawsCannotGive) {
    // Of five, P(all above the median) = 1/32 > 0.025.
    EXPECT_TRUE(std::isnan(quantile_interval(first_numbers(5), 0.5).low));
    EXPECT_TRUE(std::isnan(quantile_interval(first_numbers(5), 0.5).high));
    EXPECT_TRUE(std::isnan(quantile_interval({}, 0.5).low));
    // 0.99^n <= 0.025 from n = 368 on: the first number of draws whose largest bounds the 99 % quantile.
    EXPECT_TRUE(std::isnan(quantile_interval(first_numbers(367), 0.99).high));
    EXPECT_EQ(quantile_interval(first_numbers(368), 0.99).high, 368);
    EXPECT_FALSE(std::isnan(quantile_interval(first_numbers(367), 0.99).low));
    EXPECT_EQ(quantile_interval(first_numbers(368), 0.01).low, 1);
}

TEST(QuantileInterval, CoversTheQuantileOfAnyDistribution) {
    // Exponential and Bernoulli-like draws: at least 95 % of the intervals cover; 4000 trials, so 94 % is 3 sd below.
    std::mt19937_64 engine(20240607);
    constexpr int trials = 4000, n = 200;
    for (double const p : {0.1, 0.5, 0.95}) {
        double const truth = -std::log1p(-p);
        int covered = 0;
        for (int t = 0; t < trials; ++t) {
            std::vector<double> draws(n);
            for (double& x : draws) x = -std::log(uniform(engine));
            std::sort(draws.begin(), draws.end());
            Interval const interval = quantile_interval(draws, p);
            covered += interval.low <= truth && truth <= interval.high;
        }
        EXPECT_GT(covered, 0.94 * trials) << p;
        EXPECT_LT(covered, 0.99 * trials) << p;  // ranks are whole, but not that coarse
    }
}

TEST(QuantileInterval, StandsByTheSampleQuantile) {
    std::vector<double> const probabilities{0.25, 0.5};
    auto const estimates = estimate_quantiles(first_numbers(21), probabilities);
    ASSERT_EQ(estimates.size(), 2u);
    EXPECT_EQ(estimates[0].p, 0.25);
    EXPECT_EQ(estimates[0].value, 6);
    EXPECT_EQ(estimates[1].value, 11);
    EXPECT_EQ(estimates[1].interval.low, 6);
    EXPECT_EQ(estimates[1].interval.high, 16);
}

TEST(Proportion, HasThePublishedIntervalOfWilson) {
    struct Case {
        std::uint64_t successes, trials;
        double low, high;
    };
    // 81/263, 15/148, 0/20 and 1/29: Newcombe (1998), Statistics in Medicine 17, table I, method 3.
    for (Case const& c : {Case{0, 10, 0, 0.2775}, Case{8, 10, 0.4902, 0.9433}, Case{81, 263, 0.2553, 0.3662},
                          Case{15, 148, 0.0624, 0.1605}, Case{0, 20, 0, 0.1611}, Case{1, 29, 0.0061, 0.1718}}) {
        Proportion const p = proportion(c.successes, c.trials);
        EXPECT_NEAR(p.interval.low, c.low, 5e-5) << c.successes << " of " << c.trials;
        EXPECT_NEAR(p.interval.high, c.high, 5e-5) << c.successes << " of " << c.trials;
        EXPECT_DOUBLE_EQ(p.value, static_cast<double>(c.successes) / static_cast<double>(c.trials));
    }
}

TEST(Proportion, IsExactAtItsEnds) {
    for (std::uint64_t const n : {1u, 3u, 7u, 10u, 1000u, 999983u}) {
        EXPECT_EQ(proportion(0, n).interval.low, 0) << n;
        EXPECT_EQ(proportion(n, n).interval.high, 1) << n;
        EXPECT_GT(proportion(0, n).interval.high, 0) << n;
        EXPECT_LT(proportion(n, n).interval.low, 1) << n;
    }
}

TEST(Proportion, OfNothingIsUnknown) {
    Proportion const p = proportion(0, 0);
    EXPECT_TRUE(std::isnan(p.value));
    EXPECT_EQ(p.interval.low, 0);
    EXPECT_EQ(p.interval.high, 1);
}

}  // namespace
}  // namespace slideway::intervals_test
