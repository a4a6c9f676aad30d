// Where touches are found inside a step, and what they leave behind for the restitution.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/steppers/touch.hpp"

namespace slideway {
namespace {

constexpr double clearance = 1e-4;

/// The sixteen apex–face pairs, one after the other.
struct Pair {
    int face;
    double Quad<double>::*apex;
};

std::vector<Pair> pairs() {
    std::vector<Pair> all;
    for (int face = 0; face < face_count; ++face) {
        for (auto const apex : {&Quad<double>::a, &Quad<double>::b, &Quad<double>::c, &Quad<double>::d}) {
            all.push_back({face, apex});
        }
    }
    return all;
}

double& depth(ContactReport<double>& r, Pair const& p) { return r.penetration[p.face].*p.apex; }
double& rate(ContactReport<double>& r, Pair const& p) { return r.rate[p.face].*p.apex; }

/// Every pair a clearance away from its face and at rest.
ContactReport<double> apart() {
    ContactReport<double> r;
    r.clear();
    for (auto const& p : pairs()) depth(r, p) = -clearance, rate(r, p) = 0;
    return r;
}

ImpactMemory<double> memory_of(double speed) {
    ImpactMemory<double> memory;
    for (auto& face : memory.speeds) face = {speed, speed, speed, speed};
    return memory;
}

TEST(TouchLocator, FindsWhereAnyPairMeetsItsFace) {
    // δ(t) = −g + v t + b t²/2 is a parabola, which the cubic through both ends renders exactly.
    double const step = 2e-3, gap = 3e-5, v = 0.02, b = 10;
    double const touch = (std::sqrt(v * v + 2 * b * gap) - v) / b;
    for (auto const& p : pairs()) {
        TouchLocator<double> touches;
        auto start = apart(), end = apart();
        depth(start, p) = -gap, rate(start, p) = v;
        depth(end, p) = -gap + v * step + 0.5 * b * step * step, rate(end, p) = v + b * step;
        touches.keep(true, start);
        EXPECT_NEAR(touches.earliest(true, end, step, clearance, memory_of(0.05)), touch / step, 1e-6) << p.face;
        EXPECT_EQ(touches.earliest(false, end, step, clearance, memory_of(0.05)), 1.0) << "a rejected lane is not searched";
    }
}

TEST(TouchLocator, TakesTheFirstOfSeveral) {
    auto const all = pairs();
    for (std::size_t i = 0; i < all.size(); ++i) {
        TouchLocator<double> touches;
        auto start = apart(), end = apart();
        // Straight lines: pair i meets its face at a quarter of the step, its neighbour in the list half way.
        auto const& other = all[(i + 1) % all.size()];
        depth(start, all[i]) = -1e-5, depth(end, all[i]) = 3e-5, rate(start, all[i]) = rate(end, all[i]) = 4e-5;
        depth(start, other) = -1e-5, depth(end, other) = 1e-5, rate(start, other) = rate(end, other) = 2e-5;
        touches.keep(true, start);
        EXPECT_NEAR(touches.earliest(true, end, 1.0, clearance, memory_of(0.05)), 0.25, 1e-6);
    }
}

TEST(TouchLocator, LeavesAStepThatEndsAtItsTouch) {
    TouchLocator<double> touches;
    auto end = apart();
    touches.keep(true, apart());
    auto const p = pairs()[5];
    rate(end, p) = 0.1;
    depth(end, p) = 0.9 * TouchLocator<double>::tolerance * clearance;
    EXPECT_EQ(touches.earliest(true, end, 1e-3, clearance, memory_of(0.05)), 1.0);
    depth(end, p) = 1.1 * TouchLocator<double>::tolerance * clearance;
    EXPECT_LT(touches.earliest(true, end, 1e-3, clearance, memory_of(0.05)), 1.0);
}

TEST(TouchLocator, SetsTheSpeedOfThePairThatTouched) {
    for (auto const& touching : pairs()) {
        TouchLocator<double> touches;
        touches.keep(true, apart());
        auto end = apart();
        for (auto const& p : pairs()) rate(end, p) = 0.7;  // rates of pairs that do not touch are nobody's speed
        depth(end, touching) = 1e-13;
        rate(end, touching) = 0.3;
        auto memory = memory_of(0.05);
        EXPECT_FALSE(touches.update(false, end, memory)) << "a rejected step touches nothing";
        for (auto const& p : pairs()) EXPECT_EQ(memory.speeds[p.face].*p.apex, 0.05);
        EXPECT_TRUE(touches.update(true, end, memory));
        for (auto const& p : pairs()) {
            bool const same = p.face == touching.face && p.apex == touching.apex;
            EXPECT_EQ(memory.speeds[p.face].*p.apex, same ? 0.3 : 0.05);
        }
        rate(end, touching) = 0.9;
        EXPECT_FALSE(touches.update(true, end, memory)) << "what touches already does not touch again";
        EXPECT_EQ(memory.speeds[touching.face].*touching.apex, 0.3);
    }
}

TEST(TouchLocator, NeverRemembersLessThanTheLeastSpeed) {
    TouchLocator<double> touches;
    touches.keep(true, apart());
    auto end = apart();
    for (auto const& p : pairs()) depth(end, p) = 1e-13, rate(end, p) = 1e-9;
    auto memory = memory_of(0.05);
    EXPECT_TRUE(touches.update(true, end, memory));
    for (auto const& p : pairs()) EXPECT_EQ(memory.speeds[p.face].*p.apex, least_impact_speed);
    EXPECT_EQ(least_impact_speed, 1e-4);
}

TEST(TouchLocator, KeepsTheGapsOfTheLastAcceptedStep) {
    TouchLocator<double> touches;
    auto inside = apart();
    auto const p = pairs()[9];
    depth(inside, p) = 1e-9;
    touches.keep(true, inside);
    touches.keep(false, apart());
    auto memory = memory_of(0.05);
    EXPECT_FALSE(touches.update(true, inside, memory)) << "a lane that was not taken keeps its old gaps";
    touches.keep(true, apart());
    EXPECT_TRUE(touches.update(true, inside, memory));
}

}  // namespace
}  // namespace slideway
