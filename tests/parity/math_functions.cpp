// Compiled once per instruction set.
#include "kernels/isa_real.hpp"
#include "kernels/math/exponential.hpp"
#include "kernels/math/lambert_w.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/real.hpp"
#include "tests/parity/math_functions.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

#if SLIDEWAY_LANES > 1
Real load(double const* from) { return Real::load_unaligned(from); }
void store(double* to, Real value) { value.store_unaligned(to); }
#else
Real load(double const* from) { return *from; }
void store(double* to, Real value) { *to = value; }
#endif

}  // namespace

void evaluate_math(MathFunction function, double const* x, double const* y, double* result, std::size_t count) {
    auto const over = [&](auto each) {
        for (std::size_t i = 0; i < count; i += lanes<Real>) store(result + i, each(load(x + i), load(y + i)));
    };
    switch (function) {
        case MathFunction::sin: return over([](Real a, Real) { return sincos(a).sin; });
        case MathFunction::cos: return over([](Real a, Real) { return sincos(a).cos; });
        case MathFunction::versine: return over([](Real a, Real) { return sincos(a).versine; });
        case MathFunction::sin_quarter: return over([](Real a, Real) { return sin_quarter(a); });
        case MathFunction::log_positive: return over([](Real a, Real) { return log_positive(a); });
        case MathFunction::exp: return over([](Real a, Real) { return exp(a); });
        case MathFunction::power: return over([](Real a, Real b) { return power(a, b); });
        case MathFunction::lambert_numerator:
            return over([](Real a, Real) { return minus_lambert_wm1_exp(a).numerator; });
        case MathFunction::lambert_denominator:
            return over([](Real a, Real) { return minus_lambert_wm1_exp(a).denominator; });
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
