// Lanes that are refilled: members of very different cost, each as if it were alone, and few idle lanes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/models/models.hpp"

namespace slideway::lanes_test {
namespace {

using testing::BallInputs;
using testing::ModelResult;
using testing::OscillatorInputs;
using testing::TrackerInputs;

IntegratorSettings settings_of(Method method, double end_time, double tolerance = 1e-6) {
    IntegratorSettings s;
    s.method = method;
    s.rtol = s.atol = s.stiff_tolerance = tolerance;
    s.end_time = end_time;
    s.max_step = s.stiff_max_step = 10;
    s.fixed_step = 1e-3;
    return s;
}

/// Fractions that spread evenly over (0, 1).
double spread(std::size_t i) { return std::fmod(static_cast<double>(i + 1) * 0.6180339887498949, 1.0); }

bool same_member(ModelResult const& a, std::size_t i, ModelResult const& b, std::size_t j, std::size_t size) {
    auto const &x = a.records[i], &y = b.records[j];
    return x.status == y.status && x.steps_accepted == y.steps_accepted && x.steps_rejected == y.steps_rejected &&
           x.rhs_evaluations == y.rhs_evaluations && x.stiff_steps == y.stiff_steps &&
           std::memcmp(&a.states[i * size], &b.states[j * size], size * sizeof(double)) == 0;
}

class Lanes : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
};

TEST_P(Lanes, MembersWhoseCostsDifferAThousandfoldAreAsIfAlone) {
    // A cycle takes the same number of steps at any frequency; a state that is NaN costs nothing at all.
    std::vector<OscillatorInputs> members;
    for (std::size_t i = 0; i < 40; ++i) {
        members.push_back({.frequency = std::pow(10, 3 * spread(i)), .x = i % 7 == 3 ? follows : 1});
    }
    for (auto const method : {Method::dopri5, Method::ros34pw2}) {
        auto const s = settings_of(method, 3.0, 1e-4);
        auto const together = testing::run(GetParam(), s, members);
        std::uint64_t least = ~std::uint64_t{0}, most = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_TRUE(same_member(together, i, testing::run(GetParam(), s, std::vector{members[i]}), 0, 2)) << i;
            EXPECT_EQ(together.records[i].status, i % 7 == 3 ? Status::nonfinite : Status::finished);
            if (i % 7 == 3) continue;
            least = std::min(least, together.records[i].steps_accepted);
            most = std::max(most, together.records[i].steps_accepted);
        }
        EXPECT_GT(most, 400 * least) << "the members must differ";
    }
}

TEST_P(Lanes, OfManyLikeMembersHardlyIdle) {
    // Costs within 20 %; 512 members.
    std::vector<OscillatorInputs> members;
    for (std::size_t i = 0; i < 512; ++i) members.push_back({.frequency = 100 * (0.8 + 0.4 * spread(i))});
    for (auto const method : {Method::dopri5, Method::bs32, Method::ros34pw2}) {
        EXPECT_GE(testing::run(GetParam(), settings_of(method, 0.5), members).utilisation(), 0.98) << name_of(method);
    }
}

TEST_P(Lanes, OfMembersThatDifferTenfoldIdleLittle) {
    std::vector<OscillatorInputs> members;
    for (std::size_t i = 0; i < 512; ++i) members.push_back({.frequency = 20 * (1 + 9 * spread(i))});
    for (auto const method : {Method::dopri5, Method::bs32, Method::ros34pw2}) {
        EXPECT_GE(testing::run(GetParam(), settings_of(method, 0.5), members).utilisation(), 0.90) << name_of(method);
    }
}

TEST_P(Lanes, CountOnlyAttemptsThatServeAMemberAsUseful) {
    std::vector<OscillatorInputs> members;
    for (std::size_t i = 0; i < 21; ++i) members.push_back({.frequency = 3 + 20 * spread(i)});
    auto const r = testing::run(GetParam(), settings_of(Method::dopri5, 2.0), members);
    std::uint64_t tried = 0;
    for (auto const& record : r.records) tried += record.steps_accepted + record.steps_rejected;
    EXPECT_EQ(r.lane_steps_useful, tried);
    EXPECT_EQ(r.lane_steps_executed % static_cast<std::uint64_t>(lanes_of(GetParam())), 0u);
}

TEST_P(Lanes, EventsOfOneLaneAreNotThoseOfItsNeighbours) {
    // Side by side in a pack: balls that land at the same instant, at other times, twice, never, and rest on the floor at the start.
    std::vector<BallInputs> members;
    for (std::size_t i = 0; i < 48; ++i) {
        double const height = i % 3 == 0 ? 1 : 0.2 + spread(i);
        members.push_back({.height = height, .speed = i % 5 == 0 ? 2.0 : -0.5, .restitution = 0.5 + 0.4 * spread(i),
                           .level = i % 4 == 0 ? 0.7 : 1e6});
        if (i % 11 == 5) members.back().gravity = -1;
        if (i % 13 == 6) members.back().height = 0;
    }
    auto s = testing::equal_steps(Method::dopri5, 0.4, 1.0);
    s.max_steps = 200;  // some come to rest, after bounces without end
    auto const together = testing::run(GetParam(), s, members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        auto const alone = testing::run(GetParam(), s, std::vector{members[i]});
        ASSERT_TRUE(same_member(together, i, alone, 0, 2)) << i;
        auto const a = testing::ball_events(together, i), b = testing::ball_events(alone, 0);
        ASSERT_EQ(a.size(), b.size()) << i;
        for (std::size_t e = 0; e < a.size(); ++e) {
            EXPECT_EQ(a[e].kind, b[e].kind) << i;
            EXPECT_EQ(a[e].time, b[e].time) << i;
            EXPECT_EQ(a[e].height, b[e].height) << i;
            EXPECT_EQ(a[e].speed, b[e].speed) << i;
        }
    }
    // Members 0 and 15 differ in restitution and level alone: they land together.
    auto const landing = [&](std::size_t member) {
        auto const events = testing::ball_events(together, member);
        auto const first = std::find_if(events.begin(), events.end(), [](auto const& e) { return e.kind == testing::BallEvent::impact; });
        return first == events.end() ? -1 : first->time;
    };
    EXPECT_NEAR(landing(0), (2 + std::sqrt(24.0)) / 10, 1e-14);
    EXPECT_EQ(landing(0), landing(15));
}

TEST_P(Lanes, AutoSwitchesEveryMemberByItsOwnRate) {
    std::vector<TrackerInputs> members;
    for (std::size_t i = 0; i < 40; ++i) members.push_back({.rate = i % 2 == 0 ? -1.0 : -1e6});
    auto s = settings_of(Method::automatic, 2.0, 1e-5);
    s.max_step = s.stiff_max_step = 0.1;
    auto const r = testing::run(GetParam(), s, members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_EQ(r.records[i].status, Status::finished);
        EXPECT_NEAR(r.states[2 * i], std::sin(2.0), 1e-4);
        EXPECT_LT(r.records[i].rhs_evaluations, 500u) << "an explicit method takes a million";
        EXPECT_EQ(r.records[i].stiff_steps > 0, i % 2 == 1) << i;
        EXPECT_TRUE(same_member(r, i, testing::run(GetParam(), s, std::vector{members[i]}), 0, 2)) << i;
    }
}

TEST_P(Lanes, EndAtTheStepLimitInEveryMethod) {
    for (auto const method : {Method::automatic, Method::dopri5, Method::bs32, Method::ros34pw2, Method::rk4}) {
        auto s = settings_of(method, 5.0);
        s.max_steps = 57;
        s.fixed_step = 1e-2;
        auto const r = testing::run(GetParam(), s, std::vector<OscillatorInputs>(11, {.frequency = 500}));
        for (auto const& record : r.records) {
            EXPECT_EQ(record.status, Status::max_steps) << name_of(method);
            EXPECT_EQ(record.steps_accepted + record.steps_rejected, 57u) << name_of(method);
            EXPECT_LT(record.time, 5.0);
        }
    }
}

TEST_P(Lanes, AModelWithoutLinearisationIsLeftToTheExplicitPair) {
    auto const stiff = testing::run(GetParam(), settings_of(Method::ros34pw2, 1.0), std::vector<BallInputs>(3));
    auto const pair = testing::run(GetParam(), settings_of(Method::dopri5, 1.0), std::vector<BallInputs>(3));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_member(stiff, i, pair, i, 2));
}

TEST_P(Lanes, OfNobodyDoNothing) {
    auto const r = testing::run(GetParam(), settings_of(Method::automatic, 1.0), std::vector<OscillatorInputs>{});
    EXPECT_EQ(r.lane_steps_executed, 0u);
}

INSTANTIATE_TEST_SUITE_P(Isas, Lanes, ::testing::ValuesIn(built_isas()),
                         [](auto const& info) { return std::string(name_of(info.param)); });

}  // namespace
}  // namespace slideway::lanes_test
