// The rough logarithm and exponential keep the digits they promise.
#include "kernels/math/rough_powers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slideway::rough_powers_test {
namespace {

TEST(RoughPowers, LogarithmHasFourDigits) {
    for (int i = 0; i <= 40'000; ++i) {
        double const x = std::exp(-700 + 0.035 * i);
        ASSERT_NEAR(rough_log2(x), std::log2(x), 1.2e-4) << x;
    }
}

TEST(RoughPowers, LogarithmOfAPowerOfTwoIsExactAndContinuous) {
    for (double const exponent : {-300.0, -1.0, 0.0, 1.0, 300.0}) {
        double const x = std::exp2(exponent);
        EXPECT_EQ(rough_log2(x), exponent);
        EXPECT_NEAR(rough_log2(std::nextafter(x, 0.0)), exponent, 1e-12);
    }
}

TEST(RoughPowers, LogarithmOfAnythingIsFinite) {
    double const infinity = std::numeric_limits<double>::infinity();
    for (double const x : {0.0, -1.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_TRUE(std::isfinite(rough_log2(x))) << x;
    }
}

TEST(RoughPowers, ExponentialHasFourDigits) {
    for (int i = 0; i <= 40'000; ++i) {
        double const x = -1000 + 0.05 * i;
        ASSERT_NEAR(rough_exp2(x) / std::exp2(x), 1, 7.6e-5) << x;
    }
}

}  // namespace
}  // namespace slideway::rough_powers_test
