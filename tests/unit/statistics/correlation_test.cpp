#include "host/statistics/correlation.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::correlation_test {
namespace {

double uniform(std::mt19937_64& engine) { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; }

TEST(Midranks, ShareTheMeanOfTies) {
    EXPECT_EQ(midranks(std::vector<double>{3, 1, 3, 2, 3}), (std::vector<double>{4, 1, 4, 2, 4}));
    EXPECT_EQ(midranks(std::vector<double>{1, 1, 0, 0}), (std::vector<double>{3.5, 3.5, 1.5, 1.5}));
    EXPECT_TRUE(midranks({}).empty());
}

TEST(RankCorrelation, IsThatOfTheFormulaWithoutTies) {
    // 1 - 6 Σ d²/(n (n² - 1)): d = 0 -1 1 -1 1, so 1 - 24/120.
    std::vector<double> const x{1, 2, 3, 4, 5}, y{10, 300, 20, 5000, 400};
    EXPECT_NEAR(rank_correlation(midranks(x), midranks(y)).value, 0.8, 1e-15);
    std::vector<double> const falling{5, 4, 3, 2, -1e300};
    EXPECT_DOUBLE_EQ(rank_correlation(midranks(x), midranks(falling)).value, -1);
}

TEST(RankCorrelation, TakesTiesByMidranks) {
    // Ranks 1 2.5 2.5 4 and 1 2 3.5 3.5 about 2.5: Σ = 2.25 + 0 + 0 + 1.5 over √(4.5 · 4.5).
    std::vector<double> const x{0, 1, 1, 2}, y{0, 1, 2, 2};
    EXPECT_NEAR(rank_correlation(midranks(x), midranks(y)).value, 3.75 / 4.5, 1e-15);
}

TEST(RankCorrelation, HasTheIntervalOfItsTransformation) {
    // r = 0.5, n = 28: artanh r = 0.549306, half width 1.959964 √(1.125/25) = 0.415771.
    Interval const interval = rank_correlation_interval(0.5, 28);
    EXPECT_NEAR(interval.low, std::tanh(0.549306 - 0.415771), 1e-6);
    EXPECT_NEAR(interval.high, std::tanh(0.549306 + 0.415771), 1e-6);
    EXPECT_TRUE(std::isnan(rank_correlation_interval(0.5, 3).low));
    EXPECT_EQ(rank_correlation_interval(-1, 10).high, -1);
}

TEST(RankCorrelation, IntervalsCoverAsOftenAsTheySay) {
    // Spearman's ρ of a normal pair is (6/π) arcsin(r/2).
    std::mt19937_64 engine(8);
    double const r = 0.6, truth = 6 / std::acos(-1.0) * std::asin(r / 2);
    constexpr int repetitions = 1000, n = 60;
    int covered = 0;
    for (int k = 0; k < repetitions; ++k) {
        std::vector<double> x(n), y(n);
        for (std::size_t i = 0; i < n; ++i) {
            double const radius = std::sqrt(-2 * std::log(uniform(engine))),
                         angle = 2 * std::acos(-1.0) * uniform(engine);
            x[i] = radius * std::cos(angle);
            y[i] = r * x[i] + std::sqrt(1 - r * r) * radius * std::sin(angle);
        }
        Interval const interval = rank_correlation(midranks(x), midranks(y)).interval;
        covered += interval.low <= truth && truth <= interval.high;
    }
    EXPECT_GT(covered, 0.93 * repetitions);
    EXPECT_LT(covered, 0.97 * repetitions);
}

TEST(RankCorrelation, WithAConstantIsNan) {
    std::vector<double> const x{1, 2, 3, 4, 5}, constant(5, 0.1);
    EXPECT_TRUE(std::isnan(rank_correlation(midranks(x), midranks(constant)).value));
    EXPECT_TRUE(std::isnan(rank_correlation(midranks(constant), midranks(x)).interval.low));
}

TEST(ProductMoment, IsThatOfTheDifferencesOfNumbersWhoseMeanRounds) {
    // k, l beside 2^53, where numbers are 2 apart and their sums round by up to 16.  Of k and l themselves: Σ kl = 14, Σ k = 11, Σ l = 12,
    // Σ k² = 29, Σ l² = 46, so (14 - 22)/√((29 - 121/6)(46 - 24)).
    double const k[] = {2, 4, 1, 2, 0, 2}, l[] = {1, 2, 2, 1, 6, 0};
    std::vector<double> x, y;
    for (std::size_t i = 0; i < 6; ++i) x.push_back(0x1p53 + 2 * k[i]), y.push_back(0x1p53 + 2 * l[i]);
    EXPECT_NEAR(product_moment(x, y), -8 / std::sqrt((29 - 121 / 6.0) * 22), 1e-14);
    // 0 0 0 1 and as many against itself without the offset: the same line.
    EXPECT_NEAR(product_moment(std::vector<double>{0x1p53, 0x1p53, 0x1p53, 0x1p53 + 2}, std::vector<double>{0, 0, 0, 1}), 1, 1e-14);
}

TEST(StandardisedRegression, FindsALinearFunction) {
    // An orthogonal design: x1 of variance 1, x2 of variance 4 (over n), y = 3 x1 - 2 x2 + 5.
    std::vector<double> const x1{1, 1, -1, -1, 1, 1, -1, -1}, x2{2, -2, 2, -2, 2, -2, 2, -2};
    std::vector<double> y;
    for (std::size_t i = 0; i < 8; ++i) y.push_back(3 * x1[i] - 2 * x2[i] + 5);
    std::vector<std::vector<double>> const inputs{x1, x2};
    auto const fit = standardised_regression(inputs, y);
    EXPECT_NEAR(fit.coefficients[0], 3 / 5.0, 1e-14);  // variance of y: 9 + 16
    EXPECT_NEAR(fit.coefficients[1], -4 / 5.0, 1e-14);
    EXPECT_NEAR(fit.r_squared, 1, 1e-14);
}

TEST(StandardisedRegression, SolvesTheNormalEquationsOfManyRows) {
    // More rows than one block.  Of two inputs the standardised coefficients follow from the three correlations.
    std::mt19937_64 engine(9);
    std::vector<double> x1, x2, y;
    for (int i = 0; i < 10000; ++i) {
        x1.push_back(1e3 + uniform(engine));
        x2.push_back(1e-3 * (uniform(engine) + 0.5 * (x1.back() - 1e3)));
        y.push_back(x1.back() + 500 * x2.back() + 0.3 * uniform(engine) * uniform(engine));
    }
    double const r12 = product_moment(x1, x2), r1 = product_moment(x1, y), r2 = product_moment(x2, y);
    double const b1 = (r1 - r12 * r2) / (1 - r12 * r12), b2 = (r2 - r12 * r1) / (1 - r12 * r12);
    std::vector<std::vector<double>> const inputs{x1, x2};
    auto const fit = standardised_regression(inputs, y);
    EXPECT_NEAR(fit.coefficients[0], b1, 1e-9);
    EXPECT_NEAR(fit.coefficients[1], b2, 1e-9);
    EXPECT_NEAR(fit.r_squared, b1 * r1 + b2 * r2, 1e-9);
    EXPECT_LT(fit.r_squared, 0.999);
}

TEST(StandardisedRegression, GivesAConstantInputNothing) {
    std::vector<std::vector<double>> const inputs{{1, 2, 3, 4, 5}, {0.1, 0.1, 0.1, 0.1, 0.1}};
    auto const fit = standardised_regression(inputs, std::vector<double>{2, 4, 6, 8, 10});
    EXPECT_NEAR(fit.coefficients[0], 1, 1e-14);
    EXPECT_EQ(fit.coefficients[1], 0);
}

TEST(StandardisedRegression, NeedsMoreRowsThanInputsAndAnOutputThatVaries) {
    std::vector<std::vector<double>> const inputs{{1, 2}, {2, 1}};
    EXPECT_TRUE(std::isnan(standardised_regression(inputs, std::vector<double>{1, 2}).r_squared));
    std::vector<std::vector<double>> const one{{1, 2, 3}};
    EXPECT_TRUE(std::isnan(standardised_regression(one, std::vector<double>{1, 1, 1}).coefficients[0]));
    std::vector<double> const infinite{1, 2, std::numeric_limits<double>::infinity()};
    EXPECT_TRUE(std::isnan(standardised_regression(one, infinite).r_squared));
}

}  // namespace
}  // namespace slideway::correlation_test
