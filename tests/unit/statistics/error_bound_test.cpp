#include "host/statistics/error_bound.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::error_bound_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ErrorBound, IsOfStudentsPairedInterval) {
    // Student (1908), the sleep data: hours gained by ten patients under two drugs; mean difference 1.58, interval 0.7001142 … 2.4598858,
    // t = 4.0621 with 9 degrees of freedom, p = 0.002833.
    std::vector<double> const differences{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
    ErrorBound const bound = error_bound(differences, 1'000'000, 1);
    EXPECT_EQ(bound.pairs, 10u);
    EXPECT_NEAR(bound.difference, 1.58, 1e-12);
    EXPECT_NEAR(bound.half_width, 0.8798858, 1e-6);
    // Its 99 % interval: t = 3.2498355 in place of 2.2621572.
    EXPECT_NEAR(bound.bound, 1.58 + 0.8798858 * 3.2498355 / 2.2621572, 1e-5);
    EXPECT_NEAR(bound.p, 0.002833, 1e-6);
}

TEST(ErrorBound, LeavesOutWhatHasNoNumber) {
    EXPECT_EQ(error_bound(std::vector<double>{1, nan, 3}, 9, 1).pairs, 2u);
    EXPECT_EQ(error_bound(std::vector<double>{1, nan, 3}, 9, 1).difference, 2);
    EXPECT_TRUE(std::isnan(error_bound(std::vector<double>{1}, 9, 1).bound)) << "one of nine tells no interval";
    EXPECT_TRUE(std::isnan(error_bound(std::vector<double>{}, 9, 1).bound));
}

TEST(ErrorBound, OfAnOnlyMemberIsItsDifference) {
    ErrorBound const bound = error_bound(std::vector<double>{-3}, 1, 7);
    EXPECT_EQ(bound.bound, 3);
    EXPECT_EQ(bound.unseen, 0);
}

TEST(ErrorBound, OfPairsThatAllAgreeIsWhatMayBeUnseen) {
    // The rule of three: none of 30 pairs differs, so up to 3/30 of very many members may, here by 2 each.
    ErrorBound const bound = error_bound(std::vector<double>(30, 0.0), 1'000'000, 2);
    EXPECT_NEAR(bound.bound, 2 * (1 - std::pow(0.05, 1.0 / 30)), 1e-4);
    EXPECT_EQ(bound.p, 1);
}

TEST(ErrorBound, TakesCountsThatAreAlikeByChanceForNoProof) {
    std::vector<double> const alike{1, 1};
    EXPECT_EQ(error_bound(alike, 9, 1).p, 0) << "numbers of any size";
    // t = 1/((1/√12)/√2) = √24 with one degree of freedom: p = 1 − (2/π) atan t.
    EXPECT_NEAR(error_bound(alike, 9, 1, 1).p, 1 - std::atan(std::sqrt(24.0)) / std::atan(1.0) / 2, 1e-9);
}

/// P(none of n drawn is among D of N) = C(N − D, n)/C(N, n).
double missed(std::uint64_t members, std::uint64_t differing, std::size_t drawn) {
    double p = 1;
    for (std::size_t i = 0; i < drawn; ++i)
        p *= static_cast<double>(members - differing - i) / static_cast<double>(members - i);
    return p;
}

TEST(UnseenShare, IsMissedWithFivePerCent) {
    for (std::uint64_t const members : {20u, 100u, 5000u}) {
        for (std::size_t const drawn : {3u, 10u, 18u}) {
            double const differing = unseen_share(drawn, members) * static_cast<double>(members);
            auto const whole = static_cast<std::uint64_t>(differing);
            // The bound is the largest number that is still missed so often, within one member.
            if (whole > 0) {
                EXPECT_GT(missed(members, whole - 1, drawn), 0.05) << members << ' ' << drawn;
            }
            if (whole + 2 + drawn <= members) {
                EXPECT_LT(missed(members, whole + 2, drawn), 0.05) << members << ' ' << drawn;
            }
        }
    }
    EXPECT_EQ(unseen_share(7, 7), 0) << "all were looked at";
    EXPECT_EQ(unseen_share(0, 7), 1);
}

TEST(ErrorBound, HoldsTheErrorOfAMeanOfWhichFewMembersAreOff) {
    // A share of the members is off by one standard deviation, the others by nothing.
    std::mt19937_64 engine(5);
    constexpr std::size_t members = 2000, drawn = 20;
    for (double const share : {0.01, 0.05, 0.1, 0.14, 0.3}) {
        int held = 0;
        for (int study = 0; study < 1000; ++study) {
            std::vector<double> differences;
            for (std::size_t i = 0; i < drawn; ++i)
                differences.push_back(std::uniform_real_distribution<double>()(engine) < share ? 1 : 0);
            held += error_bound(differences, members, 1).bound >= share;
        }
        EXPECT_GE(held, 900) << share;
    }
}

TEST(Holm, AdjustsEachByThoseThatAreLeft) {
    std::vector<double> const adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, nan, 0.03});
    EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
    EXPECT_DOUBLE_EQ(adjusted[3], 0.06);
    EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
    EXPECT_TRUE(std::isnan(adjusted[2]));
}

}  // namespace
}  // namespace slideway::error_bound_test
