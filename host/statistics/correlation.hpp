// How an output follows its inputs, from draws of any design.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/statistics/summary.hpp"

namespace slideway {

/// Ranks from 1, ties with the mean of the ranks they share (midranks).  @param values no NaN.
std::vector<double> midranks(std::span<double const> values);

/// Product-moment correlation Σ(x-x̄)(y-ȳ)/√(Σ(x-x̄)² Σ(y-ȳ)²).
/// @return NaN where one of them is constant or not finite.
double product_moment(std::span<double const> x, std::span<double const> y);

/// Interval of a rank correlation r of n independent pairs, tanh(artanh r ± z √((1 + r²/2)/(n-3))): Fisher's
/// transformation with the variance of Spearman's r, z the (1+level)/2 quantile of the normal distribution.
/// 95 % ones hold the rank correlation of normal pairs in 95 to 96 % of studies of 20 pairs or more, in 95 to 97.5 % of 10.
/// Source: Fisher (1921), Metron 1; Bonett and Wright (2000), Sample size requirements for estimating Pearson, Kendall
/// and Spearman correlations, Psychometrika 65, table 1.
/// @return NaN with n < 4; r itself where it is 1 or -1.
Interval rank_correlation_interval(double r, std::size_t n, double level = 0.95);

/// Spearman's rank correlation: the product-moment correlation of midranks, with its interval.
/// @param x, y [n], midranks.
Estimate rank_correlation(std::span<double const> x, std::span<double const> y, double level = 0.95);

/// Linear regression of the standardised output on the standardised inputs.
struct StandardisedRegression {
    std::vector<double> coefficients;  // [inputs], dimensionless; 0 for an input that is constant
    double r_squared;                  // share of the output's variance that the linear function explains
};

/// Least squares of (y-ȳ)/s_y on (x_i-x̄_i)/s_i by a QR decomposition with column pivoting (Eigen).  Columns that
/// depend linearly on others share the effect by the minimum norm.  Rows are taken in blocks that are folded into a
/// triangle one after the other, so that no matrix of all rows is needed.
/// Source: Saltelli et al. (2008), Global Sensitivity Analysis, 1.2.5; Golub and Van Loan (2013), 5.3.
/// @param inputs [columns] of [n] each; @param output [n]; no NaN.
/// @return NaN where n <= inputs or the output is constant or not finite.
StandardisedRegression standardised_regression(std::span<std::vector<double> const> inputs,
                                               std::span<double const> output);

}  // namespace slideway
