// The closed form of the mass between two springs against its equations.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/work_precision/bouncing_solution.hpp"

namespace slideway::bench::bouncing_solution_test {
namespace {

constexpr BouncingMember member{.y = 0.25, .v = 3, .stiffness = 50, .rate = 100};

/// v²/2 + y, and on a face p (y − f)²/2.
double energy(BounceEnd const& s) {
    auto const depth = s.face == 0 ? 0 : s.y - s.face;
    return static_cast<double>(s.v * s.v / 2 + s.y + member.stiffness * depth * depth / 2);
}

TEST(BouncingSolution, BeginsAtTheStart) {
    auto const s = bouncing_solution(member, 0);
    EXPECT_EQ(s.y, 0.25L);
    EXPECT_EQ(s.v, 3.0L);
    EXPECT_EQ(s.events, 0);
}

TEST(BouncingSolution, SolvesTheEquationsInFlightAndOnBothFaces) {
    constexpr double h = 1e-7;
    int on_face[3] = {0, 0, 0};
    for (double t = 1e-4; t < 0.2; t += 3.7e-4) {
        auto const here = bouncing_solution(member, t);
        if (here.margin < 2 * h * member.rate) continue;
        auto const before = bouncing_solution(member, t - h), after = bouncing_solution(member, t + h);
        double const push = here.face == 0 ? 0 : member.stiffness * static_cast<double>(here.y - here.face);
        EXPECT_NEAR(static_cast<double>((after.y - before.y) / (2 * h)), member.rate * static_cast<double>(here.v), 1e-5) << t;
        EXPECT_NEAR(static_cast<double>((after.v - before.v) / (2 * h)), -member.rate * (1 + push), 1e-5) << t;
        ++on_face[here.face + 1];
    }
    for (int const count : on_face) EXPECT_GT(count, 20);
}

TEST(BouncingSolution, KeepsItsEnergyOverManyContacts) {
    auto const last = bouncing_solution(member, 10);
    EXPECT_GT(last.events, 300);
    EXPECT_NEAR(energy(last), 4.75, 1e-12);
}

TEST(BouncingSolution, FallsBackWhereItDoesNotReachTheUpperFace) {
    // From y = −1 with v = 1 a flight takes 2 and rises to −1/2.
    BouncingMember const slow{.y = -1, .v = 1, .stiffness = 50, .rate = 1};
    auto const top = bouncing_solution(slow, 1);
    EXPECT_NEAR(static_cast<double>(top.y), -0.5, 1e-15);
    EXPECT_NEAR(static_cast<double>(top.margin), 1, 1e-15);
    EXPECT_EQ(bouncing_solution(slow, 2.01).face, -1);
}

}  // namespace
}  // namespace slideway::bench::bouncing_solution_test
