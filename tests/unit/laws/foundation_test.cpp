// The elastic bed against values by hand, against exact fractions (tests/golden/bed.py) and against quadrature in 80 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "kernels/laws/foundation.hpp"
#include "tests/oracle/bed.hpp"
#include "tests/oracle/golden_table.hpp"

namespace slideway::foundation_test {
namespace {

constexpr double k = 3e9, depth = 2e-7;  // [N/m], [m]
using Values = std::array<double, 4>;    // of the apices a b c d
constexpr Values along{1, 1, -1, -1}, across{1, -1, -1, 1};

Values values(Quad<double> const& q) { return {q.a, q.b, q.c, q.d}; }
double sum_of(Values const& v) { return v[0] + v[1] + v[2] + v[3]; }
Values plane(double level, double by_along, double by_across) {
    Values v;
    for (std::size_t i = 0; i < 4; ++i) v[i] = level + by_along * along[i] + by_across * across[i];
    return v;
}

struct Bed {
    double stiffness = k, slope = 0, given = follows, area = 1e-3;
    Values v0{1, 1, 1, 1};
};
ContactParameters<double> contact_of(Bed const& bed) {
    ContactParameters<double> contact{};
    contact.damping.chi_surface = contact.damping.restitution_slope = bed.slope;
    contact.of_law.a = bed.given;
    return contact;
}
FaceMotion<double> motion(Values const& at, Values const& rate, Values const& v0) {
    FaceMotion<double> m;
    m.apex = {{at[0], rate[0], v0[0]}, {at[1], rate[1], v0[1]}, {at[2], rate[2], v0[2]}, {at[3], rate[3], v0[3]}};
    m.touching = {at[0] > 0, at[1] > 0, at[2] > 0, at[3] > 0};
    return m;
}
template <class Damping = RateDamping> FaceForces<double> pushed(Values const& at, Values const& rate = {}, Bed const& bed = {}) {
    LineContact<double> const no_line{};
    return Foundation::forces<Damping>(motion(at, rate, bed.v0), {bed.stiffness, no_line, no_line, bed.area}, contact_of(bed));
}
template <class Damping = RateDamping> FaceStiffness<double> answered(Values const& at, Values const& rate, Bed const& bed) {
    LineContact<double> const no_line{};
    return Foundation::stiffness<Damping>(motion(at, rate, bed.v0), {bed.stiffness, no_line, no_line, bed.area}, contact_of(bed));
}

/// Rows by apices, columns too.
std::array<Values, 4> matrix(Quad<ApexSlopes<double>> const& s) {
    return {Values{s.a.own, s.a.across, s.a.opposite, s.a.along}, Values{s.b.across, s.b.own, s.b.along, s.b.opposite},
            Values{s.c.opposite, s.c.along, s.c.own, s.c.across}, Values{s.d.along, s.d.opposite, s.d.across, s.d.own}};
}

TEST(Foundation, AFlatFaceBearsAsTheSurfaceDoes) {
    auto const f = pushed({depth, depth, depth, depth});
    for (double const force : values(f.normal)) EXPECT_NEAR(force, k * depth / 4, 1e-15 * k * depth);
    EXPECT_NEAR(f.potential, k * depth * depth / 2, 1e-15 * k * depth * depth);
    EXPECT_EQ(values(f.normal), values(f.elastic));
}

TEST(Foundation, ACornerBearsAPyramid) {
    // δ falls to zero over a quarter of both edges: a pyramid over a triangle of 1/32 of the face, whose volume is a third of height times area.
    auto const f = pushed({depth, -3 * depth, -7 * depth, -3 * depth});
    double const load = k * depth / 3 / 32;
    EXPECT_NEAR(sum_of(values(f.normal)), load, 1e-15 * load);
    // Its centre is a quarter of those edges from the apex, at ξ = η = 7/8.
    EXPECT_NEAR(f.normal.a + f.normal.b, load * 15 / 16, 1e-14 * load);
    EXPECT_NEAR(f.normal.a + f.normal.d, load * 15 / 16, 1e-14 * load);
    EXPECT_GT(f.normal.c, 0);
    // U = ½ k ∫ δ²: over the triangle the mean of δ² is a sixth of its largest value.
    EXPECT_NEAR(f.potential, k * depth * depth / 2 / 6 / 32, 1e-15 * k * depth * depth);
}

TEST(Foundation, AnEdgePushesTheFarApicesToo) {
    // δ(ξ) = ξ δ: of the load k δ ∫ ξ dξ/2 = k δ/4 the edge ξ = 1 has the share ∫ ξ (1 + ξ)/2 dξ / ∫ ξ dξ = 5/6.
    auto const f = pushed({depth, depth, -depth, -depth});
    for (double const near : {f.normal.a, f.normal.b}) EXPECT_NEAR(near, k * depth * 5 / 48, 1e-15 * k * depth);
    for (double const far : {f.normal.c, f.normal.d}) EXPECT_NEAR(far, k * depth / 48, 1e-15 * k * depth);
    EXPECT_NEAR(f.potential, k * depth * depth / 12, 1e-15 * k * depth * depth);
}

TEST(Foundation, LyingFlatIsAMinimumAgainstTilt) {
    for (double const tilt : {1e-3 * depth, 0.1 * depth, 0.9 * depth}) {
        for (Values const& at : {plane(depth, tilt, 0), plane(depth, 0, tilt)}) {
            auto const f = pushed(at);
            EXPECT_NEAR(f.potential, k * (depth * depth + tilt * tilt / 3) / 2, 1e-14 * k * depth * depth);
            EXPECT_NEAR(sum_of(values(f.normal)), k * depth, 1e-14 * k * depth);
        }
    }
}

TEST(Foundation, HasTheStiffnessThatIsGiven) {
    // κ A = 2e13 N/m³ · 1e-3 m².
    auto const f = pushed({depth, depth, depth, depth}, {}, {.given = 2e13});
    EXPECT_NEAR(sum_of(values(f.normal)), 2e10 * depth, 1e-12 * depth);
    Inputs in;
    in.law_a = 2e13;
    EXPECT_EQ(Foundation::face_stiffness(in, k, 1e-3), 2e10);
    in.law_a = follows;
    EXPECT_EQ(Foundation::face_stiffness(in, k, 1e-3), k);
}

TEST(Foundation, DampsEachPlaceByItsOwnRate) {
    Bed const bed{.slope = 10};
    Values const flat{depth, depth, depth, depth};
    // 1 + 10 s/m · 0.02 m/s, and cut off at 0 at −0.2 m/s.
    EXPECT_NEAR(sum_of(values(pushed(flat, plane(0.02, 0, 0), bed).normal)), 1.2 * k * depth, 1e-14 * k * depth);
    EXPECT_EQ(sum_of(values(pushed(flat, plane(-0.2, 0, 0), bed).normal)), 0);
    // δ'(ξ) = ξ v takes ∫ k δ χ ξ² v² = k δ χ v²/3.
    double const v = 0.02;
    auto const rate = plane(0, v, 0);
    auto const f = pushed(flat, rate, bed);
    double taken = 0;
    for (std::size_t i = 0; i < 4; ++i) taken += (values(f.normal)[i] - values(f.elastic)[i]) * rate[i];
    EXPECT_NEAR(taken, k * depth * 10 * v * v / 3, 1e-13 * k * depth);
}

TEST(Foundation, TakesTheImpactSpeedOfApicesThatTouch) {
    Values const corner{depth, -3 * depth, -7 * depth, -3 * depth};
    // A rate that is the same everywhere: 1 + 0.5 · 0.02/0.04; b, c and d have had faster impacts before.
    auto const f = pushed<RestitutionDamping>(corner, plane(0.02, 0, 0), {.slope = 0.5, .v0 = {0.04, 1, 1, 1}});
    EXPECT_NEAR(sum_of(values(f.normal)), 1.25 * k * depth / 96, 1e-14 * k * depth);
}

TEST(Foundation, IsNothingAndFiniteWhereNothingTouches) {
    for (double const tilt : {0.0, 1e-20, 1e-3}) {
        for (Values const& v0 : {Values{0, 0, 0, 0}, Values{1, 1, 1, 1}}) {
            Bed const bed{.slope = 0.5, .v0 = v0};
            auto const away = plane(-1e-2, tilt, tilt);
            auto const f = pushed<RestitutionDamping>(away, plane(0.1, 0.1, 0.1), bed);
            EXPECT_EQ(values(f.normal), Values{});
            EXPECT_EQ(values(f.elastic), Values{});
            EXPECT_EQ(f.potential, 0);
            auto const slopes = answered<RestitutionDamping>(away, plane(0.1, 0.1, 0.1), bed);
            for (auto const& rows : {matrix(slopes.by_depth), matrix(slopes.by_rate)}) {
                for (auto const& row : rows) EXPECT_EQ(row, Values{});
            }
        }
    }
}

// ---- tables of exact values ----

Values four(golden::Table const& table, std::size_t row, std::string const& name) {
    return {table.number(row, name + "_a"), table.number(row, name + "_b"), table.number(row, name + "_c"), table.number(row, name + "_d")};
}

TEST(Foundation, MeetsExactValuesToFourteenDigits) {
    auto const table = golden::Table::read(SLIDEWAY_TEST_DATA "/golden/bed.csv");
    ASSERT_EQ(table.rows(), 48U);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const at = four(table, row, "depth"), rate = four(table, row, "rate"), elastic = four(table, row, "elastic"),
                   normal = four(table, row, "normal");
        Bed const bed{.stiffness = 1, .slope = table.number(row, "slope")};
        auto const f = pushed(at, rate, bed);
        auto const slopes = answered(at, rate, bed);
        double const load = sum_of(elastic), damped = std::max(load, std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]) + std::abs(normal[3]));
        EXPECT_NEAR(f.potential, table.number(row, "potential"), 1e-14 * table.number(row, "potential")) << row;
        double stiffness = 0, viscosity = 0;
        std::string const names = "abcd";
        auto const exact = [&](char const* name, std::size_t i, std::size_t j) { return table.number(row, std::string(name) + names[i] + names[j]); };
        for (std::size_t i = 0; i < 16; ++i) stiffness += std::abs(exact("by_depth_", i / 4, i % 4)), viscosity += std::abs(exact("by_rate_", i / 4, i % 4));
        auto const by_depth = matrix(slopes.by_depth), by_rate = matrix(slopes.by_rate);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(values(f.elastic)[i], elastic[i], 1e-14 * load) << row;
            EXPECT_NEAR(values(f.normal)[i], std::max(normal[i], 0.0), 1e-14 * damped) << row;
            EXPECT_NEAR(values(slopes.normal)[i], std::max(normal[i], 0.0), 1e-14 * damped) << row;
            bool const pushes = normal[i] > 0;
            for (std::size_t j = 0; j < 4; ++j) {
                EXPECT_NEAR(by_depth[i][j], pushes ? exact("by_depth_", i, j) : 0, 1e-14 * stiffness) << row << i << j;
                EXPECT_NEAR(by_rate[i][j], pushes ? exact("by_rate_", i, j) : 0, 1e-14 * viscosity) << row << i << j;
            }
        }
    }
}

/// A plane that doubles hold exactly at the apices, of one of the shapes: flat but for tilts of 1e-12 of the depth, corners and strips down
/// to a thousandth of the face, for the quadrature takes differences of places, and any.
Values drawn(std::mt19937_64& random) {
    auto const whole = [&](unsigned bits) { return static_cast<double>(static_cast<std::int64_t>(random() >> (64 - bits))); };
    auto const sign = [&] { return random() % 2 == 0 ? 1.0 : -1.0; };
    unsigned const size = 38 + static_cast<unsigned>(random() % 10);
    double const p = sign() * whole(48), q = sign() * whole(48), little = 1 + whole(size);
    switch (random() % 5) {
        case 0:
            return plane(whole(48), sign() * whole(8), sign() * whole(8));
        case 1:
            return plane(little - std::abs(p) - std::abs(q), p, q);
        case 2:
            return plane(std::abs(p) + std::abs(q) - little, p, q);
        case 3:
            return random() % 2 == 0 ? plane(little - std::abs(p), p, random() % 2 == 0 ? 0 : sign() * whole(size)) : plane(p, 0, q);
        default:
            return plane(sign() * whole(size), p, q);
    }
}

TEST(Foundation, MeetsQuadratureOnTenThousandPlanes) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> rates(-0.02, 0.02);
    int wet = 0;
    for (int draw = 0; draw < 10000; ++draw) {
        auto at = drawn(random);
        double const unit = std::ldexp(1.0, -52 - static_cast<int>(random() % 25));
        for (double& value : at) value *= unit;
        auto const rounded = [&] { return std::ldexp(std::nearbyint(std::ldexp(rates(random), 30)), -30); };
        double const level = rounded(), tilt = rounded();
        auto const rate = plane(level, tilt, -tilt);
        Bed const bed{.stiffness = 1, .slope = 10};
        std::vector<oracle::detail::BedPlace> square;
        for (std::size_t i = 0; i < 4; ++i) square.push_back({along[i], across[i], at[i], rate[i]});
        auto const places = oracle::detail::quadrature_over_wet(square);
        auto const f = pushed(at, rate, bed);
        long double load = 0, potential = 0, exact[4] = {}, damped[4] = {};
        for (auto const& [place, area] : places) {
            load += area / 4 * place.depth;
            potential += area / 8 * place.depth * place.depth;
            for (std::size_t i = 0; i < 4; ++i) {
                long double const share = area / 16 * place.depth * (1 + along[i] * place.along) * (1 + across[i] * place.across);
                exact[i] += share;
                damped[i] += share * (1 + 10 * place.rate);
            }
        }
        wet += load > 0 ? 1 : 0;
        for (std::size_t i = 0; i < 4; ++i) {
            ASSERT_NEAR(values(f.elastic)[i], static_cast<double>(exact[i]), 1e-14 * static_cast<double>(load)) << draw;
            ASSERT_NEAR(values(f.normal)[i], static_cast<double>(std::max(damped[i], 0.0L)), 1e-14 * static_cast<double>(load)) << draw;
        }
        ASSERT_NEAR(f.potential, static_cast<double>(potential), 1e-14 * static_cast<double>(potential)) << draw;
    }
    EXPECT_GT(wet, 9000);
}

// ---- what follows from U ----

Values any_plane(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> unit(-1, 1);
    return plane(size * unit(random), size * unit(random), size * unit(random));
}

TEST(Foundation, HasAConvexPotentialWhoseGradientItsForcesAre) {
    std::mt19937_64 random(7);
    for (int draw = 0; draw < 10000; ++draw) {
        auto const a = any_plane(random, depth), b = any_plane(random, depth), way = any_plane(random, 1);
        Values middle, up, down;
        double const step = 1e-4 * depth;
        for (std::size_t i = 0; i < 4; ++i) middle[i] = (a[i] + b[i]) / 2, up[i] = a[i] + step * way[i], down[i] = a[i] - step * way[i];
        ASSERT_LE(pushed(middle).potential, (pushed(a).potential + pushed(b).potential) / 2 + 1e-15 * k * depth * depth);
        double work = 0;
        for (std::size_t i = 0; i < 4; ++i) work += values(pushed(a).elastic)[i] * way[i];
        ASSERT_NEAR(work, (pushed(up).potential - pushed(down).potential) / (2 * step), 1e-7 * k * depth) << draw;
    }
}

TEST(Foundation, NeverGetsEnergyFromItsDamping) {
    std::mt19937_64 random(11);
    int clipped = 0;
    for (int draw = 0; draw < 100000; ++draw) {
        auto const at = any_plane(random, depth), rate = any_plane(random, 1);
        auto const f = pushed(at, rate, {.slope = 2});
        auto const normal = values(f.normal), elastic = values(f.elastic);
        double taken = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            taken += (normal[i] - elastic[i]) * rate[i];
            if (elastic[i] > 0 && normal[i] == 0) ++clipped;
        }
        ASSERT_GE(taken, -1e-14 * sum_of(elastic)) << draw;
    }
    EXPECT_GT(clipped, 1000);
}

}  // namespace
}  // namespace slideway::foundation_test
