// Taylor coefficients of operations against series known in closed form.
#include "tests/models/jet.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace slideway::jet_test {
namespace {

constexpr int length = 12;
using Series = std::array<double, length>;

/// Coefficients of f(x) for a series x, found one after the other.
template <int k = 0, class Function> void find(Function const& f, Series& x, JetRows<double, length>& rows, Series& found) {
    rows.used = 0;
    found[k] = f(Jet<double, length, k>(x.data(), &rows)).last();
    if constexpr (k + 1 < length) find<k + 1>(f, x, rows, found);
}
Series series_of(Series x, auto const& f) {
    JetRows<double, length> rows;
    Series found;
    find(f, x, rows, found);
    return found;
}

Series of(auto const& coefficient) {
    Series s;
    for (int k = 0; k < length; ++k) s[k] = coefficient(k);
    return s;
}

void expect_same(Series const& found, Series const& exact) {
    for (int k = 0; k < length; ++k) EXPECT_NEAR(found[k], exact[k], 1e-13 * (1 + std::abs(exact[k]))) << "coefficient " << k;
}

double factorial(int k) { return std::tgamma(k + 1.0); }
Series const time_ = of([](int k) { return k == 1 ? 1.0 : 0.0; });
Series const exponential = of([](int k) { return 1 / factorial(k); });

/// x as a constant of x's own type.
template <class Number> Number number(double value, Number const&) { return Number(value); }

TEST(Jet, ProductOfExponentialsIsTheExponentialOfTheSum) {
    expect_same(series_of(exponential, [](auto x) { return x * x; }), of([](int k) { return std::pow(2, k) / factorial(k); }));
    expect_same(series_of(exponential, [](auto x) { return x * x * x; }), of([](int k) { return std::pow(3, k) / factorial(k); }));
}

TEST(Jet, SumsAndFusedOnesAreThoseOfTheirTerms) {
    // 2 eᵗ + 3 t − 1, (1 − t)², 1 − t²
    expect_same(series_of(exponential, [](auto x) { return fma(number(2, x), x, number(-1, x)); }),
                of([](int k) { return 2 / factorial(k) - (k == 0); }));
    expect_same(series_of(time_, [](auto t) { return fms(t, t, t + t - number(1, t)); }),
                of([](int k) { return k == 0 ? 1.0 : k == 1 ? -2.0 : k == 2 ? 1.0 : 0.0; }));
    expect_same(series_of(time_, [](auto t) { return fnma(t, t, number(1, t)); }),
                of([](int k) { return k == 0 ? 1.0 : k == 2 ? -1.0 : 0.0; }));
    expect_same(series_of(time_, [](auto t) { return negated(t) - t; }), of([](int k) { return k == 1 ? -2.0 : 0.0; }));
    expect_same(series_of(time_, [](auto t) { return fma(number(2, t), number(3, t), t); }),
                of([](int k) { return k == 0 ? 6.0 : k == 1 ? 1.0 : 0.0; }));
}

TEST(Jet, QuotientsAreGeometricSeries) {
    expect_same(series_of(time_, [](auto t) { return number(1, t) / (number(1, t) - t); }), of([](int) { return 1; }));
    // eᵗ/e^2t = e^−t, and by a constant
    expect_same(series_of(exponential, [](auto x) { return x / (x * x); }),
                of([](int k) { return (k % 2 == 0 ? 1 : -1) / factorial(k); }));
    expect_same(series_of(exponential, [](auto x) { return x / number(4, x); }), of([](int k) { return 0.25 / factorial(k); }));
}

TEST(Jet, RootsHaveBinomialCoefficients) {
    // √(4 + t)
    double binomial = 2;
    Series exact;
    for (int k = 0; k < length; ++k) {
        exact[k] = binomial;
        binomial *= (0.5 - k) / (k + 1) / 4;
    }
    expect_same(series_of(time_, [](auto t) { return sqrt(number(4, t) + t); }), exact);
}

TEST(Jet, SineAndCosineOfSeries) {
    // sin(2t + 1/3), cos(2t + 1/3); of a series that bends sin² + cos² is 1.
    auto const inner = [](auto t) { return fma(number(2, t), t, number(1.0 / 3, t)); };
    auto const exact = [](double at) {
        return of([at](int k) { return std::pow(2, k) * std::sin(at + k * std::acos(0.0)) / factorial(k); });
    };
    expect_same(series_of(time_, [&](auto t) { return sincos(inner(t)).sin; }), exact(1.0 / 3));
    expect_same(series_of(time_, [&](auto t) { return sincos(inner(t)).cos; }), exact(1.0 / 3 + std::acos(0.0)));
    expect_same(series_of(time_, [&](auto t) { return sincos(inner(t)).versine + sincos(inner(t)).cos; }),
                of([](int k) { return k == 0 ? 1.0 : 0.0; }));
    expect_same(series_of(exponential,
                          [](auto x) {
                              auto const both = sincos(x);
                              return fma(both.sin, both.sin, both.cos * both.cos);
                          }),
                of([](int k) { return k == 0 ? 1.0 : 0.0; }));
}

TEST(Jet, DecisionsAreThoseAtTheStart) {
    // t and −t are both 0 there; 1 + t is above, whatever comes later.
    auto const larger = [](auto t) {
        auto const one = number(1, t), two = number(2, t);
        return select(one + t > one, t, select(two - t > one, negated(t), t));
    };
    expect_same(series_of(time_, larger), of([](int k) { return k == 1 ? -1.0 : 0.0; }));
    expect_same(series_of(time_, [](auto t) { return select(t == number(0, t), number(5, t), t); }),
                of([](int k) { return k == 0 ? 5.0 : 0.0; }));
}

TEST(Jet, ConstantsStayConstant) {
    JetRows<double, length> rows;
    rows.used = 0;
    using Number = Jet<double, length, 3>;
    Number const a(2.0), b(0.5);
    for (auto const& c : {a + b, a - b, a * b, a / b, fma(a, b, b), sqrt(a), negated(a), sincos(a).sin, select(true, a, b)}) {
        EXPECT_TRUE(c.is_constant());
        EXPECT_EQ(c.last(), 0) << "its third coefficient";
    }
    EXPECT_EQ(rows.used, 0);
}

}  // namespace
}  // namespace slideway::jet_test
