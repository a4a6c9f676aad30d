// The coefficients against conditions that are independent of them, and the method's orders on a problem with a closed form.
#include "kernels/steppers/verner65.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/lanes/stepped_numbers.hpp"
#include "tests/unit/steppers/logistic.hpp"

namespace slideway::verner65_test {
namespace {

constexpr Verner65Tableau w{};
constexpr int stages = 9;

double moment(double const* weights, int power) {
    double sum = 0;
    for (int i = 0; i < stages; ++i) sum += weights[i] * std::pow(w.c[i], power);
    return sum;
}

TEST(Verner65, RowsSumToTheirNodes) {
    for (int i = 0; i < stages; ++i) {
        double sum = 0;
        for (int j = 0; j < i; ++j) sum += w.a[i][j];
        EXPECT_NEAR(sum, w.c[i], 2e-13) << "row " << i;
    }
    for (int j = 0; j < stages - 1; ++j) EXPECT_EQ(w.a[8][j], w.b[j]) << "the last stage is the step's end";
}

TEST(Verner65, QuadraturesHaveTheirOrders) {
    for (int p = 0; p < 6; ++p) EXPECT_NEAR(moment(w.b, p), 1.0 / (p + 1), 2e-13) << p;
    for (int p = 0; p < 5; ++p) EXPECT_NEAR(moment(w.e, p), 0, 2e-13) << p;
    EXPECT_GT(std::abs(moment(w.e, 5)), 1e-6);
}

TEST(Verner65, HasOrderSixAndAnEstimateOfOrderFive) {
    EXPECT_NEAR(testing::observed_order(testing::logistic_error<Verner65>, 0.5), 6, 0.5);
    auto const estimate = [](double h) {
        testing::Logistic<Verner65> o;
        o.step(h);
        return o.estimate(h);
    };
    EXPECT_NEAR(testing::observed_order(estimate, 0.1), 6, 0.3) << "of one step: h^6";
}

TEST(Verner65, DenseOutputHasOrderFourInsideTheStepAndMeetsItsEnds) {
    for (double const theta : {0.1, 0.37, 0.5, 0.8}) {
        // Over three halvings, for single ones meet zeros of the error.
        double const fallen = testing::dense_error<Verner65>(2, theta) / testing::dense_error<Verner65>(0.25, theta);
        EXPECT_GT(std::log2(fallen) / 3, 3.6) << "local error of order h^5 at " << theta;
    }
    testing::Logistic<Verner65> o;
    o.step(0.3);
    testing::expect_dense_meets_ends<Verner65>(o, 0.3, 1e-15);
}

TEST(Verner65, DenseOutputHasOrderFiveInTheMiddle) {
    double const fallen = testing::dense_error<Verner65>(2, 0.5) / testing::dense_error<Verner65>(0.25, 0.5);
    EXPECT_GT(std::log2(fallen) / 3, 5.4) << "local error of order h^6";
}

/// Error at fraction θ of a step whose slope in the middle is known.
double inner_error(double h, double theta) {
    testing::Logistic<Verner65> o;
    o.step(h);
    SteppedNumbers<Verner65, 1, double> numbers;
    numbers.start[0] = o.y[0];
    numbers.end[0] = o.end[0];
    for (int s = 0; s < stages; ++s) numbers.k[s][0] = o.k[s][0];
    numbers.forget_middle();
    double const middle = numbers.at(0, h, 0.5);
    numbers.set_middle(true, 0, h, middle * (1 - middle));
    EXPECT_EQ(numbers.at(0, h, 0), o.y[0]);
    EXPECT_NEAR(numbers.at(0, h, 1), o.end[0], 1e-15);
    EXPECT_EQ(numbers.at(0, h, 0.5), middle) << "what is right to order 5 already";
    return std::abs(numbers.at(0, h, theta) - o.exact(theta * h));
}

TEST(SteppedNumbers, HaveOrderFiveAllOverAStepWhoseMiddleIsKnown) {
    for (double const theta : {0.1, 0.25, 0.37, 0.6, 0.8, 0.95}) {
        EXPECT_GT(std::log2(inner_error(2, theta) / inner_error(0.25, theta)) / 3, 4.8) << "local error of order h^6 at " << theta;
        EXPECT_LT(inner_error(0.5, theta), 0.2 * testing::dense_error<Verner65>(0.5, theta)) << theta;
    }
}

}  // namespace
}  // namespace slideway::verner65_test
