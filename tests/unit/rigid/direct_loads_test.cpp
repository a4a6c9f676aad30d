// Loads of pairs that all push, from one linear system (model.md M13.13).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "kernels/rigid/direct_loads.hpp"

namespace slideway::direct_loads_test {
namespace {

using Motion = Twist<double>;

Motion random_motion(std::mt19937_64& draw) {
    auto const next = [&draw] { return std::uniform_real_distribution(-1.0, 1.0)(draw); };
    return {{next(), next(), next()}, {next(), next(), next()}};
}

/// Pairs on a body of mass 1 and inertia 1, whose loads are known.
struct Problem {
    std::vector<TouchingPair<double>> rows;
    std::vector<double> loads;
    Motion before, after;

    /// @param drag friction of a pair by its load: what it does is no longer along its normal  @param stride of the pairs' numbers: 1 on one face
    Problem(std::vector<Motion> const& normals, std::vector<double> known, double drag, std::mt19937_64& draw, int stride = 5)
        : loads(std::move(known)), before(random_motion(draw)), after(before) {
        for (auto const& normal : normals) {
            TouchingPair<double> row;
            row.number = stride * static_cast<int>(rows.size());
            row.pair.normal = row.pair.pushed = normal;
            row.start(true, 0.0);
            row.pushed = fma(drag, random_motion(draw), normal);
            row.weigh(dot(normal, row.pushed));
            rows.push_back(row);
        }
        for (std::size_t k = 0; k < rows.size(); ++k) after = fma(loads[k], rows[k].pushed, after);
        for (auto& row : rows) row.target = dot(row.pair.normal, after);
    }

    bool solve() {
        Motion motion = before;
        double size = 0;
        for (auto const& row : rows) size = std::max(size, std::abs(row.target - dot(row.pair.normal, before)));
        bearable = 1e-13 * size;
        bool const open = DirectLoads<double>(rows.data(), static_cast<int>(rows.size()), before).solve(true, {size, 0, bearable}, motion);
        found = motion;
        return !open;
    }
    Motion found;
    double bearable = 0;
};

std::vector<Motion> random_normals(std::size_t count, std::mt19937_64& draw) {
    std::vector<Motion> normals(count);
    for (auto& normal : normals) normal = random_motion(draw);
    return normals;
}

/// Normals of the four apices of a face: front +, front −, rear −, rear +.
std::vector<Motion> face() {
    std::vector<Motion> normals;
    for (auto const& [along, across] : {std::array{1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}, {-1.0, 1.0}}) {
        normals.push_back({{0, 1, 0}, {-0.6 * across, 0, 0.8 * along}});
    }
    return normals;
}

TEST(DirectLoads, AreThoseOfThePairs) {
    std::mt19937_64 draw(1);
    for (std::size_t count = 1; count <= 4; ++count) {
        Problem problem(random_normals(count, draw), {3, 0.5, 2, 0.1}, 0.1, draw);
        ASSERT_TRUE(problem.solve()) << count;
        for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(problem.rows[k].normal, problem.loads[k], 1e-11) << count << " " << k;
        EXPECT_NEAR(problem.found.linear.x, problem.after.linear.x, 1e-12);
        EXPECT_NEAR(problem.found.angular.z, problem.after.angular.z, 1e-12);
    }
}

TEST(DirectLoads, OfAFaceVaryLinearlyOverIt) {
    std::mt19937_64 draw(2);
    // 2 + 0.5 along − 0.3 across: the motion is that of any other loads with the same sum and moments.
    std::vector<double> const even{2.2, 2.8, 1.8, 1.2};
    Problem problem(face(), {2.2 + 0.7, 2.8 - 0.7, 1.8 + 0.7, 1.2 - 0.7}, 0, draw, 1);
    ASSERT_TRUE(problem.solve());
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(problem.rows[k].normal, even[k], 1e-12) << k;
}

TEST(DirectLoads, LeavesWhatPulls) {
    std::mt19937_64 draw(3);
    Problem problem(random_normals(3, draw), {1, -0.2, 1}, 0, draw);
    for (auto& row : problem.rows) row.normal = 7;
    EXPECT_FALSE(problem.solve());
    for (auto const& row : problem.rows) EXPECT_EQ(row.normal, 7);
    EXPECT_EQ(problem.found.linear.x, problem.before.linear.x);
}

TEST(DirectLoads, LeavesPairsThatStick) {
    std::mt19937_64 draw(4);
    Problem problem(random_normals(2, draw), {1, 1}, 0, draw);
    problem.rows[1].coefficient = 0.3;
    EXPECT_FALSE(problem.solve());
}

TEST(DirectLoads, LeavesPairsOfWhichOneFollowsFromTheOther) {
    // Next to that too: there are loads then, but they would be of next to nothing.
    for (double const apart : {0.0, 1e-5}) {
        std::mt19937_64 draw(5);
        auto normals = random_normals(1, draw);
        normals.push_back(fma(apart, random_motion(draw), normals[0]));
        Problem problem(normals, {1, 1}, 0, draw);
        EXPECT_FALSE(problem.solve()) << apart;
    }
}

TEST(DirectLoads, OfAWedgeAreFoundDownToABillionth) {
    // Of the second pair's own motion the first leaves about the square of `apart`.
    for (double const apart : {1e-2, 1e-3, 2e-4}) {
        std::mt19937_64 draw(5);
        auto normals = random_normals(1, draw);
        normals.push_back(fma(apart, random_motion(draw), normals[0]));
        Problem problem(normals, {1, 2}, 0, draw);
        ASSERT_TRUE(problem.solve()) << apart;
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(problem.rows[k].normal, problem.loads[k], 1e-15 / (apart * apart)) << apart;
    }
}

TEST(DirectLoads, MayMissByWhatRoundingLeavesOfLargeOnes) {
    // Two pairs that press against each other thousands of times as hard as what they bring about asks for.
    int solved = 0, to_a_hair = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937_64 draw(seed);
        auto normals = random_normals(1, draw);
        normals.push_back(fma(2e-4, random_motion(draw), -1.0 * normals[0]));
        Problem problem(normals, {1e6, 1e6}, 0, draw);
        if (!problem.solve()) continue;
        ++solved;
        for (auto const& row : problem.rows) EXPECT_NEAR(row.normal, 1e6, 1);
        double missed = 0;
        for (auto const& row : problem.rows) missed = std::max(missed, std::abs(row.target - dot(row.pair.normal, problem.found)));
        to_a_hair += missed <= problem.bearable;
    }
    EXPECT_GE(solved, 95);
    EXPECT_LT(to_a_hair, 50) << "as exactly as where loads are small";
}

TEST(DirectLoads, LeavesMorePairsThanFreeVelocities) {
    std::mt19937_64 draw(6);
    Problem problem(random_normals(7, draw), {1, 1, 1, 1, 1, 1, 1}, 0, draw, 2);
    EXPECT_FALSE(problem.solve());
}

}  // namespace
}  // namespace slideway::direct_loads_test
