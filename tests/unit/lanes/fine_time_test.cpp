#include "kernels/lanes/fine_time.hpp"

#include <gtest/gtest.h>

namespace slideway::testing::fine_time_test {
namespace {

/// Ten thousand steps of a thousandth of a last bit each, as a sum of them says: 2e5 s has a last bit of 2.9e-11 s.
TEST(FineTime, AddsStepsBelowTheLastBit) {
    double const start = 2e5, step = 2.9e-14;
    FineTime<double> const time(2.5e5, false);
    double t = start, rest = 0;
    for (int i = 0; i < 10'000; ++i) t = time.after(t, step, rest, true, false);
    EXPECT_NEAR((t - start) + rest, 1e4 * step, 1e-6 * step);
    EXPECT_LT(time.resolution(), step);
}

TEST(FineTime, OfShortRunsIsThePlainSum) {
    FineTime<double> const time(99, false);
    double rest = 0;
    EXPECT_EQ(time.after(0.1, 0.2, rest, true, false), 0.1 + 0.2);
    EXPECT_EQ(rest, 0);
}

TEST(FineTime, CountsAnewFromALandingAndNotForAttemptsThatFail) {
    FineTime<double> const time(1e3, false);
    double rest = 1e-17;
    time.after(500.0, 1e-3, rest, false, false);
    EXPECT_EQ(rest, 1e-17);
    time.after(500.0, 1e-3, rest, true, true);
    EXPECT_EQ(rest, 0);
}

}  // namespace
}  // namespace slideway::testing::fine_time_test
