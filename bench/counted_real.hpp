// A number that counts what is done to it: the useful flops of a kernel, found by running it.
#pragma once

#include <type_traits>

#include "kernels/math/exponential.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A double that counts additions, multiplications, divisions and square roots as one operation each and a multiply-add as two.
/// Comparisons, selections, signs and moves are free.
struct Counted {
    double value;
    static inline unsigned long long operations = 0;

    Counted() = default;
    explicit Counted(double x) : value(x) {}

    static Counted of(double x, unsigned cost) {
        operations += cost;
        return Counted(x);
    }
    friend Counted operator+(Counted a, Counted b) { return of(a.value + b.value, 1); }
    friend Counted operator-(Counted a, Counted b) { return of(a.value - b.value, 1); }
    friend Counted operator*(Counted a, Counted b) { return of(a.value * b.value, 1); }
    friend Counted operator/(Counted a, Counted b) { return of(a.value / b.value, 1); }
    friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
    friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
    friend bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
    friend bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
    friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
    friend bool operator!=(Counted a, Counted b) { return a.value != b.value; }
};

SLIDEWAY_FN Counted select(bool m, Counted yes, Counted no) { return m ? yes : no; }
SLIDEWAY_FN Counted min(Counted a, Counted b) { return Counted(min(a.value, b.value)); }
SLIDEWAY_FN Counted max(Counted a, Counted b) { return Counted(max(a.value, b.value)); }
SLIDEWAY_FN Counted abs(Counted x) { return Counted(abs(x.value)); }
SLIDEWAY_FN Counted negated(Counted x) { return Counted(-x.value); }
SLIDEWAY_FN Counted sqrt(Counted x) { return Counted::of(sqrt(x.value), 1); }
SLIDEWAY_FN Counted fma(Counted a, Counted b, Counted c) { return Counted::of(fma(a.value, b.value, c.value), 2); }
SLIDEWAY_FN Counted fnma(Counted a, Counted b, Counted c) { return Counted::of(fnma(a.value, b.value, c.value), 2); }
SLIDEWAY_FN Counted fms(Counted a, Counted b, Counted c) { return Counted::of(fms(a.value, b.value, c.value), 2); }
SLIDEWAY_FN Counted power_of_two(Counted n) { return Counted(power_of_two(n.value)); }
SLIDEWAY_FN void split_exponent(Counted x, Counted& mantissa, Counted& exponent) {
    split_exponent(x.value, mantissa.value, exponent.value);
}
SLIDEWAY_FN SinCos<Counted> sincos(Counted x) { return detail::sine_and_cosine(x); }
SLIDEWAY_FN Counted exp(Counted x) { return detail::exp_of_sum(x, Counted(0.0)); }
template <int bit> SLIDEWAY_FN bool bit_of(Counted n) { return bit_of<bit>(n.value); }
template <class Real, class Number>
    requires std::is_same_v<Real, Counted>
SLIDEWAY_FN Counted of_lanes(Number const& number) {
    return Counted(number(0));
}
SLIDEWAY_FN double lane(Counted x, int) { return x.value; }
SLIDEWAY_FN void set_lane(Counted& x, int, double value) { x.value = value; }

}  // namespace slideway::inline SLIDEWAY_ISA
