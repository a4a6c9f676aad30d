// How often the interval of an exponent from one series holds the exponent: twenty stretches of four systems.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/study/series_analysis.hpp"
#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::series_coverage_test {
namespace {

constexpr std::size_t stretches = 20;

/// x of Rössler's flow, 0.1 apart, by RK4 with steps of 0.01; a transient of its own for each stretch.
std::vector<double> roessler_series(std::size_t count, std::array<double, 3> const& parameters, std::size_t stretch) {
    using State = std::array<double, 3>;
    auto const [a, b, c] = parameters;
    auto const rate = [&](State const& u) { return State{-u[1] - u[2], u[0] + a * u[1], b + u[2] * (u[0] - c)}; };
    auto const moved = [](State u, State const& k, double h) {
        for (std::size_t i = 0; i < 3; ++i) u[i] += h * k[i];
        return u;
    };
    State u{static_cast<double>(stretch), 1, 0};
    auto const advance = [&](std::size_t steps) {
        double const h = 0.01;
        for (std::size_t n = 0; n < steps; ++n) {
            State const p = rate(u), q = rate(moved(u, p, h / 2)), r = rate(moved(u, q, h / 2)),
                        s = rate(moved(u, r, h));
            for (std::size_t i = 0; i < 3; ++i) u[i] += h / 6 * (p[i] + 2 * q[i] + 2 * r[i] + s[i]);
        }
    };
    advance(20'000 + 3'700 * stretch);
    std::vector<double> x(count);
    for (double& value : x) {
        value = u[0];
        advance(10);
    }
    return x;
}

struct System {
    char const* name;
    double exponent, spacing;
    std::function<std::vector<double>(std::size_t count, std::size_t stretch)> series;
};

std::vector<System> systems() {
    auto const lorenz = [](double spacing) {
        return [=](std::size_t n, std::size_t i) { return lorenz_series(n, spacing, static_cast<double>(i)); };
    };
    auto const roessler = [](std::array<double, 3> const& p) {
        return [=](std::size_t n, std::size_t i) { return roessler_series(n, p, i); };
    };
    // Rössler: by two orbits over 30,000 units of time, 0.0707 and 0.0888; published are 0.0714 and 0.090.
    return {{"Lorenz, 0.01 apart", 0.9056, 0.01, lorenz(0.01)},
            {"Lorenz, 0.02 apart", 0.9056, 0.02, lorenz(0.02)},
            {"Rössler (0.2, 0.2, 5.7)", 0.0714, 0.1, roessler({0.2, 0.2, 5.7})},
            {"Rössler (0.15, 0.2, 10)", 0.0888, 0.1, roessler({0.15, 0.2, 10})},
            {"Hénon", 0.4192, 1,
             [](std::size_t n, std::size_t i) {
                 auto const all = henon_series(n + 1000 * i);
                 return std::vector<double>(all.end() - static_cast<std::ptrdiff_t>(n), all.end());
             }},
            {"logistic, r = 4", std::log(2), 1, [](std::size_t n, std::size_t i) {
                 return logistic_series(n, 4, 0.1 + 0.0317 * static_cast<double>(i));
             }}};
}

void expect_held(std::size_t points) {
    for (System const& system : systems()) {
        std::size_t held = 0, found = 0, seen = 0, told = 0;
        double mean = 0, chance = 0, systematic = 0;
        for (std::size_t i = 1; i <= stretches; ++i) {
            SeriesAnalysis const a = analyse_series(system.series(points, i), system.spacing);
            if (!a.growth) continue;
            ++found;
            seen += a.growth_is_seen() && a.growth->line.r_squared >= 0.95;
            told += a.growth_is_exponential();
            held += std::abs(a.growth->exponent - system.exponent) <= a.growth->half_width();
            mean += a.growth->exponent;
            chance += a.growth->chance();
            systematic += a.growth->systematic;
        }
        auto const n = static_cast<double>(found);
        fmt::print(
            "{:<26} {:>6} samples: {} of {} held, {} of {} seen told, mean {:.4f} for {:.4f}, ± {:.4f} statistical ± {:.4f} systematic\n",
            system.name, points, held, found, told, seen, mean / n, system.exponent, chance / n, systematic / n);
        EXPECT_GE(found, 15u) << system.name;
        EXPECT_GE(20 * held, 19 * found) << system.name;
        EXPECT_GE(20 * told, 19 * seen) << system.name << ": no power of time";
    }
}

TEST(SeriesExponentCoverage, OfAThousandSamplesIsNineteenInTwenty) { expect_held(1'000); }
TEST(SeriesExponentCoverage, OfFiveThousandSamplesIsNineteenInTwenty) { expect_held(5'000); }
TEST(SeriesExponentCoverage, OfTwentyThousandSamplesIsNineteenInTwenty) { expect_held(20'000); }

}  // namespace
}  // namespace slideway::testing::series_coverage_test
