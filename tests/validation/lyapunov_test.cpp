// Growth of the offsets of shadows against known Lyapunov exponents of the Lorenz equations at (10, 28, 8/3).  Source of the
// exponents: Sprott, Chaos and Time-Series Analysis (2003), 4.2 and table A.4.14: 0.9056, 0, −14.5723; dimension 2.06215.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/models/models.hpp"

namespace slideway::lyapunov_test {
namespace {

using testing::Following;
using testing::LorenzInputs;
using testing::ModelResult;

constexpr double first_exponent = 0.9056, third_exponent = -14.5723;
constexpr double trace = -(10 + 1 + 8.0 / 3.0);  // of the Jacobian everywhere: the sum of the exponents

double spread(std::size_t i, double irrational) { return std::fmod(static_cast<double>(i + 1) * irrational, 1.0); }

std::vector<LorenzInputs> starts(std::size_t count) {
    std::vector<LorenzInputs> members(count);
    for (std::size_t i = 0; i < count; ++i) {
        members[i].x = 20 * spread(i, 0.6180339887498949) - 10;
        members[i].y = 20 * spread(i, 0.4142135623730951) - 10;
        members[i].z = 15 + 20 * spread(i, 0.7320508075688772);
    }
    return members;
}

IntegratorSettings adaptive(double tolerance) {
    IntegratorSettings s;
    s.method = Method::dopri5;
    s.rtol = s.atol = tolerance;
    s.max_step = 1;
    return s;
}

/// Stops every `period` until `end`; what is recorded begins at `transient`.
Following following(double period, double transient, double end, int shadows) {
    Following f;
    auto const count = static_cast<std::size_t>(std::lround(end / period));
    f.clocks = {{end, period, period}};
    f.stops = {.count = count, .transient = static_cast<std::size_t>(std::lround(transient / period))};
    f.shadows = shadows;
    return f;
}

/// Mean over the members of the exponents, and the standard error of the first.
struct Spectrum {
    std::array<double, 3> exponent{};
    double error = 0;
};

Spectrum spectrum_of(ModelResult const& r, Following const& f) {
    Spectrum s;
    auto const members = r.records.size();
    auto const n = static_cast<double>(members);
    double squares = 0;
    for (int j = 0; j < f.shadows; ++j) {
        auto& mean = s.exponent[static_cast<std::size_t>(j)];
        for (std::size_t i = 0; i < members; ++i) mean += mean_growth(r, f, i, j) / f.clocks[0].period / n;
    }
    for (std::size_t i = 0; i < members; ++i) {
        squares += std::pow(mean_growth(r, f, i, 0) / f.clocks[0].period - s.exponent[0], 2);
    }
    s.error = std::sqrt(squares / (n * (n - 1)));
    return s;
}

bool all_finished(ModelResult const& r) {
    for (auto const& record : r.records) {
        if (record.status != Status::finished) return false;
    }
    return true;
}

TEST(LorenzShadows, GrowAtTheFirstExponent) {
    // 64 starts, 20 before and 1000 recorded time units each, stops every 1, d0 = 1e-7.
    auto const f = following(1, 20, 1020, 1);
    auto const r = testing::run(best_isa(), adaptive(1e-8), starts(64), f);
    ASSERT_TRUE(all_finished(r));
    auto const s = spectrum_of(r, f);
    EXPECT_NEAR(s.exponent[0], first_exponent, 0.005 * first_exponent);
    EXPECT_LT(s.error, 0.0025 * first_exponent) << "the tolerance above must be two standard errors";
    RecordProperty("exponent", std::to_string(s.exponent[0]));
    RecordProperty("error", std::to_string(s.error));
}

TEST(LorenzShadows, HaveTheWholeSpectrum) {
    // Stops every 0.25: the third offset shrinks by e^3.6 between two of them and stays far above rounding.
    auto const f = following(0.25, 20, 520, 3);
    auto const r = testing::run(best_isa(), adaptive(1e-8), starts(64), f);
    ASSERT_TRUE(all_finished(r));
    auto const [exponent, error] = spectrum_of(r, f);
    EXPECT_NEAR(exponent[0], first_exponent, 0.01);
    EXPECT_NEAR(exponent[1], 0, 2e-3);
    EXPECT_NEAR(exponent[2], third_exponent, 0.01);
    EXPECT_NEAR(exponent[0] + exponent[1] + exponent[2], trace, 1e-3 * -trace);
    // The closed form holds far better: what is left is of the order of the offsets' curvature and the steps' errors.
    EXPECT_NEAR(exponent[0] + exponent[1] + exponent[2], trace, 1e-6 * -trace);
    EXPECT_NEAR(2 + (exponent[0] + exponent[1]) / -exponent[2], 2.06215, 0.005);
    RecordProperty("first", std::to_string(exponent[0]));
    RecordProperty("second", std::to_string(exponent[1]));
    RecordProperty("third", std::to_string(exponent[2]));
    RecordProperty("sum_off", std::to_string(1e9 * (exponent[0] + exponent[1] + exponent[2] - trace)) + "e-9");
}

TEST(LorenzShadows, TellTheSameAtAnyInitialDistanceAndStep) {
    auto const members = starts(64);
    for (double const tolerance : {1e-6, 1e-8, 1e-10}) {
        for (double const d0 : {1e-5, 1e-7, 1e-9}) {
            if (tolerance != 1e-8 && d0 != 1e-7) continue;
            auto f = following(1, 20, 320, 1);
            f.d0 = d0;
            auto const s = spectrum_of(testing::run(best_isa(), adaptive(tolerance), members, f), f);
            EXPECT_NEAR(s.exponent[0], first_exponent, 3 * s.error) << "d0 = " << d0 << ", tolerance " << tolerance;
            EXPECT_LT(s.error, 0.01) << "d0 = " << d0 << ", tolerance " << tolerance;
        }
    }
    for (double const period : {0.25, 0.5, 2.0}) {
        auto const f = following(period, 20, 320, 1);
        auto const s = spectrum_of(testing::run(best_isa(), adaptive(1e-8), members, f), f);
        EXPECT_NEAR(s.exponent[0], first_exponent, 3 * s.error) << "stops every " << period;
    }
}

TEST(LorenzShadows, GrowAlikeForInitialDistancesOverFourDecades) {
    // The same orbits by equal steps: growth differs by the offsets' own curvature, of the order of d0, and by rounding beside d0,
    // 256 times 3.6e-15 where states are near 20.
    auto const s = testing::equal_steps(Method::rk4, 0x1p-8, 20);
    auto const members = starts(8);
    auto f = following(1, 5, 20, 1);
    f.d0 = 1e-7;
    auto const reference = testing::run(best_isa(), s, members, f);
    for (double const d0 : {1e-5, 1e-6, 1e-8, 1e-9}) {
        f.d0 = d0;
        auto const r = testing::run(best_isa(), s, members, f);
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_NEAR(mean_growth(r, f, i, 0), mean_growth(reference, f, i, 0), 10 * (d0 + 1e-7) + 1e-12 / d0) << d0;
        }
    }
}

TEST(LorenzShadows, OneAloneGrowsAsTheFirstOfSeveral) {
    // Gram–Schmidt leaves the first vector's direction as it is.
    auto const s = testing::equal_steps(Method::rk4, 0x1p-8, 20);
    auto const members = starts(8);
    auto const alone = following(0.5, 5, 20, 1);
    auto const one = testing::run(best_isa(), s, members, alone);
    for (int const count : {2, 3}) {
        auto const several = following(0.5, 5, 20, count);
        auto const r = testing::run(best_isa(), s, members, several);
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_EQ(mean_growth(r, several, i, 0), mean_growth(one, alone, i, 0)) << "by equal steps to the last bit";
        }
    }
    // With steps that several share, statistically.
    auto const f1 = following(0.5, 20, 320, 1), f3 = following(0.5, 20, 320, 3);
    auto const a = spectrum_of(testing::run(best_isa(), adaptive(1e-8), starts(64), f1), f1);
    auto const b = spectrum_of(testing::run(best_isa(), adaptive(1e-8), starts(64), f3), f3);
    EXPECT_NEAR(a.exponent[0], b.exponent[0], 3 * std::hypot(a.error, b.error));
}

TEST(LorenzShadows, NeverTouchTheirMember) {
    // By equal steps, which no error shortens, the member's orbit is one and the same whatever its shadows do.
    constexpr double endless = 1e300;
    auto const members = starts(9);
    for (auto const method : {Method::rk4, Method::dopri5}) {
        auto const s = testing::equal_steps(method, 0x1p-8, 20);
        auto const reference = testing::run(best_isa(), s, members, following(0.5, 5, 20, 0));
        std::vector<Following> others;
        for (int const count : {1, 2, 3}) others.push_back(following(0.5, 5, 20, count));
        others.push_back(others[0]);
        others.back().lower = 0, others.back().upper = endless;  // never put back
        others.push_back(others[0]);
        others.back().lower = 1e-9, others.back().upper = 1e-3;  // now and then
        others.push_back(others[0]);
        others.back().d0 = 1e-3;
        for (auto const& f : others) {
            auto const r = testing::run(best_isa(), s, members, f);
            EXPECT_EQ(std::memcmp(r.states.data(), reference.states.data(), r.states.size() * sizeof(double)), 0);
            EXPECT_EQ(std::memcmp(r.sections.data(), reference.sections.data(), r.sections.size() * sizeof(double)), 0);
        }
    }
}

TEST(LorenzShadows, AreSolutionsOfTheirOwn) {
    // The member rests on the unstable origin, whose every step is free of error: the shadow alone keeps them short.  It goes where a
    // member goes that starts in its place.
    LorenzInputs rest, moving;
    rest.x = rest.y = rest.z = 0;
    moving.x = 0.5, moving.y = moving.z = 0;
    auto f = following(0.5, 0, 4, 1);
    f.d0 = 0.5;
    f.upper = 1e300;  // never put back
    f.directions = {1, 0, 0};
    auto const followed = testing::run(best_isa(), adaptive(1e-10), std::vector{rest}, f);
    auto const alone = testing::run(best_isa(), adaptive(1e-10), std::vector{moving}, following(0.5, 0, 4, 0));
    auto const distance = [&](std::size_t stop) {
        double const* y = &alone.sections[3 * stop];
        return std::hypot(y[0], y[1], y[2]);
    };
    for (std::size_t i = 0; i < f.stops.growths(); ++i) {
        EXPECT_NEAR(followed.growth[i], std::log(distance(i + 1) / distance(i)), 1e-7) << i;
    }
    EXPECT_EQ(followed.states, (std::vector<double>{0, 0, 0}));
}

TEST(LorenzShadows, LeftAloneGrowByTheSumOfTheirLogarithms) {
    // While offsets are small the exponent does not depend on when they are put back.
    auto const s = testing::equal_steps(Method::rk4, 0x1p-8, 5);
    auto const members = starts(8);
    auto f = following(0.5, 1, 5, 1);
    f.d0 = 1e-8;
    auto const rescaled = testing::run(best_isa(), s, members, f);
    f.upper = 1e300;
    auto const free = testing::run(best_isa(), s, members, f);
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_NEAR(mean_growth(free, f, i, 0), mean_growth(rescaled, f, i, 0), 5e-4) << i;
    }
    EXPECT_NE(mean_growth(free, f, 0, 0), mean_growth(rescaled, f, 0, 0));
}

TEST(LorenzShadows, OfAFixedPointShrinkAtItsEigenvalues) {
    // ρ = 1/2: the origin attracts; along z at −β, across at the roots of μ² + (σ + 1) μ + σ (1 − ρ) = 0.
    LorenzInputs in;
    in.rho = 0.5, in.x = in.y = in.z = 0;
    auto f = following(0.25, 50, 75, 3);
    auto settings = adaptive(1e-10);
    settings.max_step =
        0.01;  // the origin itself asks for no accuracy: the method's factor for e^(μ h) is to be good to 1e-9
    auto const r = testing::run(best_isa(), settings, std::vector{in}, f);
    double const root = std::sqrt(121.0 - 4 * 10 * 0.5);
    double const want[3] = {(-11 + root) / 2, -8.0 / 3, (-11 - root) / 2};
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(mean_growth(r, f, 0, j) / 0.25, want[j], 2e-6) << j;
}

TEST(LorenzShadows, ThatShrinkIntoRoundingStopAtTheFloor) {
    // At the origin the second and third offsets shrink by e^(20 β) and more between two stops, to 1e-15 by the rule.
    LorenzInputs in;
    in.rho = 0.5, in.x = in.y = in.z = 0;
    auto const f = following(20, 0, 100, 3);
    auto settings = adaptive(1e-10);
    settings.max_step = 0.05;
    auto const r = testing::run(best_isa(), settings, std::vector{in}, f);
    for (std::size_t i = 0; i < f.stops.growths(); ++i) {
        EXPECT_NEAR(r.growth[3 * i], 20 * (-11 + std::sqrt(101.0)) / 2, 1e-3) << "the first is not, " << i;
        for (std::size_t j : {1u, 2u}) EXPECT_NEAR(r.growth[3 * i + j], std::log(1e-8), 1e-12) << i;
    }
}

TEST(LorenzShadows, OfNoneAndOfNoIntervalLeaveNoGrowth) {
    auto const s = adaptive(1e-6);
    auto const members = starts(3);
    auto const none = testing::run(best_isa(), s, members, following(1, 2, 5, 0));
    EXPECT_TRUE(none.growth.empty());
    EXPECT_EQ(none.sections.size(), 3u * 3 * 3);
    auto last = following(1, 2, 5, 2);
    last.stops.transient = 4;  // one recorded stop, no interval
    auto const one = testing::run(best_isa(), s, members, last);
    EXPECT_TRUE(one.growth.empty());
    EXPECT_EQ(std::memcmp(one.sections.data(), one.states.data(), one.states.size() * sizeof(double)), 0);
    last.stops.transient = 7;  // all of it transient
    auto const all = testing::run(best_isa(), s, members, last);
    EXPECT_TRUE(all.growth.empty() && all.sections.empty());
    auto idle = following(1, 0, 5, 2);
    idle.stops = {};  // shadows without stops ride along
    EXPECT_TRUE(all_finished(testing::run(best_isa(), s, members, idle)));
}

TEST(LorenzShadows, OfAMemberThatFailsAreNaNFromThere) {
    auto members = starts(3);
    members[1].x = NAN;
    auto s = adaptive(1e-8);
    s.max_steps = 400;  // some 10 time units
    auto const f = following(0.5, 1, 20, 2);
    auto const r = testing::run(best_isa(), s, members, f);
    std::size_t const intervals = f.stops.growths();
    EXPECT_EQ(r.records[1].status, Status::nonfinite);
    for (std::size_t i = 0; i < intervals * 2; ++i) EXPECT_TRUE(std::isnan(r.growth[intervals * 2 + i]));
    for (std::size_t const member : {std::size_t(0), std::size_t(2)}) {
        ASSERT_EQ(r.records[member].status, Status::max_steps);
        // A stop at (i + 4)/2 ends interval i.
        for (std::size_t i = 0; i < intervals; ++i) {
            bool const is_number = !std::isnan(r.growth[(member * intervals + i) * 2]);
            EXPECT_EQ(is_number, 0.5 * static_cast<double>(i + 4) <= r.records[member].time) << member << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace slideway::lyapunov_test
