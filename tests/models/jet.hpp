#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/trap.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Memory of the operations of one function, in the order in which it makes them: a row of Taylor coefficients each.
template <class Real, int length> struct JetRows {
    static constexpr int most = 48;  // operations
    Real row[most][length];
    int used = 0;

    /// The next operation's row.
    SLIDEWAY_FN Real* next() {
        if (used == most) trap();
        return row[used++];
    }
};

/// A number that is a Taylor series in time, x(t₀ + h) = Σ x_k hᵏ, in every lane.  A function written for any `Real` gives, called with
/// k = 0, 1, … in turn and `JetRows::used` = 0 each time, the k-th coefficients of its results from the coefficients up to k of what it is
/// given: each operation keeps those that it found before.  n coefficients so cost n²/2 multiplications for each product.  Decisions are
/// those at t₀.  Source: the recurrences of Moore, Interval Analysis (1966), ch. 11; Jorba & Zou, Experimental Mathematics 14 (2005) 99,
/// Proposition 2.1.
template <class Real, int length, int k> struct Jet {
    using Rows = JetRows<Real, length>;

    Jet() = default;
    /// What does not depend on time.
    SLIDEWAY_FN explicit Jet(double value) : constant(value), c(nullptr), rows(nullptr) {}
    SLIDEWAY_FN explicit Jet(Real value) requires(!std::is_same_v<Real, double>) : constant(value), c(nullptr), rows(nullptr) {}
    SLIDEWAY_FN Jet(Real* coefficients, Rows* all) : c(coefficients), rows(all) {}

    SLIDEWAY_FN bool is_constant() const { return c == nullptr; }
    SLIDEWAY_FN Real first() const { return is_constant() ? constant : c[0]; }
    /// The k-th coefficient, of a constant too.
    SLIDEWAY_FN Real last() const { return !is_constant() ? c[k] : k == 0 ? constant : Real(0.0); }

    Real constant;
    Real* c;
    Rows* rows;
};

namespace detail {

template <class Real, int n, int k> struct Traits<Jet<Real, n, k>> {
    using Mask = typename Traits<Real>::Mask;
    static constexpr int lanes = Traits<Real>::lanes;
    SLIDEWAY_FN static Mask mask_of(bool value) { return Traits<Real>::mask_of(value); }
};

/// start + Σ a_j b_{k−j} from j = `from` to k − `from`, in two sums: each product waits for the one before it in its sum.
template <int k, int from = 0, class Real> SLIDEWAY_FN Real convolved(Real const* a, Real const* b, Real start) {
    Real sum[4] = {start, Real(0.0), Real(0.0), Real(0.0)};
    SLIDEWAY_UNROLL
    for (int j = from; j <= k - from; ++j) sum[(j - from) % 4] = fma(a[j], b[k - j], sum[(j - from) % 4]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// The k-th coefficient of a·b, and `start`.
template <class Real, int n, int k> SLIDEWAY_FN Real product(Jet<Real, n, k> const& a, Jet<Real, n, k> const& b, Real start) {
    if (a.is_constant()) return fma(a.constant, b.last(), start);
    if (b.is_constant()) return fma(a.c[k], b.constant, start);
    return convolved<k>(a.c, b.c, start);
}

/// What an operation has found, in its row.
template <class Real, int n, int k, class Next> SLIDEWAY_FN Jet<Real, n, k> appended(JetRows<Real, n>* rows, Next const& next) {
    Real* const row = rows->next();
    row[k] = next(row);
    return {row, rows};
}

template <class Real, int n, int k> SLIDEWAY_FN JetRows<Real, n>* rows_of(Jet<Real, n, k> const& a, Jet<Real, n, k> const& b) {
    return a.is_constant() ? b.rows : a.rows;
}

}  // namespace detail

template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> operator+(Jet<Real, n, k> a, Jet<Real, n, k> b) {
    if (a.is_constant() && b.is_constant()) return Jet<Real, n, k>(Real(a.constant + b.constant));
    return detail::appended<Real, n, k>(detail::rows_of(a, b), [&](Real*) { return Real(a.last() + b.last()); });
}
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> operator-(Jet<Real, n, k> a, Jet<Real, n, k> b) {
    if (a.is_constant() && b.is_constant()) return Jet<Real, n, k>(Real(a.constant - b.constant));
    return detail::appended<Real, n, k>(detail::rows_of(a, b), [&](Real*) { return Real(a.last() - b.last()); });
}
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> negated(Jet<Real, n, k> a) {
    if (a.is_constant()) return Jet<Real, n, k>(Real(negated(a.constant)));
    return detail::appended<Real, n, k>(a.rows, [&](Real*) { return Real(negated(a.c[k])); });
}
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> operator*(Jet<Real, n, k> a, Jet<Real, n, k> b) {
    if (a.is_constant() && b.is_constant()) return Jet<Real, n, k>(Real(a.constant * b.constant));
    return detail::appended<Real, n, k>(detail::rows_of(a, b), [&](Real*) { return detail::product(a, b, Real(0.0)); });
}

/// a·b + c, a·b − c and c − a·b.
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> fma(Jet<Real, n, k> a, Jet<Real, n, k> b, Jet<Real, n, k> c) {
    bool const plain = a.is_constant() && b.is_constant();
    if (plain && c.is_constant()) return Jet<Real, n, k>(Real(fma(a.constant, b.constant, c.constant)));
    return detail::appended<Real, n, k>(plain ? c.rows : detail::rows_of(a, b), [&](Real*) { return detail::product(a, b, c.last()); });
}
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> fms(Jet<Real, n, k> a, Jet<Real, n, k> b, Jet<Real, n, k> c) {
    return a * b - c;
}
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> fnma(Jet<Real, n, k> a, Jet<Real, n, k> b, Jet<Real, n, k> c) {
    return c - a * b;
}

/// q = a/b: q_k = (a_k − Σ_{j ≥ 1} b_j q_{k−j})/b_0.
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> operator/(Jet<Real, n, k> a, Jet<Real, n, k> b) {
    if (a.is_constant() && b.is_constant()) return Jet<Real, n, k>(Real(a.constant / b.constant));
    return detail::appended<Real, n, k>(detail::rows_of(a, b), [&](Real const* q) {
        if (b.is_constant()) return Real(a.c[k] / b.constant);
        Real rest = a.last();
        for (int j = 1; j <= k; ++j) rest = fnma(b.c[j], q[k - j], rest);
        return Real(rest / b.c[0]);
    });
}

/// s = √a: s_k = (a_k − Σ s_j s_{k−j})/(2 s_0), j from 1 to k − 1; not finite where a_0 is 0.
template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> sqrt(Jet<Real, n, k> a) {
    if (a.is_constant()) return Jet<Real, n, k>(Real(sqrt(a.constant)));
    return detail::appended<Real, n, k>(a.rows, [&](Real const* s) {
        if constexpr (k == 0) return Real(sqrt(a.c[0]));
        else return Real((a.c[k] - detail::convolved<k, 1>(s, s, Real(0.0))) / (s[0] + s[0]));
    });
}

/// k s_k = Σ j a_j c_{k−j}, k c_k = −Σ j a_j s_{k−j}.
template <class Real, int n, int k> SLIDEWAY_FN SinCos<Jet<Real, n, k>> sincos(Jet<Real, n, k> a) {
    using Number = Jet<Real, n, k>;
    if (a.is_constant()) {
        auto const both = sincos(a.constant);
        return {Number(both.sin), Number(both.cos), Number(both.versine)};
    }
    Real* const s = a.rows->next();
    Real* const c = a.rows->next();
    Real* const versine = a.rows->next();
    if constexpr (k == 0) {
        auto const both = sincos(a.c[0]);
        s[0] = both.sin;
        c[0] = both.cos;
        versine[0] = both.versine;
    } else {
        Real of_sine(0.0), of_cosine(0.0);
        for (int j = 1; j <= k; ++j) {
            Real const slope = Real(static_cast<double>(j) / k) * a.c[j];
            of_sine = fma(slope, c[k - j], of_sine);
            of_cosine = fnma(slope, s[k - j], of_cosine);
        }
        s[k] = of_sine;
        c[k] = of_cosine;
        versine[k] = negated(of_cosine);
    }
    return {Number(s, a.rows), Number(c, a.rows), Number(versine, a.rows)};
}

template <class Real, int n, int k> SLIDEWAY_FN Jet<Real, n, k> select(Mask<Real> m, Jet<Real, n, k> yes, Jet<Real, n, k> no) {
    if (yes.is_constant() && no.is_constant()) return Jet<Real, n, k>(Real(select(m, yes.constant, no.constant)));
    return detail::appended<Real, n, k>(detail::rows_of(yes, no), [&](Real*) { return Real(select(m, yes.last(), no.last())); });
}

template <class Real, int n, int k> SLIDEWAY_FN Mask<Real> operator==(Jet<Real, n, k> a, Jet<Real, n, k> b) { return a.first() == b.first(); }
template <class Real, int n, int k> SLIDEWAY_FN Mask<Real> operator<(Jet<Real, n, k> a, Jet<Real, n, k> b) { return a.first() < b.first(); }
template <class Real, int n, int k> SLIDEWAY_FN Mask<Real> operator>(Jet<Real, n, k> a, Jet<Real, n, k> b) { return a.first() > b.first(); }

}  // namespace slideway::inline SLIDEWAY_ISA
