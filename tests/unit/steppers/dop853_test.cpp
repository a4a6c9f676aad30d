// The coefficients against conditions that are independent of them, and the method's orders on problems with closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/steppers/dop853.hpp"
#include "tests/unit/steppers/logistic.hpp"

namespace slideway::dop853_test {
namespace {

constexpr Dop853 w{};

double dot_b(double const* b, int power, int stages = 13) {
    double sum = 0;
    for (int i = 0; i < stages; ++i) sum += b[i] * std::pow(w.c[i], power);
    return sum;
}

TEST(Dop853, RowsSumToTheirNodes) {
    for (int i = 0; i < 16; ++i) {
        double sum = 0;
        for (int j = 0; j < i; ++j) sum += w.a[i][j];
        EXPECT_NEAR(sum, w.c[i], 2e-14) << "row " << i;
    }
    for (int j = 0; j < 12; ++j) EXPECT_EQ(w.a[12][j], w.b[j]) << "the last stage is the step's end";
}

TEST(Dop853, QuadraturesHaveTheirOrders) {
    // ∫ c^p = 1/(p + 1) for p up to 7; the estimates' weights vanish on what their embedded methods integrate too.
    for (int p = 0; p < 8; ++p) EXPECT_NEAR(dot_b(w.b, p), 1.0 / (p + 1), 1e-14) << p;
    EXPECT_GT(std::abs(dot_b(w.b, 8) - 1.0 / 9), 1e-6);
    for (int p = 0; p < 5; ++p) EXPECT_NEAR(dot_b(w.e, p), 0, 1e-14) << p;
    EXPECT_GT(std::abs(dot_b(w.e, 5)), 1e-6);
    for (int p = 0; p < 3; ++p) EXPECT_NEAR(dot_b(w.coarse, p), 0, 1e-14) << p;
    EXPECT_GT(std::abs(dot_b(w.coarse, 3)), 1e-6);
}

TEST(Dop853, HasOrderEight) { EXPECT_NEAR(testing::observed_order(testing::logistic_error<Dop853>, 0.5), 8, 0.5); }

TEST(Dop853, EstimatesFallWithOrdersSixAndFour) {
    auto const estimate = [](bool coarse) {
        return [coarse](double h) {
            testing::Logistic<Dop853> o;
            o.step(h);
            return o.estimate(h, coarse);
        };
    };
    EXPECT_NEAR(testing::observed_order(estimate(false), 0.1), 6, 0.3);
    EXPECT_NEAR(testing::observed_order(estimate(true), 0.1), 4, 0.3);
}

TEST(Dop853, DenseOutputHasOrderSevenInsideTheStep) {
    for (double const theta : {0.1, 0.37, 0.5, 0.8}) {
        auto const local = [theta](double h) { return testing::dense_error<Dop853>(h, theta); };
        EXPECT_GT(testing::observed_order(local, 1.0), 7.5) << "local error of order h^8 at " << theta;
    }
}

TEST(Dop853, DenseOutputMeetsBothEnds) {
    testing::Logistic<Dop853> o;
    o.step(0.3);
    testing::expect_dense_meets_ends<Dop853>(o, 0.3, 1e-16);
}

}  // namespace
}  // namespace slideway::dop853_test
