// The elementary functions against long double.  Bounds are what was measured over millions of
// arguments, with a few per cent of slack, in units in the last place (ulp).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kernels/math/exponential.hpp"
#include "kernels/math/lambert_w.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/math/polynomial.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "tests/oracle/laws.hpp"

namespace slideway::math_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.141592653589793;

double ulps(double got, long double want) {
    if (want == 0) return got == 0 ? 0 : infinity;
    int exponent;
    std::frexp(want, &exponent);
    return static_cast<double>(std::abs(got - want) / std::ldexp(1.0L, exponent - 53));
}

/// The largest error met, and where.
class Worst {
public:
    void add(double got, long double want, double argument) {
        double const error = ulps(got, want);
        if (std::isnan(error_) || error <= error_) return;
        error_ = error;
        argument_ = argument;
    }
    void expect_below(double bound, char const* what) const {
        EXPECT_LT(error_, bound) << what << " at " << std::hexfloat << argument_;
    }

private:
    double error_ = 0, argument_ = 0;
};

class Arguments {
public:
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }

private:
    std::mt19937_64 random_{20240607};
};

/// 1 + 2 + 4 + …, which is exact, for every number of terms up to that of `ones`.
template <class... Ones> void expect_geometric_sums(Ones... ones) {
    EXPECT_EQ(polynomial(2.0, 1.0, ones...), std::ldexp(2.0, sizeof...(ones)) - 1);
    if constexpr (sizeof...(ones) < 31) expect_geometric_sums(ones..., 1.0);
}

TEST(Polynomial, SumsEveryCountOfTerms) { expect_geometric_sums(); }

TEST(Polynomial, TakesCoefficientsLowestFirst) {
    EXPECT_EQ(polynomial(10.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0), 7654321);
}

TEST(SinCos, IsAccurateWithinAQuarterTurn) {
    Arguments arguments;
    Worst sine, cosine, versine;
    for (int i = 0; i < 200'000; ++i) {
        double const small = arguments.sign() * arguments.logarithmic(1e-150, pi / 4);
        double const x = i % 2 ? arguments.uniform(-pi / 4, pi / 4) : small;
        auto const got = sincos(x);
        long double const half = std::sin(0.5L * x);
        sine.add(got.sin, std::sin(static_cast<long double>(x)), x);
        cosine.add(got.cos, std::cos(static_cast<long double>(x)), x);
        versine.add(got.versine, 2 * half * half, x);
    }
    sine.expect_below(0.83, "sin");
    cosine.expect_below(1.03, "cos");
    versine.expect_below(1.6, "1 - cos");
}

TEST(SinCos, IsAccurateForWideAngles) {
    Arguments arguments;
    Worst sine, cosine;
    for (int i = 0; i < 200'000; ++i) {
        double const x = i % 2 ? arguments.uniform(-20, 20) : arguments.sign() * arguments.logarithmic(1, 1e9);
        auto const got = sincos(x);
        sine.add(got.sin, std::sin(static_cast<long double>(x)), x);
        cosine.add(got.cos, std::cos(static_cast<long double>(x)), x);
    }
    sine.expect_below(1.3, "sin");
    cosine.expect_below(1.3, "cos");
}

TEST(SinCos, KeepsItsDigitsNearMultiplesOfAQuarterTurn) {
    // The double nearest to k π/2 leaves a remainder as small as 1e-16 of it; sine or cosine is that remainder.
    Worst small, versine;
    for (int k = 1; k < 600'000; k += k < 2000 ? 1 : 97) {
        double const x = k * (pi / 2);
        auto const got = sincos(x);
        if (k % 2) {
            small.add(got.cos, std::cos(static_cast<long double>(x)), x);
        } else {
            small.add(got.sin, std::sin(static_cast<long double>(x)), x);
        }
        double const aside = x + 0.3;
        if (k % 4 == 0) {
            long double const half = std::sin(0.5L * aside);
            versine.add(sincos(aside).versine, 2 * half * half, aside);
        }
    }
    small.expect_below(1.3, "sin or cos");
    versine.expect_below(2.1, "1 - cos");
}

TEST(SinCos, GivesNaNOutsideItsDomain) {
    for (double const x : {nan, infinity, -infinity, 1073741824.0, -1e12, 1e300}) {
        auto const got = sincos(x);
        EXPECT_TRUE(std::isnan(got.sin) && std::isnan(got.cos) && std::isnan(got.versine)) << x;
    }
}

TEST(SinCos, IsExactAtZero) {
    auto const got = sincos(0.0);
    EXPECT_EQ(got.sin, 0);
    EXPECT_EQ(got.cos, 1);
    EXPECT_EQ(got.versine, 0);
}

TEST(SinQuarter, IsAccurateAndOneAtItsEnd) {
    Worst worst;
    for (int i = 0; i <= 200'000; ++i) {
        double const x = pi / 2 * i / 200'000;
        worst.add(sin_quarter(x), std::sin(static_cast<long double>(x)), x);
        ASSERT_EQ(sin_quarter(-x), -sin_quarter(x));
    }
    worst.expect_below(1.75, "sin");
    EXPECT_EQ(sin_quarter(pi / 2), 1);
}

TEST(LogPositive, IsAccurateOverAllNormalNumbers) {
    Arguments arguments;
    Worst worst;
    auto const add = [&](double x) { worst.add(log_positive(x), std::log(static_cast<long double>(x)), x); };
    for (int i = 0; i < 200'000; ++i) {
        add(arguments.uniform(0.5, 2));
        add(1 + arguments.sign() * arguments.logarithmic(1e-16, 0.4));
        add(arguments.logarithmic(1e-300, 1e300));
    }
    using Limits = std::numeric_limits<double>;
    for (double const x : {Limits::min(), Limits::max(), std::sqrt(0.5), std::sqrt(2.0), std::nextafter(1.0, 0.0),
                           std::nextafter(1.0, 2.0), std::nextafter(std::sqrt(2.0), 2.0)}) {
        add(x);
    }
    worst.expect_below(1.0, "log");
    EXPECT_EQ(log_positive(1.0), 0);
}

TEST(Exp, IsAccurate) {
    Arguments arguments;
    Worst worst;
    for (int i = 0; i < 200'000; ++i) {
        for (double const x : {arguments.uniform(-1, 1), arguments.uniform(-708, 708), arguments.uniform(-30, 30)}) {
            worst.add(exp(x), std::exp(static_cast<long double>(x)), x);
        }
    }
    worst.expect_below(0.95, "exp");
    EXPECT_EQ(exp(0.0), 1);
}

TEST(Exp, HoldsAtTheEndsOfItsDomain) {
    EXPECT_EQ(exp(1e6), exp(708.0));
    EXPECT_EQ(exp(infinity), exp(708.0));
    EXPECT_EQ(exp(-infinity), exp(-708.0));
    EXPECT_LT(ulps(exp(708.0), std::exp(708.0L)), 0.95);
    EXPECT_LT(ulps(exp(-708.0), std::exp(-708.0L)), 0.95);
    EXPECT_TRUE(std::isnan(exp(nan)));
}

TEST(Power, IsAccurateForHertzLoads) {
    Arguments arguments;
    Worst worst;
    for (int i = 0; i < 200'000; ++i) {
        double const depth = arguments.logarithmic(1e-15, 1e-2);
        double const n = arguments.uniform(1, 3);
        worst.add(power(depth, n), std::pow(static_cast<long double>(depth), static_cast<long double>(n)), depth);
    }
    worst.expect_below(1.0, "power");
}

TEST(Power, KeepsItsDigitsWhereTheLogarithmIsLarge) {
    Arguments arguments;
    Worst moderate, steep;
    auto const want = [](long double x, long double y) { return std::pow(x, y); };
    for (int i = 0; i < 100'000; ++i) {
        double const x = arguments.logarithmic(1e-80, 1e80);
        double const y = arguments.uniform(-3.8, 3.8);
        moderate.add(power(x, y), want(x, y), x);
        double const base = 1 + arguments.sign() * arguments.logarithmic(1e-6, 0.4);
        double const exponent = 100 / std::log(base);
        steep.add(power(base, exponent), want(base, exponent), base);
    }
    moderate.expect_below(1.1, "|y| < 4");
    steep.expect_below(17, "|y ln x| = 100");
}

TEST(Power, KnowsWholeExponents) {
    Arguments arguments;
    for (int i = 0; i < 1000; ++i) {
        double const x = arguments.logarithmic(1e-15, 1e2);
        EXPECT_EQ(power(x, 0.0), 1);
        EXPECT_LT(ulps(power(x, 1.0), x), 1.0);
        EXPECT_LT(ulps(power(x, 2.0), static_cast<long double>(x) * x), 1.0);
        EXPECT_LT(ulps(power(x, -1.0), 1.0L / x), 1.0);
    }
    EXPECT_TRUE(std::isnan(power(nan, 1.5)));
    EXPECT_TRUE(std::isnan(power(2.0, nan)));
}

/// The root w ≥ 1 of w − ln w = 1 + t by Newton's method: its own equation, not its inverse function.  In u = w − 1, whose digits
/// w would lose near 1; good to 0.002 ulp.
long double lambert_root(long double t) {
    if (t == 0) return 1;
    long double u = t < 1 ? std::sqrt(2 * t) + 2 * t / 3 : t + std::log1p(t + std::log1p(t));
    for (int i = 0; i < 6; ++i) u -= (u - std::log1p(u) - t) * (1 + u) / u;
    return 1 + u;
}

TEST(LambertW, IsAccurateOverItsDomain) {
    Arguments arguments;
    Worst worst;
    auto const add = [&](double t) {
        worst.add(minus_lambert_wm1_exp(t).value(), lambert_root(t), t);
    };
    for (int i = 0; i < 4000; ++i) {
        add(arguments.uniform(0, 7));
        add(arguments.uniform(7, 74));
        add(arguments.logarithmic(1e-18, 1));
    }
    for (double const t : {0.0, std::nextafter(7.0, 0.0), 7.0, 74.0}) add(t);
    worst.expect_below(3.5, "w");
    EXPECT_EQ(minus_lambert_wm1_exp(0.0).value(), 1);
    EXPECT_EQ(minus_lambert_wm1_exp(5e-324).value(), 1);
    EXPECT_TRUE(std::isnan(minus_lambert_wm1_exp(nan).value()));
}

TEST(LambertW, AgreesWithBoost) {
    for (double t = 0.5; t < 74; t += 0.37) {
        double const w = static_cast<double>(-oracle::detail::lower_lambert_w(-std::exp(-1 - t)));
        EXPECT_NEAR(minus_lambert_wm1_exp(t).value() / w, 1, 4e-14) << t;
    }
}

TEST(LambertW, GivesTheLineLoadToTheLastDigits) {
    // δ = x (1 − ln x) with δ in units of l²/R and x the load in units of π E* l · l²/R: x = δ/w.
    Arguments arguments;
    Worst worst;
    for (int i = 0; i < 10'000; ++i) {
        double const depth = arguments.logarithmic(1e-13, 0.9);
        auto const w = minus_lambert_wm1_exp(-log_positive(depth));
        worst.add(depth * w.denominator / w.numerator,
                  depth / lambert_root(-std::log(static_cast<long double>(depth))), depth);
    }
    worst.expect_below(4.5, "load");  // 1e-15
}

TEST(Vec3, KnowsItsProducts) {
    Vec3<double> const a{1, 2, 3}, b{-4, 5, 6};
    EXPECT_EQ(dot(a, b), 24);
    auto const c = cross(a, b);
    EXPECT_EQ(c.x, -3);
    EXPECT_EQ(c.y, -18);
    EXPECT_EQ(c.z, 13);
    auto const d = 2.0 * (a + b) - a;
    EXPECT_EQ(d.x, -7);
    EXPECT_EQ(d.y, 12);
    EXPECT_EQ(d.z, 15);
}

}  // namespace
}  // namespace slideway::math_test
