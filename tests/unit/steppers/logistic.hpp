// Single steps of an explicit method on a nonlinear problem with a known solution.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iterator>

#include "kernels/steppers/pair_numbers.hpp"

namespace slideway::testing {

/// y' = y (1 − y).
template <class Pair> struct Logistic {
    static constexpr double start = 0.2;
    static double exact(double t) { return 1 / (1 + (1 / start - 1) * std::exp(-t)); }
    double y[1] = {start}, end[1], k[PairNumbers::most_stages][1];

    void step(double h) {
        auto const& pair = pair_numbers<Pair>();
        rates(y, k[0]);
        for (int s = 1; s < pair.stages + pair.dense_stages; ++s) {
            double at[1];
            pair.stage_state(s, y, k, h, at);
            if (s == pair.stages - 1) end[0] = at[0];
            rates(at, k[s]);
        }
    }
    void advance() { y[0] = end[0]; }
    double estimate(double h, bool coarse = false) const {
        auto const& pair = pair_numbers<Pair>();
        double sum[1];
        PairNumbers::combine(coarse ? pair.coarse : pair.e, pair.stages, k, sum);
        return std::abs(h * sum[0]);
    }

private:
    static void rates(double const* s, double* d) { d[0] = s[0] * (1 - s[0]); }
};

/// x'' = −x as a system.
template <class Pair> struct Oscillator {
    double y[2] = {1, 0}, end[2], k[PairNumbers::most_stages][2];

    void step(double h) {
        auto const& pair = pair_numbers<Pair>();
        double at[2] = {y[0], y[1]};
        for (int s = 0; s < pair.stages; ++s) {
            if (s > 0) pair.stage_state(s, y, k, h, at);
            k[s][0] = at[1], k[s][1] = -at[0];
        }
        end[0] = at[0], end[1] = at[1];
    }
    void advance() { y[0] = end[0], y[1] = end[1]; }
    double distance(double t) const { return std::hypot(y[0] - std::cos(t), y[1] + std::sin(t)); }

    /// Of the continuous extension at fraction θ of one step of h from the start.
    double inner_distance(double h, double theta) const {
        double at[2];
        pair_numbers<Pair>().dense(k, y, end, h, theta, at);
        return std::hypot(at[0] - std::cos(theta * h), at[1] + std::sin(theta * h));
    }
};

/// Error after four units of time in equal steps.
template <class Pair> double oscillator_error(double h) {
    Oscillator<Pair> o;
    for (int i = 0; i < static_cast<int>(std::lround(4 / h)); ++i) o.step(h), o.advance();
    return o.distance(4);
}

/// Error of the continuous extension at fraction θ of one step.
template <class Pair> double inner_oscillator_error(double h, double theta) {
    Oscillator<Pair> o;
    o.step(h);
    return o.inner_distance(h, theta);
}

/// By which power of the step an error falls.
double observed_order(auto const& error, double h) { return std::log2(error(h) / error(h / 2)); }

/// Error after four units of time in equal steps.
template <class Pair> double logistic_error(double h) {
    Logistic<Pair> o;
    for (int i = 0; i < static_cast<int>(std::lround(4 / h)); ++i) o.step(h), o.advance();
    return std::abs(o.y[0] - o.exact(4));
}

/// Error of the continuous extension at fraction θ of one step.
template <class Pair> double dense_error(double h, double theta) {
    Logistic<Pair> o;
    o.step(h);
    double at[1];
    pair_numbers<Pair>().dense(o.k, o.y, o.end, h, theta, at);
    return std::abs(at[0] - o.exact(theta * h));
}

/// @param step that was made with stages `k` from `y` to `end`  @param rounding of the end
template <class Pair> void expect_dense_meets_ends(auto const& step, double h, double rounding) {
    constexpr std::size_t size = std::size(decltype(step.y){});
    double at[2][size];
    pair_numbers<Pair>().dense(step.k, step.y, step.end, h, 0.0, at[0]);
    pair_numbers<Pair>().dense(step.k, step.y, step.end, h, 1.0, at[1]);
    for (std::size_t i = 0; i < size; ++i) {
        EXPECT_EQ(at[0][i], step.y[i]) << "component " << i;
        EXPECT_NEAR(at[1][i], step.end[i], rounding) << "component " << i;
    }
}

}  // namespace slideway::testing
