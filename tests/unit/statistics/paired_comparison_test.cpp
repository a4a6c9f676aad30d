#include "host/statistics/paired_comparison.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::paired_comparison_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(PairedComparison, IsStudentsPairedTest) {
    // Student (1908), the sleep data: hours gained by ten patients under two drugs; t = 4.0621 with 9 degrees of freedom, p = 0.002833.
    std::vector<double> const first{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0},
        second{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
    PairedComparison const pairs = compare_pairs(first, second);
    EXPECT_EQ(pairs.pairs, 10u);
    EXPECT_NEAR(pairs.difference, 1.58, 1e-12);
    EXPECT_NEAR(pairs.p_mean, 0.002833, 1e-6);
    EXPECT_NEAR(pairs.interval.low, 0.7001142, 1e-6);
    EXPECT_NEAR(pairs.interval.high, 2.4598858, 1e-6);
}

TEST(PairedComparison, LeavesOutPairsWithoutANumber) {
    std::vector<double> const first{1, nan, 3, 4}, second{2, 5, nan, 6};
    PairedComparison const pairs = compare_pairs(first, second);
    EXPECT_EQ(pairs.pairs, 2u);
    EXPECT_EQ(pairs.first, 2.5);
    EXPECT_EQ(pairs.difference, 1.5);
    EXPECT_TRUE(std::isnan(compare_pairs(std::vector<double>{nan}, std::vector<double>{1}).p_mean));
}

TEST(PairedComparison, OfEqualAndOfShiftedPairsIsCertain) {
    std::vector<double> const numbers{1, 2, 3}, shifted{2, 3, 4};
    EXPECT_EQ(compare_pairs(numbers, numbers).p_mean, 1);
    EXPECT_EQ(compare_pairs(numbers, numbers).p_distribution, 1);
    EXPECT_EQ(compare_pairs(numbers, shifted).p_mean, 0);
}

TEST(Welch, IsStudentsWithTheFreedomOfBothSpreads) {
    // Means 3 and 6, variances 2.5 and 10 of five each: t = 3/√2.5 with 2.5²/(0.25/4 + 4/4) = 100/17 degrees of freedom.
    std::vector<double> const a{1, 2, 3, 4, 5}, b{2, 4, 6, 8, 10};
    EXPECT_NEAR(welch_p(summarise(a), summarise(b)), 0.1075312, 1e-6);
    Summary const one = summarise(std::vector<double>{2, 2, 2}), other = summarise(std::vector<double>{3, 3});
    EXPECT_EQ(welch_p(one, one), 1);
    EXPECT_EQ(welch_p(one, other), 0);
    EXPECT_TRUE(std::isnan(welch_p(one, summarise(std::vector<double>{1}))));
}

/// C(n, k).
double choose(int n, int k) {
    double product = 1;
    for (int i = 1; i <= k; ++i) product = product * (n - k + i) / i;
    return product;
}

TEST(KolmogorovSmirnov, OfSeparatedSamplesIsTwoOfAllOrders) {
    for (int const n : {2, 5, 8, 16}) {
        auto const size = static_cast<std::size_t>(n);
        EXPECT_NEAR(kolmogorov_smirnov_p(size, size), 2 / choose(2 * n, n), 1e-15) << n;
    }
}

/// Counts orders of n and n values whose empirical distributions are at least `steps` apart.
double counted_p(int n, int steps) {
    int apart = 0, all = 0;
    for (int order = 0; order < 1 << (2 * n); ++order) {
        if (__builtin_popcount(static_cast<unsigned>(order)) != n) continue;
        int gap = 0, largest = 0;
        for (int i = 0; i < 2 * n; ++i) {
            gap += (order >> i & 1) != 0 ? 1 : -1;
            largest = std::max(largest, std::abs(gap));
        }
        ++all;
        apart += largest >= steps;
    }
    return static_cast<double>(apart) / all;
}

TEST(KolmogorovSmirnov, CountsTheOrdersOfTwoSamples) {
    for (int steps = 0; steps <= 6; ++steps) {
        EXPECT_NEAR(kolmogorov_smirnov_p(6, static_cast<std::size_t>(steps)), counted_p(6, steps), 1e-12) << steps;
    }
}

TEST(PairedComparison, SeesSpreadThatMeansDoNot) {
    std::vector<double> narrow, wide;
    for (int i = 0; i < 16; ++i) {
        double const x = i - 7.5;
        narrow.push_back(0.05 * x);
        wide.push_back((i % 2 == 0 ? 1 : -1) * (10 + std::abs(x)));
    }
    PairedComparison const pairs = compare_pairs(narrow, wide);
    EXPECT_GT(pairs.p_mean, 0.5);
    EXPECT_LT(pairs.p_distribution, 0.05);
}

TEST(PairedComparison, OfValuesThatDifferByLessThanTheSlackIsOne) {
    std::vector<double> numbers, rounded, far;
    for (int i = 0; i < 16; ++i) {
        numbers.push_back(1 + 1e-3 * i);
        rounded.push_back(numbers.back() - 1e-12);
        far.push_back(numbers.back() + 0.02);
    }
    std::vector<double> const same(16, 1.0), nearly(16, 1.0 - 1e-16);
    EXPECT_LT(compare_pairs(same, nearly).p_distribution, 1e-8);
    EXPECT_EQ(compare_pairs(same, nearly, 1e-9).p_distribution, 1);
    EXPECT_EQ(compare_pairs(numbers, rounded, 1e-9).p_distribution, 1);
    EXPECT_LT(compare_pairs(numbers, far, 1e-3).p_distribution, 1e-7);
    EXPECT_LT(compare_pairs(far, numbers, 1e-3).p_distribution, 1e-7);
}

TEST(HolmAdjusted, MultipliesByTheTestsThatAreLeft) {
    std::vector<double> const p{0.01, 0.04, nan, 0.03};
    auto const adjusted = holm_adjusted(p);
    EXPECT_NEAR(adjusted[0], 0.03, 1e-15);
    EXPECT_NEAR(adjusted[3], 0.06, 1e-15);
    EXPECT_NEAR(adjusted[1], 0.06, 1e-15);  // not below one that is more certain
    EXPECT_TRUE(std::isnan(adjusted[2]));
}

TEST(HolmAdjusted, RaisesAFalseAlarmAsOftenAsItSays) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    int alarms = 0;
    constexpr int studies = 2000;
    for (int study = 0; study < studies; ++study) {
        std::vector<double> p;
        for (int column = 0; column < 6; ++column) {
            std::vector<double> first, second;
            for (int i = 0; i < 12; ++i) {
                double const member = normal(random);
                first.push_back(member + normal(random));
                second.push_back(member + normal(random));
            }
            PairedComparison const pairs = compare_pairs(first, second);
            p.push_back(pairs.p_mean);
            p.push_back(pairs.p_distribution);
        }
        for (double const adjusted : holm_adjusted(p)) {
            if (adjusted < 0.05) {
                ++alarms;
                break;
            }
        }
    }
    EXPECT_LT(alarms, 0.06 * studies);
    EXPECT_GT(alarms, 0.01 * studies);
}

}  // namespace
}  // namespace slideway::paired_comparison_test
