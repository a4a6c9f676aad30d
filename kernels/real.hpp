// The vocabulary of the kernels; with kernels/simd, all that knows the backends.  Physics is written once for a type
// `Real`, which is `double` (one member, on the host or inside a CUDA thread) or `xsimd::batch<double, Arch>` (one
// member per lane).  Every operation here gives the same bits for both, on every machine.
//
// Numbers are initialised in parentheses, Real(0.5) or Real const half(0.5): with braces a pack takes a list of its lanes, of which one number is the
// first (Repository.NumbersOfKernelsAreNotInitialisedInBraces looks for it).
//
// All kernel code lives in `slideway::SLIDEWAY_ISA`, an inline namespace named by the unit that compiles it.  Units
// built for different instruction sets so never share an inline function: the linker cannot hand AVX-512 code to a
// machine without it.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "kernels/simd/instructions.hpp"

#if defined(SLIDEWAY_SIMD)
#include <bit>
#include <utility>
#include <xsimd/xsimd.hpp>
#endif

namespace slideway::inline SLIDEWAY_ISA {

/// Quiet NaN: a value that is not there.
inline constexpr double not_a_number = __builtin_nan("");

// ---- double ---------------------------------------------------------------------------------------------------

namespace detail {

SLIDEWAY_FN std::uint64_t bits_of(double x) {
#if defined(__CUDA_ARCH__)
    return static_cast<std::uint64_t>(__double_as_longlong(x));
#else
    return __builtin_bit_cast(std::uint64_t, x);
#endif
}

SLIDEWAY_FN double from_bits(std::uint64_t bits) {
#if defined(__CUDA_ARCH__)
    return __longlong_as_double(static_cast<long long>(bits));
#else
    return __builtin_bit_cast(double, bits);
#endif
}

template <class Real> struct Traits {
    using Mask = bool;
    static constexpr int lanes = 1;
    SLIDEWAY_FN static Mask mask_of(bool value) { return value; }
};

}  // namespace detail

/// Truth value per lane.
template <class Real> using Mask = typename detail::Traits<Real>::Mask;
/// Members that one `Real` holds.
template <class Real> inline constexpr int lanes = detail::Traits<Real>::lanes;

SLIDEWAY_FN bool any(bool m) { return m; }
SLIDEWAY_FN bool all(bool m) { return m; }
SLIDEWAY_FN bool negation(bool m) { return !m; }
SLIDEWAY_FN double select(bool m, double yes, double no) { return m ? yes : no; }

// The comparisons are written as the SIMD instructions make them, so that NaN and signed zero agree.
SLIDEWAY_FN double min(double a, double b) { return a < b ? a : b; }
SLIDEWAY_FN double max(double a, double b) { return a > b ? a : b; }
SLIDEWAY_FN double abs(double x) { return ::fabs(x); }
SLIDEWAY_FN double sqrt(double x) { return ::sqrt(x); }

/// −x, of zero too.  Kernels write it so: xsimd's unary minus is 0 − x under AVX-512, which turns 0 into 0.
SLIDEWAY_FN double negated(double x) { return -x; }

/// a·b + c, rounded once.
SLIDEWAY_FN double fma(double a, double b, double c) {
#if defined(__CUDA_ARCH__)
    return ::fma(a, b, c);
#else
    return __builtin_fma(a, b, c);
#endif
}

/// c - a·b, rounded once.
SLIDEWAY_FN double fnma(double a, double b, double c) { return fma(-a, b, c); }
/// a·b - c, rounded once.
SLIDEWAY_FN double fms(double a, double b, double c) { return fma(a, b, -c); }

/// Mantissa in [1, 2) and exponent of a normal positive x: x = mantissa · 2^exponent.
SLIDEWAY_FN void split_exponent(double x, double& mantissa, double& exponent) {
    std::uint64_t const bits = detail::bits_of(x);
    mantissa = detail::from_bits((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
    exponent = detail::from_bits((bits >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023.0);
}

/// 2^n for an integral n in [-1022, 1023].
SLIDEWAY_FN double power_of_two(double n) {
    return detail::from_bits(detail::bits_of(n + (4503599627370496.0 + 1023.0)) << 52);
}

/// Bit of a whole number in [0, 2^52).
template <int bit> SLIDEWAY_FN bool bit_of(double n) { return (detail::bits_of(n + 4503599627370496.0) >> bit & 1u) != 0; }

SLIDEWAY_FN double lane(double x, int) { return x; }
SLIDEWAY_FN void set_lane(double& x, int, double value) { x = value; }
template <class Real, class Number> requires std::is_same_v<Real, double>
SLIDEWAY_FN double of_lanes(Number const& number) { return number(0); }
SLIDEWAY_FN unsigned mask_bits(bool m) { return m ? 1u : 0u; }

// ---- xsimd ----------------------------------------------------------------------------------------------------
// Argument-dependent lookup finds xsimd's functions too.  A name that xsimd has is therefore overloaded here for
// `Batch<Arch>`, which is the better match; functions on a bare `Real` bear names that xsimd lacks.
#if defined(SLIDEWAY_SIMD)

template <class Arch> using Batch = xsimd::batch<double, Arch>;
template <class Arch> using BatchMask = xsimd::batch_bool<double, Arch>;

namespace detail {

template <class Arch> struct Traits<xsimd::batch<double, Arch>> {
    using Mask = xsimd::batch_bool<double, Arch>;
    static constexpr int lanes = static_cast<int>(xsimd::batch<double, Arch>::size);
    SLIDEWAY_FN static Mask mask_of(bool value) { return Instructions<lanes>::mask_of(value); }
};

/// Of packs.
template <class Arch> using Own = Instructions<Traits<xsimd::batch<double, Arch>>::lanes>;

}  // namespace detail

template <class Arch> SLIDEWAY_FN bool any(BatchMask<Arch> m) { return xsimd::any(m); }
template <class Arch> SLIDEWAY_FN bool all(BatchMask<Arch> m) { return xsimd::all(m); }
/// !m.  xsimd's own compares with a mask that it builds bit by bit.
template <class Arch> SLIDEWAY_FN BatchMask<Arch> negation(BatchMask<Arch> m) { return ~m; }
template <class Arch> SLIDEWAY_FN Batch<Arch> select(BatchMask<Arch> m, Batch<Arch> yes, Batch<Arch> no) {
    return xsimd::select(m, yes, no);
}
template <class Arch> SLIDEWAY_FN Batch<Arch> min(Batch<Arch> a, Batch<Arch> b) { return detail::Own<Arch>::min(a, b); }
template <class Arch> SLIDEWAY_FN Batch<Arch> max(Batch<Arch> a, Batch<Arch> b) { return detail::Own<Arch>::max(a, b); }
template <class Arch> SLIDEWAY_FN Batch<Arch> abs(Batch<Arch> x) { return xsimd::abs(x); }
template <class Arch> SLIDEWAY_FN Batch<Arch> sqrt(Batch<Arch> x) { return xsimd::sqrt(x); }

template <class Arch> SLIDEWAY_FN Batch<Arch> negated(Batch<Arch> x) {
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    return xsimd::bitwise_cast<Batch<Arch>>(xsimd::bitwise_cast<Bits>(x) ^ Bits(0x8000000000000000u));
}

template <class Arch> SLIDEWAY_FN Batch<Arch> fma(Batch<Arch> a, Batch<Arch> b, Batch<Arch> c) {
    return detail::Own<Arch>::fma(a, b, c);
}
template <class Arch> SLIDEWAY_FN Batch<Arch> fnma(Batch<Arch> a, Batch<Arch> b, Batch<Arch> c) {
    return detail::Own<Arch>::fnma(a, b, c);
}
template <class Arch> SLIDEWAY_FN Batch<Arch> fms(Batch<Arch> a, Batch<Arch> b, Batch<Arch> c) {
    return detail::Own<Arch>::fms(a, b, c);
}

template <class Arch> SLIDEWAY_FN void split_exponent(Batch<Arch> x, Batch<Arch>& mantissa, Batch<Arch>& exponent) {
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    auto const bits = xsimd::bitwise_cast<Bits>(x);
    mantissa = xsimd::bitwise_cast<Batch<Arch>>((bits & Bits(0x000fffffffffffffu)) | Bits(0x3ff0000000000000u));
    exponent = xsimd::bitwise_cast<Batch<Arch>>((bits >> 52) | Bits(0x4330000000000000u)) -
               Batch<Arch>(4503599627370496.0 + 1023.0);
}

template <class Arch> SLIDEWAY_FN Batch<Arch> power_of_two(Batch<Arch> n) {
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    auto const bits = xsimd::bitwise_cast<Bits>(n + Batch<Arch>(4503599627370496.0 + 1023.0));
    return xsimd::bitwise_cast<Batch<Arch>>(bits << 52);
}

/// Bit of a whole number in [0, 2^52).
template <int bit, class Arch> SLIDEWAY_FN BatchMask<Arch> bit_of(Batch<Arch> n) {
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    // 1, or the bit's number of units in the last place above it.
    auto const bits = xsimd::bitwise_cast<Bits>(n + Batch<Arch>(4503599627370496.0)) & Bits(std::uint64_t{1} << bit);
    return xsimd::bitwise_cast<Batch<Arch>>(bits | Bits(0x3ff0000000000000u)) > Batch<Arch>(1.0);
}

template <class Arch> SLIDEWAY_FN double lane(Batch<Arch> const& x, int index) {
    alignas(64) double values[lanes<Batch<Arch>>];
    x.store_aligned(values);
    return values[index];
}
template <class Arch> SLIDEWAY_FN void set_lane(Batch<Arch>& x, int index, double value) {
    alignas(64) double values[lanes<Batch<Arch>>];
    x.store_aligned(values);
    values[index] = value;
    x = Batch<Arch>::load_aligned(values);
}

/// Of what a function says for each lane.
template <class Real, class Number> requires (lanes<Real> > 1)
SLIDEWAY_FN Real of_lanes(Number const& number) {
    return [&]<int... i>(std::integer_sequence<int, i...>) { return Real({number(i)...}); }(std::make_integer_sequence<int, lanes<Real>>());
}

/// Bit i is the truth value of lane i.
template <class Arch> SLIDEWAY_FN unsigned mask_bits(BatchMask<Arch> m) { return detail::Own<Arch>::mask_bits(m); }

#endif  // SLIDEWAY_SIMD

// ---- the same for both ------------------------------------------------------------------------------------------

template <class M> SLIDEWAY_FN bool none(M m) { return !any(m); }

/// Nearest integer, ties to even; |x| < 2^51.
template <class Real> SLIDEWAY_FN Real round_even(Real x) {
    Real const shift(6755399441055744.0);  // 1.5 · 2^52
    return (x + shift) - shift;
}

/// Largest whole number that is not above x; |x| < 2^51.
template <class Real> SLIDEWAY_FN Real rounded_down(Real x) {
    Real const nearest = round_even(x);
    return select(nearest > x, nearest - Real(1.0), nearest);
}

/// Truth value of every lane from one plain bool, which holds for the whole pack.
template <class Real> SLIDEWAY_FN Mask<Real> mask_of(bool value) { return detail::Traits<Real>::mask_of(value); }

/// Bits that are set.
SLIDEWAY_FN int population(unsigned bits) {
#if defined(__CUDA_ARCH__)
    return __popc(bits);
#else
    return __builtin_popcount(bits);
#endif
}

/// Adds to a number that others add to at the same time.  @return what it was before.
SLIDEWAY_FN std::uint64_t fetch_add(std::uint64_t& number, std::uint64_t amount) {
#if defined(__CUDA_ARCH__)
    static_assert(sizeof(unsigned long long) == sizeof(std::uint64_t));
    return atomicAdd(reinterpret_cast<unsigned long long*>(&number), static_cast<unsigned long long>(amount));
#else
    return __atomic_fetch_add(&number, amount, __ATOMIC_RELAXED);
#endif
}

/// Whether a flag, which may be nullptr, is not 0; another thread or the host of a card may raise it meanwhile.
SLIDEWAY_FN bool is_raised(int const volatile* flag) {
#if defined(__CUDA_ARCH__)
    return flag != nullptr && *flag != 0;
#else
    return flag != nullptr && __atomic_load_n(flag, __ATOMIC_RELAXED) != 0;
#endif
}

/// What a function of the host says, which may be nullptr, to a number; no on a card, where it cannot be called.
SLIDEWAY_FN bool host_says([[maybe_unused]] bool (*question)(void const*, double), [[maybe_unused]] void const* context,
                           [[maybe_unused]] double number) {
#if defined(__CUDA_ARCH__)
    return false;
#else
    return question != nullptr && question(context, number);
#endif
}

/// Lanes in which the mask holds.
template <class M> SLIDEWAY_FN int held_lanes(M m) { return population(mask_bits(m)); }

/// Truth value of one lane.
template <class M> SLIDEWAY_FN bool holds(M m, int index) { return (mask_bits(m) >> index) & 1u; }

/// 1 where the mask holds, else 0.
template <class Real> SLIDEWAY_FN Real count(Mask<Real> m) { return select(m, Real(1.0), Real(0.0)); }

}  // namespace slideway::inline SLIDEWAY_ISA
