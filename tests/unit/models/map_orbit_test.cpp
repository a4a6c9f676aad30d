// Orbits of maps and the growth of their shadows' offsets, against closed forms and published exponents.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/models/models.hpp"

namespace slideway::map_orbit_test {
namespace {

using testing::Following;
using testing::HenonInputs;
using testing::LogisticInputs;
using testing::ModelResult;

Following following(std::size_t transient, std::size_t intervals, int shadows, double d0 = 1e-7, double period = 1) {
    Following f;
    f.clocks = {{0, period, period}};
    f.stops = {.count = transient + intervals + 1, .transient = transient};
    f.shadows = shadows;
    f.d0 = d0;
    return f;
}

std::vector<LogisticInputs> logistic(double r, std::size_t count) {
    std::vector<LogisticInputs> members;
    for (std::size_t i = 0; i < count; ++i)
        members.push_back({r, std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0)});
    return members;
}

std::vector<HenonInputs> henon(std::size_t count) {
    std::vector<HenonInputs> members(count);
    for (std::size_t i = 0; i < count; ++i)
        members[i].x = 0.2 * std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0);
    return members;
}

double mean_of_all(ModelResult const& r, Following const& f, std::size_t members, int shadow) {
    double mean = 0;
    for (std::size_t i = 0; i < members; ++i) mean += mean_growth(r, f, i, shadow) / static_cast<double>(members);
    return mean / f.clocks[0].period;
}

class Maps : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
};

TEST_P(Maps, LogisticAtFourGrowsByLn2) {
    // The tent map's exponent, to which it is conjugate (Ulam & von Neumann 1947).
    auto const f = following(50, 4000, 1, 1e-8);
    auto const r = testing::run(GetParam(), logistic(4, 64), f);
    EXPECT_NEAR(mean_of_all(r, f, 64, 0), std::log(2), 0.005 * std::log(2));
    RecordProperty("exponent", std::to_string(mean_of_all(r, f, 64, 0)));
}

TEST_P(Maps, LogisticOfPeriodTwoHasItsMultiplier) {
    // x± with x+ + x− = (r + 1)/r and x+ x− = (r + 1)/r²: (f²)' = r² (1 − 2x+)(1 − 2x−) = 4 + 2r − r².
    for (double const r : {3.2, 3.4}) {
        auto const f = following(200, 1000, 1, 1e-8);
        auto const got = testing::run(GetParam(), logistic(r, 9), f);
        double const want = std::log(std::abs(4 + 2 * r - r * r)) / 2;
        for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(mean_growth(got, f, i, 0), want, 1e-6) << r;
        RecordProperty("off", std::to_string(1e9 * (mean_growth(got, f, 0, 0) - want)) + "e-9");
    }
}

TEST_P(Maps, LogisticOfAFixedPointHasItsSlope) {
    // x = 1 − 1/r attracts for r in (1, 3) with slope 2 − r.
    auto const f = following(200, 100, 1, 1e-8);
    auto const got = testing::run(GetParam(), logistic(2.5, 3), f);
    EXPECT_NEAR(mean_growth(got, f, 1, 0), std::log(0.5), 1e-6);
    EXPECT_NEAR(got.states[1], 0.6, 1e-15);
}

TEST_P(Maps, HenonHasItsPublishedExponentAndItsDeterminant) {
    // 0.419: Sprott, Chaos and Time-Series Analysis (2003), table A.2.1; the sum is ln b exactly, for det = −b everywhere.
    auto const f = following(100, 20000, 2, 1e-8);
    auto const r = testing::run(GetParam(), henon(16), f);
    double const first = mean_of_all(r, f, 16, 0), second = mean_of_all(r, f, 16, 1);
    EXPECT_NEAR(first, 0.41922, 0.01 * 0.41922);
    EXPECT_NEAR(first + second, std::log(0.3), 1e-9);
    RecordProperty("first", std::to_string(first));
    RecordProperty("sum_off", std::to_string(1e12 * (first + second - std::log(0.3))) + "e-12");
}

TEST_P(Maps, GrowthDoesNotDependOnHowOftenShadowsArePutBack) {
    auto const every = following(20, 1000, 1, 1e-9), fourth = following(5, 250, 1, 1e-9, 4);
    auto const a = testing::run(GetParam(), henon(8), every), b = testing::run(GetParam(), henon(8), fourth);
    for (std::size_t i = 0; i < 8; ++i) {
        // Recorded are steps 22 to 1021, and 25 to 1024: common to both are 249 fours from 25 on.
        double sum = 0, fours = 0;
        for (std::size_t k = 3; k < 999; ++k) sum += a.growth[i * 1000 + k];
        for (std::size_t k = 0; k < 249; ++k) fours += b.growth[i * 250 + k];
        EXPECT_NEAR(sum, fours, 0.02) << i << ", of some 400";
    }
}

TEST_P(Maps, TakeTheirStepsExactly) {
    // x ← 2x (1 − x) from 1/4: 3/8, 15/32, 255/512; Hénon with dyadic numbers by hand.
    Following f = following(0, 2, 0);
    auto const r = testing::run(GetParam(), std::vector<LogisticInputs>{{2, 0.25}}, f);
    EXPECT_EQ(r.sections, (std::vector<double>{0.375, 15.0 / 32, 255.0 / 512}));
    EXPECT_EQ(r.states[0], 255.0 / 512);
    EXPECT_TRUE(r.growth.empty());
    auto const h = testing::run(GetParam(), std::vector<HenonInputs>{{1.5, 0.25, 0.5, 1}}, f);
    // (0.5, 1) -> (1.625, 0.125) -> (1.125 − 3.9609375, 0.40625) -> 1 − 1.5 · 2.8359375² + 0.40625
    EXPECT_EQ(h.sections, (std::vector<double>{1.625, 0.125, -2.8359375, 0.40625,
                                               1 - 1.5 * 2.8359375 * 2.8359375 + 0.40625, -0.708984375}));
}

TEST_P(Maps, AnOrbitThatEscapesIsNaNFromThere) {
    auto const f = following(0, 30, 2);
    auto members = henon(11);
    members[4].x = 100;
    auto const good = testing::run(GetParam(), henon(11), f), r = testing::run(GetParam(), members, f);
    EXPECT_TRUE(std::isnan(r.states[8]));
    EXPECT_EQ(r.sections[4 * 31 * 2], 1 - 1.4 * 10000) << "until it overflows it is a number";
    EXPECT_TRUE(std::isnan(r.growth[4 * 60 + 59]));
    for (std::size_t i = 0; i < 11; ++i) {
        if (i == 4) continue;
        for (std::size_t k = 0; k < 60; ++k)
            EXPECT_EQ(r.growth[i * 60 + k], good.growth[i * 60 + k]) << "its neighbours are not";
    }
}

TEST_P(Maps, OfNobodyDoNothing) {
    auto const r = testing::run(GetParam(), std::vector<HenonInputs>{}, following(0, 3, 1));
    EXPECT_TRUE(r.growth.empty());
    Following never;
    never.clocks = {{0, 1, 1}};
    auto const still = testing::run(GetParam(), std::vector<HenonInputs>{{1.4, 0.3, 0.5, 0.25}}, never);
    EXPECT_EQ(still.states, (std::vector<double>{0.5, 0.25})) << "without stops there are no steps";
}

INSTANTIATE_TEST_SUITE_P(Isas, Maps, ::testing::ValuesIn(built_isas()),
                         [](auto const& info) { return std::string(name_of(info.param)); });

}  // namespace
}  // namespace slideway::map_orbit_test
