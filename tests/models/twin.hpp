#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Truth values of a `Twin`.
template <class Half> struct TwinMask {
    Mask<Half> low, high;

    TwinMask() = default;
    SLIDEWAY_FN explicit TwinMask(bool value) : low(mask_of<Half>(value)), high(mask_of<Half>(value)) {}
    SLIDEWAY_FN TwinMask(Mask<Half> of_low, Mask<Half> of_high) : low(of_low), high(of_high) {}

    SLIDEWAY_FN friend TwinMask operator&(TwinMask a, TwinMask b) {
        return {Mask<Half>(a.low & b.low), Mask<Half>(a.high & b.high)};
    }
    SLIDEWAY_FN friend TwinMask operator|(TwinMask a, TwinMask b) {
        return {Mask<Half>(a.low | b.low), Mask<Half>(a.high | b.high)};
    }
    SLIDEWAY_FN friend TwinMask operator!(TwinMask a) { return {negation(a.low), negation(a.high)}; }
};

/// Two packs in one number: lane i of `low` is lane i, lane i of `high` is lane i + lanes<Half>.  A small model's step is a chain of
/// dependent operations that keeps a core a third busy; as a `Real` this type runs two such chains side by side.  It has the
/// vocabulary of kernels/real.hpp, each operation that of its halves, so that a member's bits are those it has in any pack.
/// Members by name, for g++ leaves arrays in memory.
template <class Half> struct Twin {
    Half low, high;

    Twin() = default;
    SLIDEWAY_FN explicit Twin(double value) : low(value), high(value) {}
    SLIDEWAY_FN Twin(Half of_low, Half of_high) : low(of_low), high(of_high) {}

    SLIDEWAY_FN friend Twin operator+(Twin a, Twin b) { return {a.low + b.low, a.high + b.high}; }
    SLIDEWAY_FN friend Twin operator-(Twin a, Twin b) { return {a.low - b.low, a.high - b.high}; }
    SLIDEWAY_FN friend Twin operator*(Twin a, Twin b) { return {a.low * b.low, a.high * b.high}; }
    SLIDEWAY_FN friend Twin operator/(Twin a, Twin b) { return {a.low / b.low, a.high / b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator<(Twin a, Twin b) { return {a.low < b.low, a.high < b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator>(Twin a, Twin b) { return {a.low > b.low, a.high > b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator<=(Twin a, Twin b) { return {a.low <= b.low, a.high <= b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator>=(Twin a, Twin b) { return {a.low >= b.low, a.high >= b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator==(Twin a, Twin b) { return {a.low == b.low, a.high == b.high}; }
    SLIDEWAY_FN friend TwinMask<Half> operator!=(Twin a, Twin b) { return {a.low != b.low, a.high != b.high}; }
};

namespace detail {

template <class Half> struct Traits<Twin<Half>> {
    using Mask = TwinMask<Half>;
    static constexpr int lanes = 2 * Traits<Half>::lanes;
    SLIDEWAY_FN static Mask mask_of(bool value) { return Mask(value); }
};

}  // namespace detail

template <class Half> SLIDEWAY_FN TwinMask<Half> negation(TwinMask<Half> m) { return !m; }
template <class Half> SLIDEWAY_FN bool any(TwinMask<Half> m) { return any(m.low | m.high); }
template <class Half> SLIDEWAY_FN bool all(TwinMask<Half> m) { return all(m.low & m.high); }

template <class Half> SLIDEWAY_FN Twin<Half> select(TwinMask<Half> m, Twin<Half> yes, Twin<Half> no) {
    return {select(m.low, yes.low, no.low), select(m.high, yes.high, no.high)};
}
template <class Half> SLIDEWAY_FN Twin<Half> min(Twin<Half> a, Twin<Half> b) {
    return {min(a.low, b.low), min(a.high, b.high)};
}
template <class Half> SLIDEWAY_FN Twin<Half> max(Twin<Half> a, Twin<Half> b) {
    return {max(a.low, b.low), max(a.high, b.high)};
}
template <class Half> SLIDEWAY_FN Twin<Half> abs(Twin<Half> x) { return {abs(x.low), abs(x.high)}; }
template <class Half> SLIDEWAY_FN Twin<Half> sqrt(Twin<Half> x) { return {sqrt(x.low), sqrt(x.high)}; }
template <class Half> SLIDEWAY_FN Twin<Half> negated(Twin<Half> x) { return {negated(x.low), negated(x.high)}; }
template <class Half> SLIDEWAY_FN Twin<Half> fma(Twin<Half> a, Twin<Half> b, Twin<Half> c) {
    return {fma(a.low, b.low, c.low), fma(a.high, b.high, c.high)};
}
template <class Half> SLIDEWAY_FN Twin<Half> fnma(Twin<Half> a, Twin<Half> b, Twin<Half> c) {
    return {fnma(a.low, b.low, c.low), fnma(a.high, b.high, c.high)};
}
template <class Half> SLIDEWAY_FN Twin<Half> fms(Twin<Half> a, Twin<Half> b, Twin<Half> c) {
    return {fms(a.low, b.low, c.low), fms(a.high, b.high, c.high)};
}

template <class Half> SLIDEWAY_FN void split_exponent(Twin<Half> x, Twin<Half>& mantissa, Twin<Half>& exponent) {
    split_exponent(x.low, mantissa.low, exponent.low);
    split_exponent(x.high, mantissa.high, exponent.high);
}
template <class Half> SLIDEWAY_FN Twin<Half> power_of_two(Twin<Half> n) {
    return {power_of_two(n.low), power_of_two(n.high)};
}

template <class Half> SLIDEWAY_FN double lane(Twin<Half> const& x, int index) {
    return index < lanes<Half> ? lane(x.low, index) : lane(x.high, index - lanes<Half>);
}
template <class Half> SLIDEWAY_FN void set_lane(Twin<Half>& x, int index, double value) {
    if (index < lanes<Half>) {
        set_lane(x.low, index, value);
    } else {
        set_lane(x.high, index - lanes<Half>, value);
    }
}
template <class Half> SLIDEWAY_FN unsigned mask_bits(TwinMask<Half> m) {
    return mask_bits(m.low) | mask_bits(m.high) << lanes<Half>;
}

}  // namespace slideway::inline SLIDEWAY_ISA
