// Zeros of the cubic that event functions follow within a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::cubic_zeros_test {
namespace {

/// Values and slopes at both ends of a step.
struct Ends {
    double v0, s0, v1, s1;
};

/// scale (θ − a)(θ − b)(θ − c).
Ends with_zeros(double scale, double a, double b, double c) {
    auto const value = [&](double x) { return scale * (x - a) * (x - b) * (x - c); };
    auto const slope = [&](double x) { return scale * ((x - b) * (x - c) + (x - a) * (x - c) + (x - a) * (x - b)); };
    return {value(0), slope(0), value(1), slope(1)};
}

/// c + b (θ − m) + a (θ − m)².
Ends parabola(double a, double b, double c, double m) {
    auto const value = [&](double x) { return c + (x - m) * (b + a * (x - m)); };
    auto const slope = [&](double x) { return b + 2 * a * (x - m); };
    return {value(0), slope(0), value(1), slope(1)};
}

CubicZeros<double> zeros_of(Ends const& e, Direction direction) {
    return cubic_zeros(may_cross(e.v0, e.s0, e.v1, e.s1), e.v0, e.s0, e.v1, e.s1, direction);
}

std::vector<CubicZero<double>> found(Ends const& e, Direction direction = Direction::both) {
    auto const zeros = zeros_of(e, direction);
    std::vector<CubicZero<double>> list;
    for (auto const& zero : zeros.at) {
        if (zero.theta <= 1) list.push_back(zero);
    }
    EXPECT_EQ(zeros.any, !list.empty());
    return list;
}

constexpr double near = 1e-7;  // what 24 halvings leave to the dense output
double const nan = std::numeric_limits<double>::quiet_NaN();

TEST(CubicZeros, AllThreeAreFoundInTheirOrder) {
    for (double const scale : {1.0, -3.0, 1e-9, 1e9}) {
        auto const list = found(with_zeros(scale, 0.15, 0.4, 0.9));
        ASSERT_EQ(list.size(), 3u) << scale;
        double const want[] = {0.15, 0.4, 0.9};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(list[i].theta, want[i], near);
            EXPECT_LE(list[i].low, want[i]);
            EXPECT_GE(list[i].high, want[i]);
            double slope = scale;
            for (std::size_t j = 0; j < 3; ++j) slope *= j == i ? 1 : want[i] - want[j];
            EXPECT_NEAR(list[i].slope, slope, 1e-5 * std::abs(slope)) << i;
        }
    }
}

TEST(CubicZeros, ThoseInsideTheStepAreFoundWhereverTheOthersLie) {
    double const places[] = {-2.3, -0.4, 0.08, 0.31, 0.5, 0.77, 0.96, 1.2, 3.0};
    for (double const a : places) {
        for (double const b : places) {
            for (double const c : places) {
                if (!(a < b && b < c)) continue;
                std::vector<double> want;
                for (double const zero : {a, b, c}) {
                    if (zero > 0 && zero < 1) want.push_back(zero);
                }
                auto const e = with_zeros(2.0, a, b, c);
                auto const list = found(e);
                ASSERT_EQ(list.size(), want.size()) << a << ' ' << b << ' ' << c;
                for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(list[i].theta, want[i], near);
            }
        }
    }
}

TEST(CubicZeros, NoPairOfThemIsMissedWhateverTheSlopesAtTheEnds) {
    // Both ends rise, both fall, or they lean away from the zeros.
    for (double const sign : {1.0, -1.0}) {
        for (auto const& [a, b, c] : {std::array{-0.05, 0.3, 0.35}, {0.6, 0.65, 1.1}, {0.0, 0.5, 0.51}}) {
            auto const list = found(with_zeros(sign, a, b, c));
            ASSERT_GE(list.size(), 2u) << a << ' ' << b << ' ' << c;
            double const from[] = {a, b, c};
            for (double const zero : from) {
                if (zero <= 0 || zero >= 1) continue;
                EXPECT_TRUE(std::ranges::any_of(list, [&](auto const& z) { return std::abs(z.theta - zero) < near; }));
            }
        }
    }
}

TEST(CubicZeros, CandidatesMayChangeTheirSign) {
    // A valley that is shallow for its height does not.
    EXPECT_FALSE(may_cross(1.0, -1.0, 1.0, 1.0));
    EXPECT_TRUE(may_cross(1.0, -4.0, 1.0, 4.0));
    EXPECT_FALSE(may_cross(0.0, 0.0, 0.0, 0.0));
    EXPECT_FALSE(may_cross(0.0, 1.0, 1.0, 1.0)) << "it has left";
    EXPECT_FALSE(may_cross(0.0, 0.0, 1.0, 4.0)) << "it rested, and then rose";
    EXPECT_TRUE(may_cross(0.0, 0.0, -1.0, -4.0)) << "it rested, and then fell";
    EXPECT_TRUE(may_cross(0.0, -1.0, 1.0, 4.0)) << "it leaves now, and comes back";
}

TEST(CubicZeros, DirectionTellsRisesFromFalls) {
    auto const e = with_zeros(1.0, 0.15, 0.4, 0.9);  // rises, falls, rises
    auto const rising = found(e, Direction::rising), falling = found(e, Direction::falling);
    ASSERT_EQ(rising.size(), 2u);
    EXPECT_NEAR(rising[0].theta, 0.15, near);
    EXPECT_NEAR(rising[1].theta, 0.9, near);
    ASSERT_EQ(falling.size(), 1u);
    EXPECT_NEAR(falling[0].theta, 0.4, near);
}

TEST(CubicZeros, OfLowerDegreeAreFoundToo) {
    auto const line = found({-1, 4, 3, 4});
    ASSERT_EQ(line.size(), 1u);
    EXPECT_NEAR(line[0].theta, 0.25, near);
    auto const pair = found(parabola(5, 0, -0.05, 0.6));  // 0.6 ± 0.1
    ASSERT_EQ(pair.size(), 2u);
    EXPECT_NEAR(pair[0].theta, 0.5, near);
    EXPECT_NEAR(pair[1].theta, 0.7, near);
    EXPECT_TRUE(found({1, 0, 1, 0}).empty());
    EXPECT_TRUE(found({0, 0, 0, 0}).empty());
    EXPECT_TRUE(found({-1, 0, -1, 0}).empty());
}

TEST(CubicZeros, GrazingGivesAPairOrNothing) {
    for (double const depth : {-1e-3, -1e-9, -1e-15, -1e-17, 0.0, 1e-17, 1e-15, 1e-9, 1e-3}) {
        for (double const sign : {1.0, -1.0}) {
            auto e = parabola(1, 0, depth, 0.3);
            e = {sign * e.v0, sign * e.s0, sign * e.v1, sign * e.s1};
            auto const list = found(e);
            EXPECT_TRUE(list.empty() || list.size() == 2) << depth << " finds " << list.size();
            if (std::abs(depth) > 1e-14) {
                EXPECT_EQ(list.size(), depth < 0 ? 2u : 0u) << depth;
            }
            for (auto const& zero : list) {
                EXPECT_NEAR(std::abs(zero.theta - 0.3), std::sqrt(std::max(-depth, 0.0)), 1e-7);
            }
        }
    }
}

TEST(CubicZeros, AZeroAtTheBorderOfTwoStepsIsFoundOnce) {
    // v = ±(t − 1) over the steps [0, 1] and [1, 2].
    for (double const sign : {1.0, -1.0}) {
        auto const before = found({-sign, sign, 0, sign}), after = found({0, sign, sign, sign});
        EXPECT_EQ(before.size() + after.size(), 1u) << sign;
        // Zero counts as positive, so a rise has happened and a fall is to come.
        if (sign > 0) {
            ASSERT_EQ(before.size(), 1u);
            EXPECT_NEAR(before[0].theta, 1, near);
        } else {
            ASSERT_EQ(after.size(), 1u);
            EXPECT_NEAR(after[0].theta, 0, near);
        }
    }
}

TEST(CubicZeros, AStartOnZeroIsNoZeroIfItRises) {
    EXPECT_TRUE(found({0, 1, 1, 1}).empty());
    // Up and down again: the fall alone.
    auto const list = found(parabola(-4, 0, 1, 0.5 - 1e-3));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].theta, 1 - 1e-3, near);
    auto const from_zero = found({0, 1, -1, -3});  // θ (1 − 2 θ)
    ASSERT_EQ(from_zero.size(), 1u);
    EXPECT_NEAR(from_zero[0].theta, 0.5, near);
}

TEST(CubicZeros, ShortBouncesInALongStepKeepTheirDigits) {
    // θ (s − θ): up from zero at the start of the step, and down again at s.
    for (double s = 0.1; s > 1e-11; s /= 3) {
        auto const list = found({0, s, s - 1, s - 2}, Direction::falling);
        ASSERT_EQ(list.size(), 1u) << s;
        EXPECT_NEAR(list[0].theta, s, 1e-6 * s);
    }
}

TEST(CubicZeros, NanHasNone) {
    for (int i = 0; i < 4; ++i) {
        double e[4] = {1, -1, -1, -1};
        e[i] = nan;
        EXPECT_LE(found({e[0], e[1], e[2], e[3]}).size(), i % 2 == 0 ? 0u : 1u) << i;
    }
}

TEST(CubicZeros, ALaneThatIsNoCandidateHasNone) {
    auto const e = with_zeros(1.0, 0.15, 0.4, 0.9);
    EXPECT_FALSE(cubic_zeros(false, e.v0, e.s0, e.v1, e.s1, Direction::both).any);
}

}  // namespace
}  // namespace slideway::cubic_zeros_test
