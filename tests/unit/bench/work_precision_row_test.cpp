// How the work-precision benchmark reads its rows: percentiles, and the time that a method needs for an error.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/work_precision/row.hpp"

namespace slideway::bench::work_precision_row_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Row row(double error, double seconds, std::string method = "a") {
    return {.method = std::move(method), .code = "scalar", .p95_error = error, .seconds = seconds};
}

TEST(Percentile, IsTheNearestRank) {
    // ranks ceil(0.5 · 5) = 3 and ceil(0.95 · 20) = 19
    EXPECT_EQ(percentile({5, 1, 4, 2, 3}, 0.5), 3);
    std::vector<double> twenty;
    for (int i = 20; i >= 1; --i) twenty.push_back(i);
    EXPECT_EQ(percentile(twenty, 0.95), 19);
    EXPECT_EQ(percentile({7}, 0.95), 7);
}

TEST(Percentile, CountsAFailedMemberAsTheWorst) {
    EXPECT_EQ(percentile({infinity, 1, 2, 3}, 0.95), infinity);
    EXPECT_EQ(percentile({infinity, 1, 2, 3}, 0.5), 2);
}

TEST(TimeToReach, FollowsAPowerLawBetweenTolerances) {
    // error e costs e^(-1/2) seconds
    std::vector<Row> const rows = {row(1e-2, 10), row(1e-6, 1000)};
    EXPECT_NEAR(time_to_reach(1e-4, rows, "a", "scalar"), 100, 1e-9);
    EXPECT_NEAR(time_to_reach(1e-2, rows, "a", "scalar"), 10, 1e-12);
    EXPECT_NEAR(time_to_reach(1e-1, rows, "a", "scalar"), 10, 1e-12) << "no faster than the coarsest tolerance";
    EXPECT_TRUE(std::isnan(time_to_reach(1e-7, rows, "a", "scalar")));
}

TEST(TimeToReach, TakesTheFastestRowThatMeetsTheTarget) {
    // A finer tolerance can be faster: fewer steps are rejected.
    std::vector<Row> const rows = {row(1e-3, 5), row(1e-4, 2), row(1e-5, 9)};
    EXPECT_EQ(time_to_reach(1e-3, rows, "a", "scalar"), 2);
}

TEST(TimeToReach, DoesNotInterpolateFromAFailure) {
    std::vector<Row> const rows = {row(infinity, 1), row(1e-4, 100)};
    EXPECT_EQ(time_to_reach(1e-3, rows, "a", "scalar"), 100);
}

TEST(TimeToReach, KeepsMethodsApart) {
    std::vector<Row> const rows = {row(1e-4, 1, "b"), row(1e-4, 3)};
    EXPECT_EQ(time_to_reach(1e-3, rows, "a", "scalar"), 3);
    EXPECT_TRUE(std::isnan(time_to_reach(1e-3, rows, "a", "avx512")));
}

}  // namespace
}  // namespace slideway::bench::work_precision_row_test
