// Derivatives along a direction against those known in closed form.
#include "kernels/math/tangent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/rigid/pair_choice.hpp"

namespace slideway::tangent_test {
namespace {

using Number = Tangent<double>;

/// Slope of f at x, and that its value is the one that plain numbers give.
double slope(double x, auto const& f) {
    Number const found = f(Number(x, 1.0));
    EXPECT_EQ(found.value, f(x));
    return found.slope;
}

TEST(Tangent, OperationsHaveTheirDerivatives) {
    double const x = 0.7;
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return u * u * u; }), 3 * x * x);
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return u + u - u * u; }), 2 - 2 * x);
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return decltype(u)(2.0) / u; }), -2 / (x * x));
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return u / (u + decltype(u)(1.0)); }), 1 / ((x + 1) * (x + 1)));
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return fma(u, u, negated(u)); }), 2 * x - 1);
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return fms(u, u, u); }), 2 * x - 1);
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return fnma(u, u, u); }), 1 - 2 * x);
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return sqrt(u); }), 0.5 / std::sqrt(x));
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return sincos(u * u).sin; }), 2 * x * std::cos(x * x));
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return sincos(u).cos; }), -std::sin(x));
    EXPECT_DOUBLE_EQ(slope(x, [](auto u) { return sincos(u).versine; }), std::sin(x));
}

TEST(Tangent, OfAFunctionInPiecesIsThatOfThePieceTaken) {
    auto const parts = [](auto u) { return max(min(u * u, u), decltype(u)(-1.0)); };
    EXPECT_EQ(slope(0.5, parts), 1);
    EXPECT_EQ(slope(2.0, parts), 1);
    EXPECT_EQ(slope(-2.0, parts), 0);
    EXPECT_EQ(slope(-2.0, [](auto u) { return abs(u); }), -1);
    EXPECT_EQ(slope(2.0, [](auto u) { return abs(u); }), 1);
    EXPECT_EQ(slope(3.0, [](auto u) { return select(u > decltype(u)(2.0), u + u, u); }), 2);
}

TEST(Tangent, WhatIsNotTakenDoesNotReachWhatIs) {
    double const none = std::numeric_limits<double>::quiet_NaN();
    Number const taken = select(true, Number(1.0, 2.0), Number(none, none));
    EXPECT_EQ(taken.slope, 2);
    EXPECT_EQ(max(Number(1.0, 2.0), Number(0.0, none)).slope, 2);
}

/// The impulses of a contact that is hit at the front while the rear one is near.
template <class Real> Real after_impact(Real angle) {
    ContactPair<Real> pair;
    auto const [s, c, versine] = sincos(angle);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            pair.nn[i][j] = i == j ? Real(2.0) + c : Real(0.3) * s;
            pair.tt[i][j] = i == j ? Real(3.0) : c;
            pair.nt[i][j] = Real(0.2) * s;
        }
    }
    PairQuestion<Real> question;
    question.before = {{negated(angle), Real(-0.5)}, {Real(1.0), angle}};
    question.kinetic = question.holding = Real(0.3);
    for (int i = 0; i < 2; ++i) {
        question.target[i] = Real(0.6) * negated(question.before.normal[i]);
        question.present[i] = true, question.slips[i] = false, question.way[i] = Real(0.0);
    }
    auto const answer = PairChoice<Real>(pair, question).answer(true);
    return pair.after(question.before, answer.force).along[1];
}

TEST(Tangent, OfAnImpactIsItsDifferenceQuotient) {
    for (double const angle : {0.2, 0.7, 1.3}) {
        double const step = 1e-5;
        double const quotient = (after_impact(angle + step) - after_impact(angle - step)) / (2 * step);
        EXPECT_NEAR(slope(angle, [](auto u) { return after_impact(u); }), quotient, 1e-9) << angle;
    }
}

}  // namespace
}  // namespace slideway::tangent_test
