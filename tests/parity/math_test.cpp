// The elementary functions: every instruction set gives the bits of the scalar build, whatever the neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iostream>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/models/by_isa.hpp"
#include "tests/parity/math_functions.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(MathEvaluator, evaluate_math)

namespace {

constexpr std::size_t argument_count = 1 << 17;

struct Arguments {
    std::vector<double> x, y;
};

/// Small and large magnitudes side by side, so that packs mix the ways of a function.
Arguments arguments_of(MathFunction function) {
    std::mt19937_64 random(1234);
    auto const between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Arguments a;
    for (std::size_t i = 0; i < argument_count; ++i) {
        double x = 0;
        switch (function) {
            case MathFunction::sin:
            case MathFunction::cos:
            case MathFunction::versine: {
                double const magnitude[] = {1e-9, 0.78, 1.6, 7.0, 1e3, 1e6};
                double const bound = magnitude[random() % 6];
                x = between(-bound, bound);
                break;
            }
            case MathFunction::sin_quarter: x = between(-1.5707963267948966, 1.5707963267948966); break;
            case MathFunction::log_positive:
            case MathFunction::power: {
                int const exponent = static_cast<int>(random() % 600) - 300;
                x = random() % 3 == 0 ? between(0.5, 2) : std::ldexp(between(1, 2), exponent);
                break;
            }
            case MathFunction::exp: x = random() % 2 ? between(-1, 1) : between(-720, 720); break;
            case MathFunction::lambert_numerator:
            case MathFunction::lambert_denominator: x = random() % 2 ? between(0, 7) : between(7, 74); break;
        }
        a.x.push_back(x);
        a.y.push_back(between(-3, 3));
    }
    // Odd ones, each in packs of ordinary numbers and in different lanes.
    bool const domain_is_positive = function == MathFunction::log_positive || function == MathFunction::power;
    double const infinity = std::numeric_limits<double>::infinity();
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const odd[] = {nan, 0.0, -0.0, infinity, -infinity, 7.0, 0.7853981633974483, -0.7853981633974483,
                          0.7853981633974484, 1.5707963267948966, 1.0, 1e12, 1e300, 1e-300, 2.3e-308, 5e-324};
    std::size_t place = 3;
    for (double const x : odd) {
        if (domain_is_positive && !(x > 0)) continue;
        for (int copy = 0; copy < 9; ++copy, place += 11) a.x[place] = x;
    }
    return a;
}

std::vector<double> evaluate(Isa isa, MathFunction function, Arguments const& a) {
    std::vector<double> result(a.x.size());
    evaluate_math_by_isa(isa)(function, a.x.data(), a.y.data(), result.data(), a.x.size());
    return result;
}

/// NaNs may differ in sign and payload, which say nothing.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

std::size_t differences(Arguments const& a, std::vector<double> const& want, std::vector<double> const& got) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < want.size(); ++i) {
        if (same(want[i], got[i])) continue;
        if (count++ == 0) {
            ADD_FAILURE() << std::hexfloat << "x = " << a.x[i] << ", y = " << a.y[i] << ": " << want[i] << " and "
                          << got[i];
        }
    }
    return count;
}

class MathParity : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
};

TEST_P(MathParity, GivesTheBitsOfScalar) {
    for (int f = 0; f < math_function_count; ++f) {
        auto const function = static_cast<MathFunction>(f);
        auto const a = arguments_of(function);
        auto const want = evaluate(Isa::scalar, function, a);
        EXPECT_EQ(differences(a, want, evaluate(GetParam(), function, a)), 0u) << "function " << f;
    }
}

TEST_P(MathParity, NeighboursChangeNoBit) {
    for (int f = 0; f < math_function_count; ++f) {
        auto const function = static_cast<MathFunction>(f);
        auto const mixed = arguments_of(function);
        auto const of_mixed = evaluate(GetParam(), function, mixed);
        // Sorted by magnitude, nearly every pack goes one way of a function as a whole.
        std::vector<std::size_t> order(mixed.x.size());
        std::iota(order.begin(), order.end(), 0u);
        auto const key = [&](std::size_t i) {
            return std::isnan(mixed.x[i]) ? std::numeric_limits<double>::infinity() : std::abs(mixed.x[i]);
        };
        std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
        Arguments sorted;
        std::vector<double> want;
        for (std::size_t const i : order) {
            sorted.x.push_back(mixed.x[i]);
            sorted.y.push_back(mixed.y[i]);
            want.push_back(of_mixed[i]);
        }
        EXPECT_EQ(differences(sorted, want, evaluate(GetParam(), function, sorted)), 0u) << "function " << f;
    }
}

/// FNV-1a of the results, in which all NaN are one.
std::uint64_t digest(std::vector<double> const& results) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (double const result : results) {
        double const nan = std::numeric_limits<double>::quiet_NaN();
        auto const bits = std::bit_cast<std::uint64_t>(std::isnan(result) ? nan : result);
        for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> 8 * byte & 0xff)) * 0x100000001b3u;
    }
    return hash;
}

// What scripts/neon_check.sh compares between processors.
TEST_P(MathParity, TellsItsBits) {
    char const* const names[] = {"sin", "cos",   "versine",           "sin_quarter",        "log",
                                 "exp", "power", "lambert_numerator", "lambert_denominator"};
    static_assert(std::size(names) == math_function_count);
    for (int f = 0; f < math_function_count; ++f) {
        auto const function = static_cast<MathFunction>(f);
        auto const own = digest(evaluate(GetParam(), function, arguments_of(function)));
        std::cout << "bits of " << name_of(GetParam()) << ' ' << names[f] << ' ' << std::hex << own << std::dec << '\n';
        EXPECT_EQ(own, digest(evaluate(Isa::scalar, function, arguments_of(function)))) << names[f];
    }
}

std::string isa_name(::testing::TestParamInfo<Isa> const& info) { return std::string(name_of(info.param)); }

INSTANTIATE_TEST_SUITE_P(Isas, MathParity, ::testing::ValuesIn(built_isas()), isa_name);

}  // namespace
}  // namespace slideway
