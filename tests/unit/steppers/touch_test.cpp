// Where touches and mode changes are found inside a step, and what touches leave behind for the restitution.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/joint/contact_report.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::touch_test {
namespace {

using Watch = ContactWatch<double>;
using Memory = ContactMemory<double>;

constexpr double clearance = 1e-4;
constexpr double touch_tolerance = Watch::tolerance(Watching::touches), mode_tolerance = Watch::tolerance(Watching::modes);

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
    r.clear(false);
    for (auto const& p : pairs()) depth(r, p) = -clearance, rate(r, p) = 0;
    return r;
}

Memory memory_of(double speed) {
    Memory memory;
    start_memory(memory);
    for (auto& face : memory.impact_speed) face = {speed, speed, speed, speed};
    return memory;
}

TEST(Touches, FindsWhereAnyPairMeetsItsFace) {
    // δ(t) = −g + v t + b t²/2 is a parabola, which the cubic through both ends renders exactly.
    double const step = 2e-3, gap = 3e-5, v = 0.02, b = 10;
    double const touch = (std::sqrt(v * v + 2 * b * gap) - v) / b;
    for (auto const& p : pairs()) {
        Watch touches;
        auto start = apart(), end = apart();
        depth(start, p) = -gap, rate(start, p) = v;
        depth(end, p) = -gap + v * step + 0.5 * b * step * step, rate(end, p) = v + b * step;
        touches.keep(true, start);
        EXPECT_NEAR(touches.earliest(true, end, step, clearance * touch_tolerance, Watching::touches), touch / step,
                    1e-6)
            << p.face;
        EXPECT_EQ(touches.earliest(false, end, step, clearance * touch_tolerance, Watching::touches), 1.0)
            << "a rejected lane is not searched";
    }
}

TEST(Touches, TakesTheFirstOfSeveral) {
    auto const all = pairs();
    for (std::size_t i = 0; i < all.size(); ++i) {
        Watch touches;
        auto start = apart(), end = apart();
        // Straight lines: pair i meets its face at a quarter of the step, its neighbour in the list half way.
        auto const& other = all[(i + 1) % all.size()];
        depth(start, all[i]) = -1e-5, depth(end, all[i]) = 3e-5, rate(start, all[i]) = rate(end, all[i]) = 4e-5;
        depth(start, other) = -1e-5, depth(end, other) = 1e-5, rate(start, other) = rate(end, other) = 2e-5;
        touches.keep(true, start);
        EXPECT_NEAR(touches.earliest(true, end, 1.0, clearance * touch_tolerance, Watching::touches), 0.25, 1e-6);
    }
}

TEST(Touches, LeavesAStepThatEndsAtItsTouch) {
    Watch touches;
    auto end = apart();
    touches.keep(true, apart());
    auto const p = pairs()[5];
    rate(end, p) = 0.1;
    depth(end, p) = 0.9 * touch_tolerance * clearance;
    EXPECT_EQ(touches.earliest(true, end, 1e-3, clearance * touch_tolerance, Watching::touches), 1.0);
    depth(end, p) = 1.1 * touch_tolerance * clearance;
    EXPECT_LT(touches.earliest(true, end, 1e-3, clearance * touch_tolerance, Watching::touches), 1.0);
}

TEST(Touches, SetsTheSpeedOfThePairThatTouched) {
    for (auto const& touching : pairs()) {
        Watch touches;
        touches.keep(true, apart());
        auto end = apart();
        for (auto const& p : pairs()) rate(end, p) = 0.7;  // rates of pairs that do not touch are nobody's speed
        depth(end, touching) = 1e-13;
        rate(end, touching) = 0.3;
        auto memory = memory_of(0.05);
        EXPECT_FALSE(touches.update(false, end, memory, nullptr, Watching::touches)) << "a rejected step touches nothing";
        for (auto const& p : pairs()) EXPECT_EQ(memory.impact_speed[p.face].*p.apex, 0.05);
        EXPECT_TRUE(touches.update(true, end, memory, nullptr, Watching::touches));
        for (auto const& p : pairs()) {
            bool const same = p.face == touching.face && p.apex == touching.apex;
            EXPECT_EQ(memory.impact_speed[p.face].*p.apex, same ? 0.3 : 0.05);
        }
        rate(end, touching) = 0.9;
        EXPECT_FALSE(touches.update(true, end, memory, nullptr, Watching::touches)) << "what touches already does not touch again";
        EXPECT_EQ(memory.impact_speed[touching.face].*touching.apex, 0.3);
    }
}

TEST(Touches, NeverRemembersLessThanTheLeastSpeed) {
    Watch touches;
    touches.keep(true, apart());
    auto end = apart();
    for (auto const& p : pairs()) depth(end, p) = 1e-13, rate(end, p) = 1e-9;
    auto memory = memory_of(0.05);
    EXPECT_TRUE(touches.update(true, end, memory, nullptr, Watching::touches));
    for (auto const& p : pairs()) EXPECT_EQ(memory.impact_speed[p.face].*p.apex, least_impact_speed);
    EXPECT_EQ(least_impact_speed, 1e-4);
}

TEST(Touches, KeepsTheGapsOfTheLastAcceptedStep) {
    Watch touches;
    auto inside = apart();
    auto const p = pairs()[9];
    depth(inside, p) = 1e-9;
    touches.keep(true, inside);
    touches.keep(false, apart());
    auto memory = memory_of(0.05);
    EXPECT_FALSE(touches.update(true, inside, memory, nullptr, Watching::touches)) << "a lane that was not taken keeps its old gaps";
    touches.keep(true, apart());
    EXPECT_TRUE(touches.update(true, inside, memory, nullptr, Watching::touches));
}

/// The ends of a step of length 1 in which the depth of `p` follows scale (θ − a)(θ − b), an arch or a valley.
struct Arc {
    ContactReport<double> start = apart(), end = apart();
    Arc(Pair const& p, double scale, double a, double b) {
        depth(start, p) = scale * a * b, rate(start, p) = -scale * (a + b);
        depth(end, p) = scale * (1 - a) * (1 - b), rate(end, p) = scale * (2 - a - b);
    }
};

double earliest_touch(Arc const& arc, Watching watching = Watching::touches) {
    Watch touches;
    touches.keep(true, arc.start);
    return touches.earliest(true, arc.end, 1.0, clearance * touch_tolerance, watching);
}

double earliest_change(Arc const& arc) {
    Watch modes;
    Memory held;
    start_memory(held);
    modes.begin(true, arc.start, held, Watching::modes);
    return modes.earliest(true, arc.end, 1.0, clearance * mode_tolerance, Watching::modes);
}

TEST(ContactWatch, FindAPairThatMeetsAndLeavesItsFaceInOneStep) {
    for (auto const& p : pairs()) {
        // Down to the smallest arch that rises above what counts as located.
        for (double const width : {0.8, 0.3, 1e-2, 1e-3}) {
            Arc const arc(p, -clearance, 0.6 - 0.5 * width, 0.6 + 0.5 * width);
            EXPECT_NEAR(earliest_touch(arc), 0.6 - 0.5 * width, 1e-2 * width) << p.face << ' ' << width;
            EXPECT_NEAR(earliest_change(arc), 0.6 - 0.5 * width, 1e-4 * width) << p.face << ' ' << width;
        }
        Arc const below(p, -clearance, 1.2, 1.3);
        EXPECT_EQ(earliest_touch(below), 1.0);
        EXPECT_EQ(earliest_change(below), 1.0);
    }
}

TEST(ContactWatch, FindAPairThatPartsAndTouchesAgainInOneStep) {
    for (auto const& p : pairs()) {
        Arc const arc(p, clearance, 0.3, 0.8);
        EXPECT_NEAR(earliest_touch(arc), 0.3, 1e-6) << "the touch after it has a step of its own";
        EXPECT_NEAR(earliest_change(arc), 0.3, 1e-6);
        Arc const parts(p, clearance, 0.3, 1.8);
        EXPECT_EQ(earliest_touch(parts), 1.0) << "a parting alone is no touch";
        EXPECT_NEAR(earliest_touch(parts, Watching::touches_and_parts), 0.3, 1e-6);
        EXPECT_NEAR(earliest_change(parts), 0.3, 1e-6);
    }
}

TEST(ContactWatch, PlaceAChangeWithinTheirTolerance) {
    for (double const scale : {-1.0, 1.0}) {
        for (double const a : {1e-6, 1e-3, 0.1, 0.37, 0.9}) {
            for (double const width : {0.03, 0.7, 20.0}) {
                Arc const arc(pairs()[6], scale * clearance, a, a + width);
                // Past the zero, by less than what counts as located.
                double const change = earliest_change(arc), past = (change - a) * (a + width - change);
                EXPECT_GT(past, 0) << scale << ' ' << a << ' ' << width;
                EXPECT_LT(past, mode_tolerance) << scale << ' ' << a << ' ' << width;
            }
        }
    }
}

TEST(ContactWatch, LeaveAStepThatStartsOrEndsAtAChange) {
    for (auto const& p : pairs()) {
        for (double const hair : {1e-6, 0.5, 0.9}) {
            // Just turned over, and on its way: into the face, or away from it.
            Arc into(p, clearance, 0, -3.0), away(p, -clearance, 0, -3.0);
            depth(into.start, p) = hair * mode_tolerance * clearance;
            depth(away.start, p) = -depth(into.start, p);
            for (Arc const& arc : {into, away}) {
                EXPECT_EQ(earliest_touch(arc), 1.0) << p.face << ' ' << hair;
                EXPECT_EQ(earliest_change(arc), 1.0) << p.face << ' ' << hair;
            }
        }
        // The end within the tolerance of the change.
        for (double const left : {1e-3, 0.4, 0.9}) {
            Arc ends(p, -clearance, 1.0, 4.0);
            depth(ends.end, p) = left * mode_tolerance * clearance;
            EXPECT_EQ(earliest_touch(ends), 1.0) << left;
            EXPECT_EQ(earliest_change(ends), 1.0) << left;
        }
    }
}

/// A watch at the start of a step by a clock, and what it holds.
struct Impacts {
    Watch watch;
    Memory memory;
    explicit Impacts(ContactReport<double> const& start) {
        start_memory(memory);
        watch.begin(true, start, memory, Watching::clocks);
    }
    bool holds(Pair const& p) const { return memory.held[p.face].*p.apex == 1.0; }
};

TEST(ImpactWatch, GoesByTheShallowestPairThatTouches) {
    EXPECT_FALSE(Impacts(apart()).watch.clock(memory_of(0.05)).runs()) << "who flies has no clock";
    for (std::size_t deep = 0; deep < pairs().size(); ++deep) {
        std::size_t const shallow = (deep + 7) % pairs().size();
        auto start = apart();
        depth(start, pairs()[deep]) = 4e-8, rate(start, pairs()[deep]) = 0.3;
        depth(start, pairs()[shallow]) = 1e-8, rate(start, pairs()[shallow]) = -0.2;
        Impacts const impacts(start);
        auto const clock = impacts.watch.clock(impacts.memory);
        EXPECT_EQ(clock.pair, static_cast<double>(shallow));
        EXPECT_NEAR(clock.root, 1e-4, 1e-18);
        EXPECT_EQ(clock.rate, -0.2);
    }
}

TEST(ImpactWatch, LetsAPairGoOutThatHasPartedWithinItsFace) {
    for (std::size_t i = 0; i < pairs().size(); ++i) {
        auto const p = pairs()[i];
        auto report = apart();
        depth(report, p) = 1e-8, rate(report, p) = -0.1;
        Impacts impacts(report);
        ASSERT_TRUE(impacts.holds(p));
        // u has come to zero; by the error of the step the depth in the state has not.
        ClockedStep<double> const parting{1e-3, impacts.watch.clock(impacts.memory), {static_cast<double>(i), 1e-7, -0.1}, 0};
        depth(report, p) = 1e-13;
        EXPECT_TRUE(impacts.watch.update(true, report, impacts.memory, parting, false).lanes) << i;
        EXPECT_FALSE(impacts.holds(p)) << i;
        ClockedStep<double> const flight{5e-13, {-1, 0, 0}, {-1, 0, 0}, 0};
        depth(report, p) = 0.5e-13;
        double const located = 1e-15;
        EXPECT_EQ(impacts.watch.earliest(true, impacts.memory, report, flight, located), 1.0) << i << " was never out, and is on its way";
        EXPECT_FALSE(impacts.watch.update(true, report, impacts.memory, flight, false).lanes) << i << " still goes out";
        EXPECT_FALSE(impacts.holds(p)) << i;
        rate(report, p) = 0.1;
        depth(report, p) = 2e-13;
        EXPECT_LT(impacts.watch.earliest(true, impacts.memory, report, flight, located), 1.0) << i << " comes back";
        EXPECT_TRUE(impacts.watch.update(true, report, impacts.memory, flight, false).lanes) << i << " comes back";
        EXPECT_TRUE(impacts.holds(p)) << i;
    }
}

TEST(ImpactWatch, FindsTheTouchOfAnotherPairByTheClock) {
    // The other pair's depth is an arch over the clock's step; its rate in time is the slope over dt/ds = 2u.
    double const own = 0.02, u0 = 1e-4, u1 = 3e-4, touch = 0.3;
    for (std::size_t i = 0; i < pairs().size(); ++i) {
        Arc arc(pairs()[i], -clearance, touch, 1.4);
        rate(arc.start, pairs()[i]) /= own * 2 * u0;
        rate(arc.end, pairs()[i]) /= own * 2 * u1;
        double const other = static_cast<double>((i + 3) % pairs().size()), itself = static_cast<double>(i);
        auto const earliest = [&](double pair) {
            ClockedStep<double> const step{own, {pair, u0, 0.01}, {pair, u1, 0.01}, 0};
            Impacts const impacts(arc.start);
            return impacts.watch.earliest(true, impacts.memory, arc.end, step, 1e-9 * clearance);
        };
        EXPECT_NEAR(earliest(other), touch, 1e-6) << i;
        EXPECT_EQ(earliest(itself), 1.0) << "its own pair is the clock's affair";
    }
}

}  // namespace
}  // namespace slideway::touch_test
