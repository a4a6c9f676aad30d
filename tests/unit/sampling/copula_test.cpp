#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/sampling/design.hpp"
#include "tests/unit/sampling/samples.hpp"

namespace slideway::copula_test {
namespace {

using Kind = Distribution::Kind;
using testing::columns_of;
using testing::correlation_of;
using testing::design_of;
using testing::variations_of;

TEST(MatrixDefect, NamesTheEntryAndTheReason) {
    using Matrix = std::vector<double>;
    EXPECT_EQ(matrix_defect(Matrix{1, 0.5, 0.5, 1}, 2), std::nullopt);
    EXPECT_EQ(matrix_defect(Matrix{1}, 1), std::nullopt);
    EXPECT_EQ(matrix_defect(Matrix{}, 0), std::nullopt);
    EXPECT_EQ(matrix_defect(Matrix{1, 0.5, 1}, 2),
              "it has 3 entries (a matrix of 2 variables has 4); write 2 rows of 2");
    EXPECT_EQ(matrix_defect(Matrix{1, 0.5, 0.5, 2}, 2),
              "row 2, column 2 is 2 (each value follows itself); write 1 on the diagonal");
    EXPECT_EQ(matrix_defect(Matrix{1, 1.5, 1.5, 1}, 2),
              "row 1, column 2 is 1.5 (a correlation lies in [-1, 1]); use a value between");
    EXPECT_EQ(matrix_defect(Matrix{1, std::nan(""), 0, 1}, 2),
              "row 1, column 2 is nan (a correlation lies in [-1, 1]); use a value between");
    EXPECT_EQ(matrix_defect(Matrix{1, 0.5, 0.25, 1}, 2),
              "row 1, column 2 is 0.5, row 2, column 1 is 0.25 (the matrix is symmetric); give both the same value");
    // Two that agree and a third that follows one and opposes the other: determinant 1 + 2 r12 r13 r23 − Σ r² < 0.
    EXPECT_EQ(matrix_defect(Matrix{1, 0.9, 0.9, 0.9, 1, -0.9, 0.9, -0.9, 1}, 3),
              "it is not positive definite (no variables have such correlations, or one follows from the others); "
              "use weaker correlations");
    EXPECT_NE(matrix_defect(Matrix{1, 1, 1, 1}, 2), std::nullopt);
    // Singular, though rounding leaves a tiny pivot: three unit vectors of one plane, 30 degrees apart.
    double const r = std::cos(std::numbers::pi / 6);
    EXPECT_NE(matrix_defect(Matrix{1, r, 0.5, r, 1, r, 0.5, r, 1}, 3), std::nullopt);
}

TEST(CholeskyFactor, IsTheMatrixWhenSquared) {
    std::vector<double> const matrix = {1, 0.5, -0.25, 0.5, 1, 0.125, -0.25, 0.125, 1};
    auto const lower = cholesky_factor(matrix, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += lower[i * 3 + k] * lower[j * 3 + k];
            EXPECT_NEAR(sum, matrix[i * 3 + j], 1e-15);
            EXPECT_TRUE(j <= i || lower[i * 3 + j] == 0);
        }
    }
    EXPECT_THROW(cholesky_factor(std::vector<double>{1, 2, 2, 1}, 2), SceneError);
}

constexpr std::size_t draws = 100000;
// Standard deviation of r is at most 1/√n.
double const tolerance = 5 / std::sqrt(static_cast<double>(draws));

Design correlated_design(DesignKind kind, std::vector<std::size_t> variations, std::vector<double> matrix) {
    Design design = design_of(kind);
    design.correlation = {std::move(variations), std::move(matrix)};
    return design;
}

TEST(Correlation, NormalDrawsHaveTheMatrix) {
    auto const variations = variations_of(4, {Kind::normal, 3, 0.5});
    for (DesignKind const kind : {DesignKind::mc, DesignKind::lhs, DesignKind::sobol}) {
        // In another order than the variations', one of which stays alone.
        Design const design = correlated_design(kind, {3, 0, 1}, {1, 0.8, -0.3, 0.8, 1, 0.2, -0.3, 0.2, 1});
        auto const x = columns_of(design, variations, draws);
        EXPECT_NEAR(correlation_of(x[3], x[0]), 0.8, tolerance) << name_of(kind);
        EXPECT_NEAR(correlation_of(x[3], x[1]), -0.3, tolerance);
        EXPECT_NEAR(correlation_of(x[0], x[1]), 0.2, tolerance);
        for (std::size_t const other : {0u, 1u, 3u}) EXPECT_NEAR(correlation_of(x[2], x[other]), 0, tolerance);
        for (auto const& column : x) {
            EXPECT_NEAR(testing::mean_of(column), 3, 0.5 * tolerance);
            double square = 0;
            for (double const value : column) square += (value - 3) * (value - 3);
            EXPECT_NEAR(std::sqrt(square / draws), 0.5, 0.5 * tolerance);
        }
    }
}

TEST(Correlation, UniformDrawsFollowTheCopula) {
    // Spearman's ρ of a normal copula is 6/π asin(r/2) (Kruskal 1958), which is Pearson's of uniform marginals.
    auto const x = columns_of(correlated_design(DesignKind::mc, {0, 1}, {1, 0.7, 0.7, 1}),
                              variations_of(2, testing::unit_uniform()), draws);
    EXPECT_NEAR(correlation_of(x[0], x[1]), 6 / std::numbers::pi * std::asin(0.35), tolerance);
    EXPECT_NEAR(testing::mean_of(x[1]), 0.5, tolerance);
}

TEST(Correlation, LognormalDrawsFollowTheCopula) {
    // Pearson's of lognormals of log-deviation σ is (e^(σ² r) − 1)/(e^(σ²) − 1);
    // sd = mean √(e^(σ²) − 1), here σ² = ln 1.25.
    auto const x = columns_of(correlated_design(DesignKind::sobol, {0, 1}, {1, -0.6, -0.6, 1}),
                              variations_of(2, {Kind::lognormal, 4, 2}), draws);
    EXPECT_NEAR(correlation_of(x[0], x[1]), (std::pow(1.25, -0.6) - 1) / 0.25, tolerance);
    EXPECT_NEAR(testing::mean_of(x[1]), 4, 2 * tolerance);
}

TEST(Correlation, TheFirstKeepsItsOwnDraws) {
    auto const variations = variations_of(3, {Kind::normal, 3, 0.5});
    auto const alone = columns_of(design_of(DesignKind::mc), variations, 100);
    auto const together = columns_of(correlated_design(DesignKind::mc, {1, 2}, {1, 0.5, 0.5, 1}), variations, 100);
    EXPECT_EQ(alone[0], together[0]);
    EXPECT_EQ(alone[1], together[1]);
    EXPECT_NE(alone[2], together[2]);
    for (std::size_t i = 0; i < 100; ++i) {  // x₂ = μ + σ (r z₁ + √(1 − r²) z₂)
        double const z1 = (alone[1][i] - 3) / 0.5, z2 = (alone[2][i] - 3) / 0.5;
        EXPECT_NEAR(together[2][i], 3 + 0.5 * (0.5 * z1 + std::sqrt(0.75) * z2), 1e-14);
    }
}

TEST(Correlation, DesignsWithoutRoomForItRefuse) {
    auto const variations = variations_of(2, testing::unit_uniform());
    std::vector<double> const matrix = {1, 0.5, 0.5, 1};
    Design saltelli = correlated_design(DesignKind::saltelli, {0, 1}, matrix);
    saltelli.base = 4;
    EXPECT_THROW(Sampler(saltelli, variations, 1, 16), SceneError);
    Design grid = correlated_design(DesignKind::grid, {0, 1}, matrix);
    grid.levels = {2, 2};
    EXPECT_THROW(Sampler(grid, variations, 1, 4), SceneError);
    EXPECT_THROW(Sampler(correlated_design(DesignKind::mc, {0, 2}, matrix), variations, 1, 4), SceneError);
    EXPECT_THROW(Sampler(correlated_design(DesignKind::mc, {0, 0}, matrix), variations, 1, 4), SceneError);
    EXPECT_THROW(Sampler(correlated_design(DesignKind::mc, {0, 1}, {1, 2, 2, 1}), variations, 1, 4), SceneError);
    EXPECT_NO_THROW(Sampler(correlated_design(DesignKind::mc, {0, 1}, matrix), variations, 1, 4));
}

}  // namespace
}  // namespace slideway::copula_test
