// Exponents from logs of growth, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "host/chaos/exponents.hpp"

namespace slideway::exponents_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Exponents, AreGrowthOverTime) {
    std::vector<double> const values = {1, -2, 3, -4, 5, -6};  // three intervals of two offsets
    auto const e = exponents_of({values, 2, 0.5});
    ASSERT_EQ(e.value.size(), 2u);
    EXPECT_DOUBLE_EQ(e.value[0], 9 / 1.5);
    EXPECT_DOUBLE_EQ(e.value[1], -12 / 1.5);
    EXPECT_TRUE(std::isnan(e.standard_error[0])) << "three intervals tell no spread";
}

TEST(Exponents, HaveTheErrorOfTheirBatches) {
    // 16 intervals, 4 batches of 4 with means 1, 2, 3, 6: mean 3, s² = (4 + 1 + 0 + 9)/3, error s/√4; per unit of time twice that.
    std::vector<double> values;
    for (double const mean : {1.0, 2.0, 3.0, 6.0}) {
        for (double const off : {-10.0, 10.0, 5.0, -5.0}) values.push_back(mean + off);
    }
    auto const e = exponents_of({values, 1, 0.5});
    EXPECT_DOUBLE_EQ(e.value[0], 6);
    EXPECT_NEAR(e.standard_error[0], 2 * std::sqrt(14.0 / 3 / 4), 1e-14);
    // A remainder at the start counts in the value alone: 17 intervals, still batches of 4.
    values.insert(values.begin(), 3.0);
    EXPECT_NEAR(exponents_of({values, 1, 0.5}).standard_error[0], 2 * std::sqrt(14.0 / 3 / 4), 1e-14);
    values.front() = 20;
    EXPECT_DOUBLE_EQ(exponents_of({values, 1, 0.5}).value[0], 2 * (48.0 + 20) / 17);
}

TEST(Exponents, AreSortedByTheWholeRecord) {
    // Three offsets that grow by 2, 4 and 2 in two intervals; then the member failed.
    std::vector<double> const values = {1, 3, -3, 1, 1, 5, nan, nan, nan};
    auto const sorted = largest_first(values, 3);
    ASSERT_EQ(sorted.size(), values.size());
    EXPECT_EQ(std::vector<double>(sorted.begin(), sorted.begin() + 6), (std::vector<double>{3, 1, -3, 1, 1, 5})) << "equal ones as they come";
    EXPECT_EQ((GrowthLog{sorted, 3, 1}.intervals()), 2u);
}

TEST(Exponents, EndWhereAMemberFailed) {
    std::vector<double> const values = {1, 2, 3, 4, nan, nan, nan, nan};
    GrowthLog const log{values, 2, 1};
    EXPECT_EQ(log.intervals(), 2u);
    EXPECT_DOUBLE_EQ(exponents_of(log).value[1], 3);
    std::vector<double> const none = {nan, nan};
    EXPECT_EQ((GrowthLog{none, 2, 1}.intervals()), 0u);
    EXPECT_TRUE(std::isnan(exponents_of({none, 2, 1}).value[0]));
    EXPECT_TRUE(std::isnan(exponents_of({{}, 1, 1}).value[0]));
}

TEST(RunningExponents, EndWithTheValue) {
    // Growth 1, 3, 5 … has mean n over its first n intervals.
    std::vector<double> values;
    for (int i = 0; i < 10; ++i) values.push_back(2 * i + 1), values.push_back(-1);
    GrowthLog const log{values, 2, 0.25};
    std::size_t const after[] = {2, 5, 7, 10};
    auto const running = running_exponents(log, 0, after);
    ASSERT_EQ(running.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(running[i], static_cast<double>(after[i]) / 0.25);
    EXPECT_DOUBLE_EQ(running.back(), exponents_of(log).value[0]);
    EXPECT_EQ(running_exponents(log, 1, after), std::vector<double>(4, -4.0));
    EXPECT_TRUE(running_exponents(log, 0, {}).empty());
}

TEST(RunningExponents, OfAMemberThatFailedEndWithIt) {
    std::vector<double> const values = {1, 2, 3, nan, nan, nan};
    std::size_t const after[] = {0, 2, 3, 4, 6};
    auto const running = running_exponents({values, 1, 1}, 0, after);
    EXPECT_TRUE(std::isnan(running[0]));
    EXPECT_DOUBLE_EQ(running[1], 1.5);
    EXPECT_DOUBLE_EQ(running[2], 2);
    EXPECT_TRUE(std::isnan(running[3]) && std::isnan(running[4]));
}

TEST(Exponents, HaveBatchesOfWholePeriodsAndNoIntervalFromFew) {
    // A growth that alternates with the forcing, three up and three down: batches of ⌊√48⌋ = 6 are a period, and all alike.
    std::vector<double> values;
    for (int i = 0; i < 48; ++i) values.push_back(i % 6 < 3 ? 5 : -3);
    auto const e = exponents_of({values, 1, 1, 6});
    EXPECT_DOUBLE_EQ(e.value[0], 1);
    EXPECT_NEAR(e.standard_error[0], 0, 1e-14);
    EXPECT_NEAR(e.half_width[0], 0, 1e-14);
    EXPECT_DOUBLE_EQ(e.late[0], 1);
    // 60 intervals, batches of 7 without the period: they differ.
    for (int i = 0; i < 12; ++i) values.push_back(i % 6 < 3 ? 5 : -3);
    EXPECT_GT(exponents_of({values, 1, 1}).standard_error[0], 0.1);
    EXPECT_NEAR(exponents_of({values, 1, 1, 6}).standard_error[0], 0, 1e-14);
    // 16 intervals make 4 batches: an error, but no interval.
    values.resize(16);
    EXPECT_FALSE(std::isnan(exponents_of({values, 1, 1}).standard_error[0]));
    EXPECT_TRUE(std::isnan(exponents_of({values, 1, 1}).half_width[0]));
}

TEST(Exponents, OfTheSecondHalfForgetEarlyGrowth) {
    std::vector<double> const values = {10, 10, 0, 0, -1, -1, -1, -1};
    auto const e = exponents_of({values, 1, 1});
    EXPECT_GT(e.value[0], 1);
    EXPECT_DOUBLE_EQ(e.late[0], -1);
}

TEST(KaplanYorke, InterpolatesWhereTheSumChangesItsSign) {
    EXPECT_NEAR(kaplan_yorke_dimension(std::array{0.9056, 0.0, -14.5723}), 2 + 0.9056 / 14.5723, 1e-14);
    EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(std::array{0.5, -1.0}), 1.5);
    EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(std::array{1.0, -0.5, -1.0, -9.0}), 2.5);
}

TEST(KaplanYorke, OfAFixedPointIsZeroOfACycleOne) {
    EXPECT_EQ(kaplan_yorke_dimension(std::array{-0.1, -2.0}), 0);
    EXPECT_EQ(kaplan_yorke_dimension(std::array{0.0, -2.0}), 1);
    EXPECT_EQ(kaplan_yorke_dimension(std::array{0.0, 0.0, -2.0}), 2) << "a torus";
}

TEST(KaplanYorke, OfWhatDoesNotContractIsTheNumberOfExponents) {
    EXPECT_EQ(kaplan_yorke_dimension(std::array{1.0, 0.0, -1.0}), 3) << "areas are kept";
    EXPECT_EQ(kaplan_yorke_dimension(std::array{2.0, -1.0}), 2) << "a part of a spectrum";
    EXPECT_TRUE(std::isnan(kaplan_yorke_dimension({})));
    EXPECT_TRUE(std::isnan(kaplan_yorke_dimension(std::array{1.0, nan})));
}

TEST(MeanOfMembers, HasStudentsInterval) {
    // t(0.975) with 4 degrees of freedom is 2.776445105 (Abramowitz & Stegun, table 26.10: 2.776); of 1..5 s² = 2.5.
    std::array const values = {4.0, 2.0, nan, 5.0, 1.0, 3.0};
    auto const m = mean_of_members(values);
    EXPECT_EQ(m.count, 5u);
    EXPECT_DOUBLE_EQ(m.mean, 3);
    EXPECT_NEAR(m.half_width, 2.7764451051977987 * std::sqrt(2.5 / 5), 1e-12);
    // With 1 degree of freedom Student's is Cauchy's: tan(0.475 π) and tan(π/4).
    std::array const two = {0.0, 2.0};
    EXPECT_NEAR(mean_of_members(two).half_width, std::tan(0.475 * 3.141592653589793), 1e-10);
    EXPECT_NEAR(mean_of_members(two, 0.5).half_width, 1, 1e-12);
}

TEST(MeanOfMembers, OfFewSaysSo) {
    EXPECT_TRUE(std::isnan(mean_of_members({}).mean));
    std::array const one = {7.0};
    EXPECT_EQ(mean_of_members(one).mean, 7);
    EXPECT_TRUE(std::isnan(mean_of_members(one).half_width));
    std::array const missing = {nan, nan};
    EXPECT_EQ(mean_of_members(missing).count, 0u);
}

}  // namespace
}  // namespace slideway::exponents_test
