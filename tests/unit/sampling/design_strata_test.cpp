// Where the members of each design lie.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/sampling/samples.hpp"

namespace slideway::design_strata_test {
namespace {

using Kind = Distribution::Kind;
using testing::Columns;
using testing::columns_of;
using testing::design_of;
using testing::planned;
using testing::unit_uniform;
using testing::variations_of;

TEST(Design, LatinHypercubesHaveOneMemberPerStratum) {
    auto const variations = variations_of(6, unit_uniform());
    for (std::uint64_t const members : {1u, 2u, 5u, 64u, 1000u, 10007u}) {
        auto const columns = columns_of(design_of(DesignKind::lhs), variations, members);
        for (auto column : columns) {
            std::sort(column.begin(), column.end());
            for (std::uint64_t i = 0; i < members; ++i) {
                ASSERT_EQ(std::floor(column[i] * static_cast<double>(members)), static_cast<double>(i));
            }
        }
    }
}

TEST(Design, LatinHypercubesSpreadWithinTheirStrataAndPairUpFreely) {
    constexpr std::uint64_t members = 20000;
    auto const columns = columns_of(design_of(DesignKind::lhs), variations_of(6, unit_uniform()), members);
    std::vector<double> numbers(members);
    for (std::uint64_t i = 0; i < members; ++i) numbers[i] = static_cast<double>(i);
    double const limit = 5 / std::sqrt(static_cast<double>(members));
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::vector<double> places;
        double square = 0;
        for (double const u : columns[i]) {
            places.push_back(u * members - std::floor(u * members));
            square += (places.back() - 0.5) * (places.back() - 0.5);
        }
        EXPECT_NEAR(testing::mean_of(places), 0.5, limit * 0.29);
        EXPECT_NEAR(square / members, 1.0 / 12, limit * 0.075);  // deviation of (v − ½)² is 1/√180
        EXPECT_NEAR(testing::correlation_of(places, columns[i]), 0, limit);
        EXPECT_NEAR(testing::correlation_of(columns[i], numbers), 0, limit);
        for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(testing::correlation_of(columns[i], columns[j]), 0, limit);
    }
}

TEST(Design, SobolMembersArePointsOfTheirOwnDimension) {
    // Each alone has one of 2^10 members per 2^-10; every pair of the first ten fills each square of area 2^-4 evenly.
    auto const columns = columns_of(design_of(DesignKind::sobol), variations_of(10, unit_uniform()), 1024);
    for (std::size_t i = 0; i < 10; ++i) {
        auto sorted = columns[i];
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t m = 0; m < 1024; ++m) ASSERT_EQ(std::floor(sorted[m] * 1024), static_cast<double>(m));
        for (std::size_t j = 0; j < i; ++j) {
            std::vector<int> counts(16);
            for (std::size_t m = 0; m < 1024; ++m) {
                ++counts[static_cast<std::size_t>(columns[i][m] * 4) * 4 + static_cast<std::size_t>(columns[j][m] * 4)];
            }
            EXPECT_EQ(std::count(counts.begin(), counts.end(), 64), 16) << i << " " << j;
            EXPECT_NE(columns[i][0], columns[j][0]);  // point 0 is the shift of the key alone
        }
    }
}

/// Root mean square error, over 16 seeds, of the mean of f = Π (π/2) sin(π u_i), whose integral is 1.
double integration_error(DesignKind kind, std::size_t d, std::uint64_t members) {
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        auto const columns = columns_of(design_of(kind), variations_of(d, unit_uniform()), members, seed);
        double sum = 0;
        for (std::uint64_t m = 0; m < members; ++m) {
            double f = 1;
            for (auto const& column : columns) f *= std::numbers::pi / 2 * std::sin(std::numbers::pi * column[m]);
            sum += f;
        }
        double const error = sum / static_cast<double>(members) - 1;
        squares += error * error;
    }
    return std::sqrt(squares / 16);
}

TEST(Design, SobolIntegratesFarBetterThanRandomMembers) {
    // Variance of f: (π²/8)^5 − 1.
    double const mc = std::sqrt((std::pow(std::numbers::pi * std::numbers::pi / 8, 5) - 1) / 4096);
    EXPECT_NEAR(integration_error(DesignKind::mc, 5, 4096), mc, 0.6 * mc);
    EXPECT_LT(integration_error(DesignKind::sobol, 5, 4096), mc / 10);
    EXPECT_LT(integration_error(DesignKind::lhs, 5, 4096), mc);
    EXPECT_LT(integration_error(DesignKind::sobol, 2, 4096), integration_error(DesignKind::mc, 2, 4096) / 300);
}

TEST(Design, SaltelliRowsAreABAndMixtures) {
    constexpr std::size_t d = 3;
    auto const variations = variations_of(d, unit_uniform());
    auto const [design, members] = planned(DesignKind::saltelli, d, 64 * (d + 2));
    auto const x = columns_of(design, variations, members);
    std::vector<Columns> sides(2, Columns(d));
    for (std::uint64_t row = 0; row < 64; ++row) {
        std::uint64_t const first = row * (d + 2);
        for (std::size_t i = 0; i < d; ++i) {
            double const a = x[i][first], b = x[i][first + 1];
            EXPECT_NE(a, b);
            for (std::size_t mixed = 0; mixed < d; ++mixed) {
                EXPECT_EQ(x[i][first + 2 + mixed], mixed == i ? b : a) << row << " " << mixed << " " << i;
            }
            sides[0][i].push_back(a);
            sides[1][i].push_back(b);
        }
    }
    // Rows are points of 2d dimensions: each is stratified, and A and B are independent.
    for (auto const& side : sides) {
        for (auto column : side) {
            std::sort(column.begin(), column.end());
            for (std::size_t row = 0; row < 64; ++row)
                EXPECT_EQ(std::floor(column[row] * 64), static_cast<double>(row));
        }
    }
    for (std::size_t i = 0; i < d; ++i) EXPECT_LT(std::abs(testing::correlation_of(sides[0][i], sides[1][i])), 0.3);
}

TEST(Design, GridsTakeAllCombinationsTheLastFastest) {
    auto variations = variations_of(3, {Kind::uniform, 0, 0, 0, 8});
    variations[1].distribution = {Kind::values};
    variations[1].distribution.list = {7, 5, 6};
    Design design = design_of(DesignKind::grid);
    design.levels = {2, 3, 4};
    auto const x = columns_of(design, variations, 24);
    std::size_t member = 0;
    for (double const first : {2.0, 6.0}) {
        for (double const second : {7.0, 5.0, 6.0}) {
            for (double const third : {1.0, 3.0, 5.0, 7.0}) {
                EXPECT_EQ((std::vector{x[0][member], x[1][member], x[2][member]}), (std::vector{first, second, third}));
                ++member;
            }
        }
    }
}

TEST(Design, GridsOfManyValuesMissNone) {
    for (std::size_t n = 1; n <= 200; ++n) {
        Distribution distribution{Kind::values};
        for (std::size_t i = 0; i < n; ++i) distribution.list.push_back(static_cast<double>(i));
        Design design = design_of(DesignKind::grid);
        design.levels = {n};
        EXPECT_EQ(columns_of(design, variations_of(1, distribution), n)[0], distribution.list);
    }
}

}  // namespace
}  // namespace slideway::design_strata_test
