#pragma once

#include <iterator>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The numbers of an explicit Runge–Kutta method, which gives the same bits.  Lanes are compiled once for all: sums are little beside derivatives.
struct PairNumbers {
    static constexpr int most_stages = 16;

    int order;
    bool adaptive;  // has an estimate of its error
    int stages, dense_stages;  // the last stage is the first of the next step; those that the continuous extension needs beyond
    bool has_two_estimates;
    int bends;  // rows of d; 0: the cubic through both ends is all that is known inside of a step
    double c[most_stages], a[most_stages][most_stages - 1];
    double reach[most_stages];  // factor of the step, of the sum that a row of `a` weights
    double b[most_stages], e[most_stages], coarse[most_stages], d[4][most_stages];

    /// Of a method's tableau: nodes c, stage weights a, weights b and the error's e; of two estimates of the error the second's are `coarse`; d is what
    /// the continuous extension adds to the cubic through both ends, in four rows where that has stages of its own, beyond those of b.
    template <class Tableau> static constexpr PairNumbers of(int order) {
        constexpr Tableau w{};
        constexpr int stages = std::size(Tableau{}.b), rows = std::size(Tableau{}.c);
        static_assert(rows <= most_stages);
        auto const copy = [](double* to, double const* from, int count) {
            for (int i = 0; i < count; ++i) to[i] = from[i];
        };
        PairNumbers p{};
        p.order = order, p.adaptive = w.e[0] != 0;
        p.stages = stages, p.dense_stages = rows - stages;
        p.has_two_estimates = requires { w.coarse; };
        copy(p.c, w.c, rows);
        for (int s = 0; s < rows; ++s) copy(p.a[s], w.a[s], s), p.reach[s] = 1;
        if constexpr (requires { Tableau::whole; }) {
            p.reach[stages - 1] = 1.0 / Tableau::whole;
            for (double& weight : p.a[stages - 1]) weight = weight * Tableau::whole;
        }
        copy(p.b, w.b, stages);
        copy(p.e, w.e, stages);
        if constexpr (requires { w.coarse; }) copy(p.coarse, w.coarse, stages);
        if constexpr (requires { w.d[0][0]; }) {
            for (p.bends = 0; p.bends < 4; ++p.bends) copy(p.d[p.bends], w.d[p.bends], rows);
        } else if constexpr (requires { w.d[0]; }) {
            copy(p.d[0], w.d, rows), p.bends = 1;
        }
        return p;
    }

    /// State at which stage `s` evaluates the derivative: y + h Σ_j a_sj k_j.
    /// @param n components there are, of room for as many as `room`
    template <int room, class Real> SLIDEWAY_FN void stage_state(int s, Real const* y, Real const (*k)[room], Real h, Real* at, int n = room) const {
        Real sum[room];
        combine(a[s], s, k, sum, n);
        Real const far = h * Real(reach[s]);
        for (int i = 0; i < n; ++i) at[i] = fma(far, sum[i], y[i]);
    }

    /// Σ_j w_j k_j of the first stages, the newest slope last, for the sum waits for it alone.
    template <int room, class Real> SLIDEWAY_FN static void combine(double const* weights, int count, Real const (*k)[room], Real* sum, int n = room) {
        if (n > room) __builtin_unreachable();  // or g++ warns of the loops below
        Real held[room];
        int j = 0;
        while (j + 1 < count && weights[j] == 0) ++j;
        for (int i = 0; i < n; ++i) held[i] = Real(weights[j]) * k[j][i];
        for (++j; j < count; ++j) {
            if (weights[j] == 0) continue;
            for (int i = 0; i < n; ++i) held[i] = fma(Real(weights[j]), k[j][i], held[i]);
        }
        for (int i = 0; i < n; ++i) sum[i] = held[i];
    }

    /// The state inside the step, at fraction θ of it.
    /// @param k slopes, the continuous extension's included  @param y0, y1 the state at both ends
    template <int room, class Real>
    SLIDEWAY_FN void dense(Real const (*k)[room], Real const* y0, Real const* y1, Real h, Real theta, Real* state, int n = room) const {
        int const rows = stages + dense_stages;
        Real const rest = Real(1.0) - theta;
        Real bend[room], sum[room];
        if (bends > 0) combine(d[bends - 1], rows, k, bend, n);
        for (int i = 0; i < n; ++i) bend[i] = bends > 0 ? h * bend[i] : Real(0.0);
        for (int row = bends - 2; row >= 0; --row) {
            combine(d[row], rows, k, sum, n);
            for (int i = 0; i < n; ++i) bend[i] = fma(row % 2 == 0 ? theta : rest, bend[i], h * sum[i]);
        }
        for (int i = 0; i < n; ++i) {
            Real const change = y1[i] - y0[i], first = k[0][i], last = k[stages - 1][i];
            // The cubic alone rounds the slopes too.
            Real const start = bends > 0 ? fms(h, first, change) : h * first - change;
            Real const end = (bends > 0 ? fnma(h, last, change) : change - h * last) - start;
            state[i] = fma(theta, fma(rest, fma(theta, fma(rest, bend[i], end), start), change), y0[i]);
        }
    }
};

/// Those of a method, a tableau or what has one, in memory.
template <class Method> SLIDEWAY_HD PairNumbers const& pair_numbers() {
    static constexpr PairNumbers numbers = [] {
        if constexpr (requires { typename Method::Tableau; }) return PairNumbers::of<typename Method::Tableau>(Method::order);
        else return PairNumbers::of<Method>(Method::order);
    }();
    return numbers;
}

}  // namespace slideway::inline SLIDEWAY_ISA
