// Straight line through points.
#pragma once

#include <cstddef>
#include <span>

namespace slideway {

/// y ≈ intercept + slope·x.
struct LinearFit {
    double slope, intercept;
    double slope_error;  // standard error of the slope; NaN for two points
    double r_squared;    // 1 - Σ(y - ŷ)²/Σ(y - ȳ)², in [0, 1]; NaN if all y are the same
    std::size_t points;
};

/// Ordinary least squares.  With x̄, ȳ the means and Sxx = Σ(x - x̄)², Sxy = Σ(x - x̄)(y - ȳ):
/// slope = Sxy/Sxx, intercept = ȳ - slope·x̄, slope_error² = Σ(y - ŷ)²/((n - 2) Sxx).  The standard error takes the
/// residuals as independent; those of a smooth curve are not, and then it is too small.
/// @param x, y of one length, any units.
/// @return all NaN for less than two points, numbers that are not finite or one x only.
LinearFit fit_line(std::span<double const> x, std::span<double const> y);

}  // namespace slideway
