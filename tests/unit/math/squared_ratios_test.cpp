#include "kernels/math/squared_ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slideway::squared_ratios_test {
namespace {

TEST(SquaredRatios, SumForAnyNumberOfPairs) {
    // Powers of two are exact: (2^k / 2)² = 4^(k−1).
    double want = 0;
    for (int count = 0; count <= 9; ++count) {
        SquaredRatios<double> sum;
        for (int k = 0; k < count; ++k) sum.add(std::ldexp(1.0, k), 2.0);
        EXPECT_EQ(sum.total(), want) << count;
        want += std::pow(4.0, count - 1);
    }
}

TEST(SquaredRatios, AgreeWithOneDivisionEach) {
    double const a[] = {3e-9, -2e-12, 0.0, 5e-4, 1e-7}, b[] = {2e-10, 1e-11, 1e-6, 3e-3, 4e-12};
    SquaredRatios<double> sum;
    double want = 0;
    for (int i = 0; i < 5; ++i) sum.add(a[i], b[i]), want += (a[i] / b[i]) * (a[i] / b[i]);
    EXPECT_NEAR(sum.total(), want, 4e-16 * want);
}

TEST(SquaredRatios, OfTinyTolerancesKeepTheirDigits) {
    // The smallest tolerances that a scene can ask for, atol = 1e-14 times a clearance of a nanometre, are far from underflow.
    SquaredRatios<double> sum;
    for (int i = 0; i < 4; ++i) sum.add(0.5e-23, 1e-23);
    EXPECT_NEAR(sum.total(), 1.0, 1e-15);
}

TEST(SquaredRatios, NanOrInfinityShows) {
    double const infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (double const bad : {nan, infinity, -infinity}) {
        for (int place = 0; place < 5; ++place) {
            SquaredRatios<double> sum;
            for (int i = 0; i < 5; ++i) sum.add(i == place ? bad : 1e-9, 1e-6);
            EXPECT_FALSE(sum.total() < 1e300) << bad << " at " << place;
        }
    }
}

}  // namespace
}  // namespace slideway::squared_ratios_test
