// Where steps end at what pairs in rigid joints do: where they meet, come to rest along the way, or begin to slip (model.md 13).
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/rigid/rigid_watch.hpp"

namespace slideway::rigid_watch_test {
namespace {

constexpr double step = 2e-3, located = 1e-14;

/// Apices of the joint, of which the first of the second face is looked at; all others are far away.
struct Apices {
    Quad<double> watched[face_count], rate[face_count], slip[2][face_count], slides[face_count];

    Apices() {
        for (int face = 0; face < face_count; ++face) {
            watched[face] = {-1, -1, -1, -1};
            rate[face] = slip[0][face] = slip[1][face] = slides[face] = {0, 0, 0, 0};
        }
    }
    Apices& at(double depth, double speed) { return watched[1].a = depth, rate[1].a = speed, *this; }
    Apices& slipping(double u, double v) { return slip[0][1].a = u, slip[1][1].a = v, slides[1].a = 1, *this; }
    Apices& sticking(double u, double v) { return slipping(u, v), slides[1].a = -1, *this; }
};

struct Found { double fraction, way_on; };
Found found(Apices const& start, Apices const& end) {
    JointWatch<double> watch;
    watch.keep(true, start);
    return {watch.earliest(true, end, step, located, Watching{}), watch.way_on(end, step, located)};
}

TEST(JointWatch, FindsWhereAnApexMeets) {
    // δ = −h + v t: at t = h/v; from the end of a step before it the rest of that.
    double const v = 0.1;
    EXPECT_NEAR(found(Apices().at(-0.25 * v * step, v), Apices().at(0.75 * v * step, v)).fraction, 0.25, 1e-12);
    auto const before = found(Apices().at(-3 * v * step, v), Apices().at(-2 * v * step, v));
    EXPECT_EQ(before.fraction, 1);
    EXPECT_NEAR(before.way_on, 2 * step, 1e-15);
}

TEST(JointWatch, FindsWhereSlipTurnsRound) {
    // The slip along what it was falls by a straight line from 5 to −3.
    auto const turned = found(Apices().slipping(3, 4), Apices().slipping(-1.8, -2.4));
    EXPECT_NEAR(turned.fraction, 5.0 / 8, 1e-8);
    // Across what it was it may be anything.
    EXPECT_EQ(found(Apices().slipping(3, 4), Apices().slipping(-4, 3.5)).fraction, 1);
    auto const slower = found(Apices().slipping(3, 4), Apices().slipping(2.4, 3.2));
    EXPECT_EQ(slower.fraction, 1);
    EXPECT_NEAR(slower.way_on, 4 * step, 1e-12);
}

TEST(JointWatch, FindsWhereAPairThatSticksBeginsToSlip) {
    // Held within `slip_again`: a half of it at the start, one and a half at the end.
    auto const of = [](double share) { return Apices().sticking(0.6 * share * slip_again, 0.8 * share * slip_again); };
    // Numbers below 0 count from a billionth on.
    EXPECT_NEAR(found(of(0), of(1.5)).fraction, 1 / 1.5, 2e-3);
    EXPECT_NEAR(found(of(0.5), of(1.5)).fraction, 0.5, 2e-3);
    EXPECT_EQ(found(of(0.2), of(0.9)).fraction, 1);
}

}  // namespace
}  // namespace slideway::rigid_watch_test
