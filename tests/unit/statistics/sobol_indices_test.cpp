#include "host/statistics/sobol_indices.hpp"

#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::sobol_indices_test {
namespace {

using Function = std::function<double(std::vector<double> const&)>;
using Points = std::function<double(std::size_t row, std::size_t coordinate)>;

/// f at A, B, AB_1 …; coordinates 0 … d-1 of a point are its row of A, d … 2d-1 that of B.
std::vector<double> radial_values(std::size_t d, std::size_t rows, Function const& f, Points const& point) {
    std::vector<double> values;
    for (std::size_t r = 0; r < rows; ++r) {
        std::vector<double> a(d), b(d);
        for (std::size_t i = 0; i < d; ++i) a[i] = point(r, i), b[i] = point(r, d + i);
        values.push_back(f(a));
        values.push_back(f(b));
        for (std::size_t i = 0; i < d; ++i) {
            std::vector<double> mixed = a;
            mixed[i] = b[i];
            values.push_back(f(mixed));
        }
    }
    return values;
}

/// Kronecker's sequence: multiples of √p modulo 1, primes p; evenly spread, and nothing of ours.
double kronecker(std::size_t row, std::size_t coordinate) {
    constexpr double primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    double const x = static_cast<double>(row + 1) * std::sqrt(primes[coordinate]);
    return x - std::floor(x);
}

double ishigami(std::vector<double> const& u) {
    auto const angle = [&](std::size_t i) { return std::numbers::pi * (2 * u[i] - 1); };
    double const s = std::sin(angle(0)), t = std::sin(angle(1));
    return s + 7 * t * t + 0.1 * std::pow(angle(2), 4) * s;
}

TEST(SobolIndices, OfTheIshigamiFunction) {
    // Closed form, a = 7, b = 0.1: V = a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2.
    double const pi4 = std::pow(std::numbers::pi, 4), variance = 49.0 / 8 + 0.1 * pi4 / 5 + 0.01 * pi4 * pi4 / 18 + 0.5;
    auto const values = radial_values(3, 1 << 14, ishigami, kronecker);
    SobolIndices const indices = sobol_indices({3, values});
    double const first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(indices.first[i].value, first[i], 0.01) << i;
        EXPECT_NEAR(indices.total[i].value, total[i], 0.01) << i;
        EXPECT_LT(indices.first[i].interval.low, first[i]) << i;
        EXPECT_GT(indices.first[i].interval.high, first[i]) << i;
    }
    EXPECT_NEAR(indices.first_sum.value, 0.7563, 0.02);
    EXPECT_NEAR(indices.variance, variance, 0.01 * variance);
    EXPECT_EQ(indices.rows, std::size_t{1} << 14);
    EXPECT_EQ(indices.missing, 0u);
}

TEST(SobolIndices, OfSobolsProduct) {
    // g = Π (|4x - 2| + a)/(1 + a): V_i = 1/(3 (1 + a_i)²), V = Π (1 + V_i) - 1, V T_i = V_i Π_{j≠i} (1 + V_j).
    std::vector<double> const a{0, 1, 4.5, 9};
    auto const g = [&](std::vector<double> const& x) {
        double product = 1;
        for (std::size_t i = 0; i < 4; ++i) product *= (std::abs(4 * x[i] - 2) + a[i]) / (1 + a[i]);
        return product;
    };
    std::vector<double> parts;
    double product = 1;
    for (double const ai : a) {
        parts.push_back(1 / (3 * (1 + ai) * (1 + ai)));
        product *= 1 + parts.back();
    }
    SobolIndices const indices = sobol_indices({4, radial_values(4, 1 << 14, g, kronecker)});
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(indices.first[i].value, parts[i] / (product - 1), 0.01) << i;
        EXPECT_NEAR(indices.total[i].value, parts[i] * product / (1 + parts[i]) / (product - 1), 0.01) << i;
    }
}

TEST(SobolIndices, CentreWhatLiesFarFromZero) {
    auto const near = radial_values(3, 1 << 10, ishigami, kronecker);
    auto far = near;
    for (double& x : far) x += 1e6;
    SobolIndices const a = sobol_indices({3, near}), b = sobol_indices({3, far});
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(a.first[i].value, b.first[i].value, 1e-8) << i;
        EXPECT_NEAR(a.total[i].value, b.total[i].value, 1e-8) << i;
        EXPECT_NEAR(a.first[i].interval.low, b.first[i].interval.low, 1e-8) << i;
    }
}

TEST(SobolIndices, IntervalsCoverAsOftenAsTheySay) {
    // f = 2 x1 + x2 + x1 x2 on centred uniform inputs: V = 4/12 + 1/12 + 1/144.
    auto const f = [](std::vector<double> const& u) {
        double const x = u[0] - 0.5, y = u[1] - 0.5;
        return 2 * x + y + x * y;
    };
    double const v = 61.0 / 144, truth[] = {48.0 / 144 / v, 12.0 / 144 / v, 49.0 / 144 / v, 13.0 / 144 / v, 60.0 / 61};
    std::mt19937_64 engine(6);
    auto const uniform = [&](std::size_t, std::size_t) {
        return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53;
    };
    constexpr int repetitions = 200;
    int covered[5] = {};
    for (int r = 0; r < repetitions; ++r) {
        auto const values = radial_values(2, 400, f, uniform);
        SobolIndices const s = sobol_indices({2, values}, {500, 0.95, static_cast<std::uint64_t>(r)});
        Interval const intervals[] = {s.first[0].interval, s.first[1].interval, s.total[0].interval,
                                      s.total[1].interval, s.first_sum.interval};
        for (int k = 0; k < 5; ++k) covered[k] += intervals[k].low <= truth[k] && truth[k] <= intervals[k].high;
    }
    for (int k = 0; k < 5; ++k) {
        EXPECT_GE(covered[k], 0.88 * repetitions) << k;
        EXPECT_LE(covered[k], 0.99 * repetitions) << k;
    }
}

TEST(SobolIndices, OfGroupedRowsHaveTheSameIntervals) {
    // Beyond 2^16 rows groups are drawn.  The interval's width still goes with 1/√rows.
    std::mt19937_64 engine(7);
    auto const uniform = [&](std::size_t, std::size_t) {
        return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53;
    };
    auto const f = [](std::vector<double> const& u) { return u[0]; };
    auto const width = [&](std::size_t rows) {
        SobolIndices const s = sobol_indices({1, radial_values(1, rows, f, uniform)});
        EXPECT_EQ(s.rows, rows);
        EXPECT_NEAR(s.total[0].value, 1, 0.02);
        return s.total[0].interval.high - s.total[0].interval.low;
    };
    EXPECT_NEAR(width(1 << 14) / width(1 << 18), 4, 0.5);
}

TEST(SobolIndices, LeaveRowsWithNanOutWhole) {
    auto values = radial_values(3, 200, ishigami, kronecker);
    auto shorter = values;
    values[7 * 5 + 4] = std::numeric_limits<double>::quiet_NaN();
    values[100 * 5 + 0] = std::numeric_limits<double>::quiet_NaN();
    shorter.erase(shorter.begin() + 100 * 5, shorter.begin() + 101 * 5);
    shorter.erase(shorter.begin() + 7 * 5, shorter.begin() + 8 * 5);
    SobolIndices const with = sobol_indices({3, values}), without = sobol_indices({3, shorter});
    EXPECT_EQ(with.rows, 198u);
    EXPECT_EQ(with.missing, 2u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(with.first[i].value, without.first[i].value);
        EXPECT_EQ(with.total[i].interval.high, without.total[i].interval.high);
    }
}

TEST(SobolIndices, OfAConstantAreNan) {
    SobolIndices const indices = sobol_indices({2, std::vector<double>(40, 3.25)});
    EXPECT_EQ(indices.variance, 0);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(std::isnan(indices.first[i].value));
        EXPECT_TRUE(std::isnan(indices.total[i].value));
        EXPECT_TRUE(std::isnan(indices.total[i].interval.low));
    }
    EXPECT_TRUE(std::isnan(indices.first_sum.value));
    SobolIndices const none = sobol_indices({2, {}});
    EXPECT_EQ(none.rows, 0u);
    EXPECT_TRUE(std::isnan(none.first[0].value));
    std::vector<double> infinite = radial_values(
        2, 10, [](auto const& u) { return u[0]; }, kronecker);
    infinite[3] = std::numeric_limits<double>::infinity();  // of the second input
    EXPECT_FALSE(std::isnan(sobol_indices({2, infinite}).total[0].value));
    EXPECT_TRUE(std::isnan(sobol_indices({2, infinite}).total[1].value));
    infinite[0] = std::numeric_limits<double>::infinity();  // of A
    EXPECT_TRUE(std::isnan(sobol_indices({2, infinite}).total[0].value));
}

TEST(SobolIndices, DoNotDependOnThreads) {
    auto const values = radial_values(3, 500, ishigami, kronecker);
    BootstrapSettings settings;
    SobolIndices const one = sobol_indices({3, values}, settings);
    settings.threads = 5;
    SobolIndices const five = sobol_indices({3, values}, settings);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one.first[i].interval.low, five.first[i].interval.low);
        EXPECT_EQ(one.first[i].interval.high, five.first[i].interval.high);
        EXPECT_EQ(one.total[i].interval.low, five.total[i].interval.low);
        EXPECT_EQ(one.total[i].interval.high, five.total[i].interval.high);
    }
    BootstrapSettings other;
    other.seed = 2;
    EXPECT_NE(sobol_indices({3, values}, other).total[0].interval.low, one.total[0].interval.low);
}

TEST(SobolIndices, UseAsManyThreadsAsTheyAreTold) {
    auto const values = radial_values(3, 500, ishigami, kronecker);
    auto const threads_of_process = [] {
        std::filesystem::directory_iterator const tasks("/proc/self/task");
        return std::distance(begin(tasks), end(tasks));
    };
    // OpenMP keeps its threads until the one that they belong to ends.
    std::thread([&] {
        auto const before = threads_of_process();
        BootstrapSettings settings;
        sobol_indices({3, values}, settings);
        EXPECT_EQ(threads_of_process(), before);
        settings.threads = 3;
        sobol_indices({3, values}, settings);
        EXPECT_EQ(threads_of_process(), before + 2);
    }).join();
}

}  // namespace
}  // namespace slideway::sobol_indices_test
