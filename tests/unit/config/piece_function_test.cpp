// Functions through the points of a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/config/piece_function.hpp"
#include "kernels/loads/table_value.hpp"

namespace slideway::piece_function_test {
namespace {

using std::numbers::pi;

/// Of a function, at unevenly spread places.
struct Sampled {
    std::vector<double> places, values;

    template <class F> Sampled(F const& f, double low, double high, int parts) {
        for (int i = 0; i <= parts; ++i) {
            double const share = static_cast<double>(i) / parts, x = low + (high - low) * (share + 0.3 * share * (1 - share));
            places.push_back(x), values.push_back(f(x));
        }
    }
    PieceFunction function(Interpolation interpolation, bool repeats) const { return {places, values, interpolation, repeats}; }
};

template <class F> double worst(F const& f, PieceFunction const& function, double low, double high) {
    double most = 0;
    for (int i = 0; i <= 10'000; ++i) {
        double const x = low + (high - low) * i / 10'000;
        most = std::max(most, std::abs(table_point(function.table(), x).value - f(x)));
    }
    return most;
}

TEST(PieceFunction, GoesThroughItsPoints) {
    Sampled const s([](double x) { return std::exp(x); }, -1, 2, 13);
    for (auto const interpolation : {Interpolation::spline, Interpolation::monotone, Interpolation::linear}) {
        auto const function = s.function(interpolation, false);
        for (std::size_t i = 0; i < s.places.size(); ++i) EXPECT_NEAR(table_point(function.table(), s.places[i]).value, s.values[i], 1e-14);
    }
}

TEST(PieceFunction, OfAPeriodConvergesWithItsOrder) {
    auto const f = [](double x) { return std::sin(x) + 0.3 * std::cos(3 * x); };
    auto const off = [&](Interpolation interpolation, int parts) { return worst(f, Sampled(f, 0, 2 * pi, parts).function(interpolation, true), 0, 2 * pi); };
    // Halved parts: splines 2⁴, straight lines 2².
    EXPECT_NEAR(std::log2(off(Interpolation::spline, 64) / off(Interpolation::spline, 128)), 4, 0.3);
    EXPECT_NEAR(std::log2(off(Interpolation::linear, 64) / off(Interpolation::linear, 128)), 2, 0.2);
    EXPECT_LT(off(Interpolation::spline, 128), 2e-6);
}

TEST(PieceFunction, OfASplineHasContinuousCurvature) {
    auto const f = [](double x) { return std::sin(x); };
    for (bool const repeats : {false, true}) {
        auto const table = Sampled(f, 0, 2 * pi, 17).function(Interpolation::spline, repeats);
        auto const pieces = table.table().pieces;
        int const count = table.table().count;
        for (int i = 0; i < count; ++i) {
            double const end = i + 1 < count ? pieces[i + 1].from : 2 * pi, h = end - pieces[i].from, curvature = 2 * pieces[i].square + 6 * pieces[i].cube * h;
            double const next = i + 1 < count ? 2 * pieces[i + 1].square : repeats ? 2 * pieces[0].square : 0;
            EXPECT_NEAR(curvature, next, 1e-12);
        }
        double const at_start = pieces[0].square;
        EXPECT_NEAR(repeats ? 0 : at_start, 0, 1e-12);
    }
}

TEST(PieceFunction, ThatIsMonotoneDoesNotOvershoot) {
    // A step, which a spline overshoots.
    std::vector<double> const places{0, 1, 2, 2.1, 3, 4}, values{0, 0, 0, 1, 1, 1};
    double most = 0, most_of_spline = 0;
    PieceFunction const monotone(places, values, Interpolation::monotone, false), spline(places, values, Interpolation::spline, false);
    double last = 0;
    for (double x = 0; x <= 4; x += 1e-3) {
        double const value = table_point(monotone.table(), x).value;
        EXPECT_GE(value, last - 1e-15);
        last = value;
        most = std::max(most, value);
        most_of_spline = std::max(most_of_spline, table_point(spline.table(), x).value);
    }
    EXPECT_LE(most, 1 + 1e-15);
    EXPECT_GT(most_of_spline, 1.05);
}

TEST(PieceFunction, SaysWhatPointsAreNone) {
    auto const fault = [](std::vector<double> const& places, std::vector<double> const& values, bool repeats = false) { return PieceFunction::fault_of(places, values, repeats); };
    EXPECT_FALSE(fault({0, 1, 2}, {5, 6, 5}, true));
    EXPECT_EQ(fault({0}, {1})->point, 0u);
    EXPECT_EQ(fault({0, 2, 1}, {0, 0, 0})->point, 2u);
    EXPECT_EQ(fault({0, 0, 1}, {0, 0, 0})->point, 1u);
    EXPECT_EQ(fault({0, 1, 2}, {0, std::nan(""), 0})->point, 1u);
    EXPECT_EQ(fault({0, 1, 2}, {0, 1, 0.5}, true)->point, 2u);
    EXPECT_FALSE(fault({0, 1, 2}, {0, 1, 0.5}));
}

}  // namespace
}  // namespace slideway::piece_function_test
