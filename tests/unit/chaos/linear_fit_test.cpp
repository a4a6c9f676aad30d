#include "host/chaos/divergence.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::testing::linear_fit_test {
namespace {

TEST(LinearFit, IsThatOfTheTextbook) {
    // By hand: Sxx = 5, Sxy = 4.5, Syy = 4.75, residuals 0.1, 0.2, -0.7, 0.4.
    std::vector<double> const x{0, 1, 2, 3}, y{0, 1, 1, 3};
    LinearFit const fit = fit_line(x, y);
    EXPECT_NEAR(fit.slope, 0.9, 1e-14);
    EXPECT_NEAR(fit.intercept, -0.1, 1e-14);
    EXPECT_NEAR(fit.slope_error, std::sqrt(0.7 / (2 * 5)), 1e-14);
    EXPECT_NEAR(fit.r_squared, 1 - 0.7 / 4.75, 1e-14);
    EXPECT_EQ(fit.points, 4u);
}

TEST(LinearFit, FindsALineFarFromTheOrigin) {
    std::vector<double> x, y;
    for (int i = 0; i < 50; ++i) {
        x.push_back(1e6 + i);
        y.push_back(-3.0 * i + 7e5);
    }
    LinearFit const fit = fit_line(x, y);
    EXPECT_NEAR(fit.slope, -3, 1e-9);
    EXPECT_NEAR(fit.intercept, 3e6 + 7e5, 1e-2);
    EXPECT_NEAR(fit.slope_error, 0, 1e-9);
    EXPECT_NEAR(fit.r_squared, 1, 1e-12);
}

TEST(LinearFit, HasNoAnswerOutsideItsDomain) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    for (auto const& [x, y] : std::vector<std::pair<std::vector<double>, std::vector<double>>>{
             {{}, {}}, {{1}, {1}}, {{2, 2}, {1, 3}}, {{1, 2}, {1, nan}}, {{1, 2, 3}, {1, 2}}}) {
        EXPECT_TRUE(std::isnan(fit_line(x, y).slope));
    }
    std::vector<double> const x{1, 2, 3}, flat{4, 4, 4};
    EXPECT_EQ(fit_line(x, flat).slope, 0);
    EXPECT_TRUE(std::isnan(fit_line(x, flat).r_squared));
}

}  // namespace
}  // namespace slideway::testing::linear_fit_test
