// Events inside the steps, against the algebra of a ball over a floor.  Its cubic is exact for every method, so that steps are as
// long as they may be, and what a time is off by is the search's own error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/models/models.hpp"

namespace slideway::event_search_test {
namespace {

using testing::BallEvent;
using testing::BallInputs;

constexpr Isa isa = Isa::scalar;
constexpr Method explicit_methods[] = {Method::dopri5, Method::bs32, Method::rk4};

class EventSearch : public ::testing::Test {
protected:
    void SetUp() override {
        if (!is_supported(isa)) GTEST_SKIP() << "this machine has no fused multiply-add";
    }
};

std::vector<BallEvent> events_of(BallInputs const& in, Method method, double step, double end) {
    auto const r = testing::run(isa, testing::equal_steps(method, step, end), std::vector{in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return testing::ball_events(r, 0);
}

/// Events by algebra: from (0, x, v) over a floor with restitution e, in order, up to the end time.
std::vector<BallEvent> algebra(BallInputs const& in, double end) {
    std::vector<BallEvent> events;
    double const g = in.gravity, l = in.level;
    double t = 0, x = in.height, v = in.speed;
    for (int bounce = 0; bounce < 200; ++bounce) {
        double const down = std::sqrt(v * v + 2 * g * x), flight = (v + down) / g;
        std::vector<BallEvent> arc;
        if (v > 0) arc.push_back({BallEvent::apex, t + v / g, x + v * v / (2 * g), 0});
        double const above = v * v + 2 * g * (x - l);
        if (above > 0 && l > 0) {
            double const root = std::sqrt(above);
            if (x < l) arc.push_back({BallEvent::level, t + (v - root) / g, l, root});
            arc.push_back({BallEvent::level, t + (v + root) / g, l, -root});
        }
        arc.push_back({BallEvent::impact, t + flight, 0, -down});
        std::sort(arc.begin(), arc.end(), [](auto const& a, auto const& b) { return a.time < b.time; });
        for (auto const& event : arc) {
            if (event.time > end) return events;
            events.push_back(event);
        }
        t += flight, x = 0, v = in.restitution * down;
    }
    return events;
}

void expect_same(std::vector<BallEvent> const& got, std::vector<BallEvent> want, double slack) {
    want.resize(std::min<std::size_t>(want.size(), testing::recorded_ball_events));
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t i = 0; i < want.size(); ++i) {
        EXPECT_EQ(got[i].kind, want[i].kind) << i;
        EXPECT_NEAR(got[i].time, want[i].time, slack) << i;
        EXPECT_NEAR(got[i].height, want[i].height, slack) << i;
        EXPECT_NEAR(got[i].speed, want[i].speed, slack) << i;
    }
}

TEST_F(EventSearch, BallFollowsTheGeometricSeries) {
    // From height 1 with e = 0.8 all bounces end at t = 9 √(2/g) = 4.02 s; at 4 s twenty impacts and apices are over.  A start at rest
    // would count as an apex.
    BallInputs const in{.speed = -1e-300};
    double const first = std::sqrt(0.2), impact_speed = std::sqrt(20.0);
    for (auto const method : explicit_methods) {
        for (double const step : {0.013, 0.1, 0.8}) {
            auto const events = events_of(in, method, step, 4.0);
            ASSERT_EQ(events.size(), static_cast<std::size_t>(testing::recorded_ball_events)) << name_of(method);
            for (std::size_t n = 0; 2 * n < events.size(); ++n) {
                auto const &impact = events[2 * n], &apex = events[2 * n + 1];
                double const power = std::pow(0.8, n);
                // t_n = t_0 (1 + 2 (e + … + eⁿ))
                EXPECT_EQ(impact.kind, BallEvent::impact);
                EXPECT_NEAR(impact.time, first * (1 + 2 * 0.8 * (1 - power) / 0.2), 1e-12) << n;
                EXPECT_NEAR(impact.speed, -impact_speed * power, 1e-12) << n;
                EXPECT_NEAR(impact.height, 0, 1e-14) << n;
                EXPECT_EQ(apex.kind, BallEvent::apex);
                EXPECT_NEAR(apex.time, impact.time + 0.8 * power * first, 1e-12) << n;
                EXPECT_NEAR(apex.height, std::pow(0.64, n + 1), 1e-12) << n;
            }
        }
    }
}

TEST_F(EventSearch, FindsBothZerosOfOneFunctionInOneStep) {
    // Up through the level and down again, within a step that holds the whole flight.
    for (double const top : {0.3, 1e-3, 1e-6, 1e-9}) {
        BallInputs const in{.height = 1, .speed = 4, .level = 1.8 - top};  // the apex is at 1.8
        auto const events = events_of(in, Method::dopri5, 10.0, 0.9);
        SCOPED_TRACE(top);
        // Where the ball grazes, times have but half the digits of heights.
        expect_same(events, algebra(in, 0.9), 1e-14 + 1e-15 / std::sqrt(top));
        EXPECT_EQ(events.size(), 3u);
    }
}

TEST_F(EventSearch, GrazingIsAPairOfTouchesOrNone) {
    for (double const beyond : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) {
        BallInputs const in{.height = 1, .speed = 4, .level = 1.8 - beyond};
        for (double const step : {0.05, 0.17, 10.0}) {
            auto const events = events_of(in, Method::dopri5, step, 0.9);
            std::size_t touches = 0, apices = 0;
            for (auto const& event : events) {
                ++(event.kind == BallEvent::level ? touches : apices);
                EXPECT_NEAR(event.time, 0.4, 1e-4) << beyond;
            }
            EXPECT_EQ(apices, 1u);
            EXPECT_TRUE(touches == 0 || touches == 2) << beyond << " in steps of " << step << ": " << touches;
            if (beyond <= -1e-12) {
                EXPECT_EQ(touches, 0u) << beyond << " in steps of " << step;
            }
            if (beyond >= 1e-12) {
                EXPECT_EQ(touches, 2u) << beyond << " in steps of " << step;
            }
        }
    }
}

TEST_F(EventSearch, GrazingTheFloorIsAnImpactOrNone) {
    // Thrown up from below in reverse gravity: the lowest point of the arc is at height `gap`.
    for (double const gap : {1e-3, 1e-12, 0.0, -1e-12, -1e-3}) {
        BallInputs const in{.height = 0.5 + gap, .speed = -std::sqrt(10.0), .gravity = -10, .restitution = 0.5};
        for (double const step : {0.07, 10.0}) {
            auto const r = testing::run(isa, testing::equal_steps(Method::dopri5, step, 0.5), std::vector{in});
            auto const events = testing::ball_events(r, 0);
            auto const impacts =
                std::count_if(events.begin(), events.end(), [](auto const& e) { return e.kind == BallEvent::impact; });
            if (gap > 0) {
                EXPECT_EQ(impacts, 0) << gap;
            } else if (gap < 0) {
                EXPECT_EQ(impacts, 1) << gap;
            } else {
                EXPECT_LE(impacts, 1);
            }
            // x = −5 + v t + 5 t² for a miss or the softest of touches.
            if (std::abs(gap) < 1e-6) {
                EXPECT_NEAR(r.states[0], 0.5 - std::sqrt(10.0) * 0.5 + 1.25, 1e-5) << gap;
            }
            EXPECT_GE(r.states[0], 0);
        }
    }
}

TEST_F(EventSearch, OrdersDifferentEventsOfOneStep) {
    for (auto const method : explicit_methods) {
        for (double const level : {0.2, 0.9, 1.1, 1.7}) {
            BallInputs const in{.height = 1, .speed = 4, .level = level};
            SCOPED_TRACE(level);
            expect_same(events_of(in, method, 10.0, 3.0), algebra(in, 3.0), 1e-12);
        }
    }
}

/// A ball that moves on x = offset + scale (t − a)(t − b)(t − c), without impacts.
BallInputs on_cubic(double scale, double a, double b, double c, double offset) {
    return {.height = offset - scale * a * b * c,
            .speed = scale * (a * b + a * c + b * c),
            .gravity = 2 * scale * (a + b + c),
            .jerk = 6 * scale};
}

TEST_F(EventSearch, FindsAPairThatTheEndsOfTheStepDoNotShow) {
    // Both ends of the step [0, 1] rise, away from the level and towards it.
    for (auto const& [a, b, c] : {std::array{-0.05, 0.3, 0.35}, {0.6, 0.65, 1.1}}) {
        for (auto const method : explicit_methods) {
            auto in = on_cubic(6, a, b, c, 50);
            in.level = 50;
            auto const events = events_of(in, method, 1.0, 1.0);
            std::vector<double> times;
            for (auto const& event : events) {
                if (event.kind == BallEvent::level) times.push_back(event.time);
            }
            std::vector<double> want;
            for (double const zero : {a, b, c}) {
                if (zero > 0 && zero < 1) want.push_back(zero);
            }
            ASSERT_EQ(times.size(), want.size()) << name_of(method) << ' ' << a;
            for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(times[i], want[i], 1e-11) << name_of(method);
        }
    }
}

TEST_F(EventSearch, ADipBelowTheFloorIsAnImpact) {
    // Up, then below the floor and out again within one step: the floor is met at 0.3 s and not left behind.
    auto in = on_cubic(6, -0.05, 0.3, 0.35, 0);
    for (auto const method : explicit_methods) {
        auto const events = events_of(in, method, 1.0, 1.0);
        auto const impact = std::ranges::find(events, BallEvent::impact, &BallEvent::kind);
        ASSERT_NE(impact, events.end()) << name_of(method);
        EXPECT_NEAR(impact->time, 0.3, 1e-12);
        EXPECT_NEAR(impact->speed, 6 * 0.35 * -0.05, 1e-12);
    }
}

TEST_F(EventSearch, SimultaneousEventsAreAllFound) {
    // The level is the floor: a crossing that the impact ends.
    BallInputs const in{.speed = -1e-300, .level = 0};
    for (auto const method : explicit_methods) {
        auto const events = events_of(in, method, 0.1, 1.0);
        ASSERT_EQ(events.size(), 3u) << name_of(method);
        EXPECT_EQ(events[0].kind, BallEvent::level);
        EXPECT_EQ(events[1].kind, BallEvent::impact);
        EXPECT_EQ(events[2].kind, BallEvent::apex);
        EXPECT_EQ(events[0].time, events[1].time);
    }
}

TEST_F(EventSearch, AnEventAtTheStartIsFoundOnce) {
    // On the floor and falling: the impact is now.
    BallInputs in{.height = 0, .speed = -2};
    auto events = events_of(in, Method::dopri5, 0.05, 0.3);
    expect_same(events, {{BallEvent::impact, 0, 0, -2}, {BallEvent::apex, 0.16, 0.128, 0}}, 1e-14);
    // On the floor and rising: it is not.
    in.speed = 2;
    events = events_of(in, Method::dopri5, 0.05, 0.3);
    expect_same(events, {{BallEvent::apex, 0.2, 0.2, 0}}, 1e-14);
    // On the level: a fall begins there, a rise has passed it.
    in = {.height = 1, .speed = -1, .level = 1};
    EXPECT_EQ(events_of(in, Method::dopri5, 0.05, 0.2).size(), 1u);
    in.speed = 1;
    expect_same(events_of(in, Method::dopri5, 0.05, 0.3),
                {{BallEvent::apex, 0.1, 1.05, 0}, {BallEvent::level, 0.2, 1, -1}}, 1e-14);
    // Through the level, and back up within the step or at its very end.
    in = {.height = 1, .speed = -1, .gravity = -8, .level = 1};
    for (double const step : {0.25, 0.3}) {
        expect_same(events_of(in, Method::rk4, step, 0.3),
                    {{BallEvent::level, 0, 1, -1}, {BallEvent::level, 0.25, 1, 1}}, 1e-14);
    }
}

TEST_F(EventSearch, EventsOnTheBordersOfStepsAreFoundOnce) {
    // In steps of 1/64 s at g = 8 the apex, at 1/8 s, and the return to the height of the start, at 1/4 s, are on borders, give or
    // take a rounding.
    for (double const shift : {-1e-15, -2e-16, 0.0, 2e-16, 1e-15}) {
        BallInputs const in{.height = 1, .speed = 1 + shift, .gravity = 8, .level = 1};
        expect_same(events_of(in, Method::rk4, 1.0 / 64, 0.3),
                    {{BallEvent::apex, 0.125, 1.0625, 0}, {BallEvent::level, 0.25, 1, -1}}, 1e-14);
    }
}

TEST_F(EventSearch, SamplesBeforeAnImpactAreThoseOfTheFlightThatItEnds) {
    BallInputs const in;
    std::vector<double> times;
    for (int i = 0; i <= 100; ++i) times.push_back(0.01 * i);
    for (auto const method : explicit_methods) {
        for (double const step : {0.03, 0.2, 2.0}) {
            auto const r = testing::run(isa, testing::equal_steps(method, step, 1.0), std::vector{in}, times);
            for (std::size_t i = 0; i < times.size(); ++i) {
                // Falls for √0.2 s, rises at 0.8 √20.
                double const t = times[i], s = t - std::sqrt(0.2);
                double const x = s < 0 ? 1 - 5 * t * t : s * (0.8 * std::sqrt(20.0) - 5 * s);
                double const v = s < 0 ? -10 * t : 0.8 * std::sqrt(20.0) - 10 * s;
                EXPECT_NEAR(r.series[i], x, 1e-12) << name_of(method) << " step " << step << " at " << t;
                EXPECT_NEAR(r.series[times.size() + i], v, 1e-12) << name_of(method) << " step " << step << " at " << t;
            }
        }
    }
}

TEST_F(EventSearch, AMotionThatBeginsInsideAStepIsNoFall) {
    // The valve rests on its seat until the pressure lifts it, some time within a step: hundreds of times before it has made its events.
    IntegratorSettings settings;
    settings.method = Method::dopri5;
    settings.rtol = settings.atol = 1e-9;
    settings.end_time = 1e5;
    settings.max_step = 0.5;
    std::vector<testing::ValveInputs> const valves{{.inflow = 0.2}, {.inflow = 0.25}};
    auto const r = testing::run(isa, settings, valves);
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::finished);
        EXPECT_GT(record.time, 500);
    }
}

TEST_F(EventSearch, BouncesThatPileUpEndTheMember) {
    // All bounces end at 9 √0.2 = 4.02 s, beyond which the ball knows no motion.
    for (Isa const any_isa : all_isas()) {
        if (!is_supported(any_isa)) continue;
        for (auto const method : explicit_methods) {
            auto const settings = testing::equal_steps(method, 0.1, 5.0);  // up to 1e8 steps
            auto const r = testing::run(any_isa, settings, std::vector<BallInputs>(11));
            for (std::size_t i = 0; i < r.records.size(); ++i) {
                EXPECT_EQ(r.records[i].status, Status::step_too_small);
                EXPECT_NEAR(r.records[i].time, 9 * std::sqrt(0.2), 1e-8);
                EXPECT_LT(r.records[i].steps_accepted, 400u);
                EXPECT_NEAR(r.states[2 * i], 0, 1e-12) << "and stays on the floor";
            }
        }
    }
}

TEST_F(EventSearch, AResetThatBringsItsEventAboutAgainEndsTheMember) {
    // Without restitution the ball lies on the floor and falls through it at once.
    auto const r =
        testing::run(isa, testing::equal_steps(Method::dopri5, 0.1, 5.0), std::vector{BallInputs{.restitution = 0}});
    EXPECT_EQ(r.records[0].status, Status::step_too_small);
    EXPECT_NEAR(r.records[0].time, std::sqrt(0.2), 1e-5);
}

TEST_F(EventSearch, BouncesThatPileUpSpendTheStepsOfTheMemberAtMost) {
    auto settings = testing::equal_steps(Method::dopri5, 0.1, 5.0);
    settings.max_steps = 100;
    auto const r = testing::run(isa, settings, std::vector{BallInputs{}});
    EXPECT_EQ(r.records[0].status, Status::max_steps);
    EXPECT_EQ(r.records[0].steps_accepted + r.records[0].steps_rejected, 100u);
}

}  // namespace
}  // namespace slideway::event_search_test
