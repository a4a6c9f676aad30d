// Single steps of an explicit method on a nonlinear problem with a known solution.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace slideway::testing {

/// y' = y (1 − y).
template <class Pair> struct Logistic {
    static constexpr double start = 0.2;
    static constexpr int stages = Pair::stages + Pair::dense_stages;
    static double exact(double t) { return 1 / (1 + (1 / start - 1) * std::exp(-t)); }
    double y[1] = {start}, end[1], k[stages][1];

    void step(double h) {
        rates(y, k[0]);
        evaluate(h, std::make_integer_sequence<int, stages - 1>{});
    }
    void advance() { y[0] = end[0]; }

private:
    static void rates(double const* s, double* d) { d[0] = s[0] * (1 - s[0]); }
    template <int... s> void evaluate(double h, std::integer_sequence<int, s...>) { (stage<s + 1>(h), ...); }
    template <int s> void stage(double h) {
        double at[1];
        Pair::template stage_state<s>(y, k, h, at);
        if (s == Pair::stages - 1) end[0] = at[0];
        rates(at, k[s]);
    }
};

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
    return std::abs(Pair::dense(o.k, 0, o.y[0], o.end[0], h, theta) - o.exact(theta * h));
}

/// @param step that was made with stages `k` of components `y`, which are at `end` after it  @param rounding of the end
template <class Pair> void expect_dense_meets_ends(auto const& step, double h, double rounding) {
    for (std::size_t i = 0; i < std::size(step.y); ++i) {
        auto const at = [&](double theta) {
            return Pair::dense(step.k, static_cast<int>(i), step.y[i], step.end[i], h, theta);
        };
        EXPECT_EQ(at(0.0), step.y[i]) << "component " << i;
        EXPECT_NEAR(at(1.0), step.end[i], rounding) << "component " << i;
    }
}

}  // namespace slideway::testing
