// Loads of pairs as of equal, very stiff springs (model.md M13.13).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kernels/rigid/spring_loads.hpp"
#include "tests/support/unit_slider.hpp"

namespace slideway::spring_loads_test {
namespace {

using Motion = Twist<double>;
using Springs = SpringLoads<double>;

Motion random_motion(std::mt19937_64& draw) {
    auto const next = [&draw] { return std::uniform_real_distribution(-1.0, 1.0)(draw); };
    return {{next(), next(), next()}, {next(), next(), next()}};
}

TEST(SpringLoads, MayMissByWhatRoundingLeavesOfLargeLoads) {
    // Two pairs that press against each other hundreds of times as hard as what they bring about asks for.
    testing::UnitSlider const slider;
    int solved = 0, to_a_hair = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937_64 draw(seed);
        Motion normals[2] = {random_motion(draw), {}};
        normals[1] = fma(4e-3, random_motion(draw), -1.0 * normals[0]);
        auto const before = random_motion(draw);
        auto want = before;
        TouchingPair<double> rows[2]{};
        for (int k = 0; k < 2; ++k) {
            rows[k].number = k;
            rows[k].pair.normal = normals[k];
            rows[k].pair.pushed = slider.at.response(normals[k]);
            rows[k].start(true, 0.0);
            rows[k].weigh(dot(normals[k], rows[k].pushed));
            want = fma(1e5, rows[k].pushed, want);
        }
        double size = 0;
        for (auto& row : rows) row.target = dot(row.pair.normal, want), size = std::max(size, row.target - dot(row.pair.normal, before));
        auto after = before;
        if (Springs(slider.at, rows, 2, before, false).solve(true, Springs::Start::loads, 16, {size, 1e-15 * size, 1e-13 * size}, after)) continue;
        ++solved;
        double missed = 0;
        for (auto const& row : rows) {
            EXPECT_NEAR(row.normal, 1e5, 0.1);
            missed = std::max(missed, std::abs(row.target - dot(row.pair.normal, after)));
        }
        to_a_hair += missed <= 1e-13 * size;
    }
    EXPECT_GE(solved, 95);
    EXPECT_LE(to_a_hair, 90) << "as exactly as where loads are small";
}

}  // namespace
}  // namespace slideway::spring_loads_test
