// The functions of kernels/math, one at a time over arrays, as each instruction set computes them.
#pragma once

#include <cstddef>

namespace slideway {

enum class MathFunction {
    sin,
    cos,
    versine,
    sin_quarter,
    log_positive,
    exp,
    power,
    lambert_numerator,
    lambert_denominator,
};
inline constexpr int math_function_count = 9;

/// result[i] = function(x[i], y[i]); only power reads y.  count is a multiple of 8.  Each instruction set's namespace
/// has one, `evaluate_math`.
using MathEvaluator = void(MathFunction function, double const* x, double const* y, double* result, std::size_t count);

}  // namespace slideway
