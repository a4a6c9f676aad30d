// The bed of springs against values by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/laws/foundation.hpp"

namespace slideway::foundation_test {
namespace {

constexpr double k = 3e9, depth = 2e-7;  // [N/m], [m]
using Values = std::array<double, 4>;    // of the apices a b c d

Values values(Quad<double> const& q) { return {q.a, q.b, q.c, q.d}; }
double sum_of(Values const& v) { return v[0] + v[1] + v[2] + v[3]; }

template <class Damping = PointDamping>
FaceForces<double> pushed(Values const& at, Values const& rate = {}, Values const& v0 = {}, ContactParameters<double> const& contact = {}) {
    LineContact<double> const no_line{};
    FaceMotion<double> m;
    m.apex = {{at[0], rate[0], v0[0]}, {at[1], rate[1], v0[1]}, {at[2], rate[2], v0[2]}, {at[3], rate[3], v0[3]}};
    m.touching = {at[0] > 0, at[1] > 0, at[2] > 0, at[3] > 0};
    return Foundation::forces<Damping>(m, {k, no_line, no_line}, contact);
}

TEST(Foundation, AFlatFaceBearsAsTheSurfaceDoes) {
    auto const f = pushed({depth, depth, depth, depth});
    for (double const force : values(f.normal)) EXPECT_NEAR(force, k * depth / 4, 1e-14 * k * depth);
    EXPECT_NEAR(f.potential, k * depth * depth / 2, 1e-14 * k * depth * depth);
    EXPECT_EQ(values(f.normal), values(f.elastic));
}

TEST(Foundation, ACornerAloneHasTheCornersSpring) {
    // The next nodes lie 0.28 of the way to a neighbour and are out: 0.72 δ − 0.28 · 3 δ < 0.  w = 1/12².
    auto const f = pushed({depth, -3 * depth, -7 * depth, -3 * depth});
    EXPECT_NEAR(f.normal.a, k * depth / 144, 1e-14 * k * depth);
    EXPECT_EQ(f.normal.b, 0);
    EXPECT_EQ(f.normal.c, 0);
    EXPECT_EQ(f.normal.d, 0);
    EXPECT_NEAR(f.potential, k * depth * depth / 288, 1e-14 * k * depth * depth);
}

TEST(Foundation, AnEdgePushesTheFarApicesToo) {
    // δ(ξ) = ξ δ: of the four rows of springs two push, 1/12 k δ at ξ = 1 and 5/12 k δ/√5 at 1/√5, whose lever splits it.
    auto const f = pushed({depth, depth, -depth, -depth});
    double const t = 1 / std::sqrt(5.0), at_edge = k * depth / 12, within = 5 * k * depth * t / 12;
    for (double const near : {f.normal.a, f.normal.b}) EXPECT_NEAR(near, (at_edge + within * (1 + t) / 2) / 2, 1e-14 * k * depth);
    for (double const far : {f.normal.c, f.normal.d}) EXPECT_NEAR(far, within * (1 - t) / 4, 1e-14 * k * depth);
    EXPECT_GT(f.normal.c, 0);
    EXPECT_NEAR(f.potential, (at_edge + within * t) * depth / 2, 1e-14 * k * depth * depth);
}

TEST(Foundation, LyingFlatIsAMinimumAgainstTilt) {
    // ½ k times the mean of (h + ε ξ)² is ½ k (h² + ε²/3): the quadrature is exact for it.
    for (double const tilt : {1e-3 * depth, 0.1 * depth, 0.9 * depth}) {
        for (Values const& apices : {Values{1, 1, -1, -1}, Values{1, -1, -1, 1}}) {
            Values at;
            for (std::size_t i = 0; i < 4; ++i) at[i] = depth + tilt * apices[i];
            auto const f = pushed(at);
            EXPECT_NEAR(f.potential, k * (depth * depth + tilt * tilt / 3) / 2, 1e-14 * k * depth * depth);
            EXPECT_NEAR(sum_of(values(f.normal)), k * depth, 1e-14 * k * depth);
        }
    }
}

TEST(Foundation, DampsEachSpringByItsOwnRate) {
    ContactParameters<double> contact{};
    contact.damping.chi_surface = 10;
    Values const flat{depth, depth, depth, depth};
    // 1 + 10 s/m · 0.02 m/s, and cut off at 0 at −0.2 m/s.
    EXPECT_NEAR(sum_of(values(pushed<RateDamping>(flat, {0.02, 0.02, 0.02, 0.02}, {}, contact).normal)), 1.2 * k * depth, 1e-14 * k * depth);
    EXPECT_EQ(sum_of(values(pushed<RateDamping>(flat, {-0.2, -0.2, -0.2, -0.2}, {}, contact).normal)), 0);
    // δ'(ξ) = ξ v takes ∫ k δ χ ξ² v² = k δ χ v²/3.
    double const v = 0.02;
    Values const rate{v, v, -v, -v};
    auto const f = pushed<RateDamping>(flat, rate, {}, contact);
    double taken = 0;
    for (std::size_t i = 0; i < 4; ++i) taken += (values(f.normal)[i] - values(f.elastic)[i]) * rate[i];
    EXPECT_NEAR(taken, k * depth * 10 * v * v / 3, 1e-13 * k * depth);
}

TEST(Foundation, TakesTheImpactSpeedOfApicesThatTouch) {
    ContactParameters<double> contact{};
    contact.damping.restitution_slope = 0.5;
    Values const corner{depth, -3 * depth, -7 * depth, -3 * depth}, rate{0.02, 0, 0, 0};
    // 1 + 0.5 · 0.02/0.04; b, c and d have had faster impacts before.
    auto const f = pushed<RestitutionDamping>(corner, rate, {0.04, 1, 1, 1}, contact);
    EXPECT_NEAR(f.normal.a, 1.25 * k * depth / 144, 1e-14 * k * depth);
    auto const away = pushed<RestitutionDamping>({-depth, -depth, -depth, -depth}, rate, {1, 1, 1, 1}, contact);
    EXPECT_EQ(sum_of(values(away.normal)), 0);
}

}  // namespace
}  // namespace slideway::foundation_test
