// What is said of made-up histories.
#include "host/run/progress.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace slideway::time_left_test {
namespace {

constexpr double tick = 0.25;

/// After `seconds` of work at a rate, which hangs on the time.
template <class Rate> TimeLeft after(double seconds, Rate const& rate, double* done = nullptr) {
    TimeLeft history;
    double work = 0;
    for (double t = tick; t <= seconds + tick / 2; t += tick) {
        work += rate(t - tick / 2) * tick;
        history.note(t, work);
    }
    if (done != nullptr) *done = work;
    return history;
}

TEST(TimeLeft, IsUnknownBeforeAnythingIsDone) {
    EXPECT_TRUE(std::isnan(TimeLeft().seconds(10)));
    EXPECT_TRUE(std::isnan(after(60, [](double) { return 0; }).seconds(10)));
    EXPECT_EQ(TimeLeft().seconds(0), 0);
}

TEST(TimeLeft, IsExactWhereTheRateIsConstant) {
    for (double const seconds : {0.25, 1.0, 7.25, 100.0, 4000.0}) {
        EXPECT_NEAR(after(seconds, [](double) { return 3; }).seconds(60), 20, 1e-9) << seconds;
    }
}

TEST(TimeLeft, FollowsARateThatChanges) {
    // A tenth of the rate from 20 s on: at 40 s the later half of the time knows nothing else, and says 1000 s for 100; all of it says 182 s.
    TimeLeft const slower = after(40, [](double t) { return t < 20 ? 1 : 0.1; });
    EXPECT_NEAR(slower.seconds(100), (1000 + 100 * 40 / 22.) / 2, 10);
    // Ten times the rate: 10 s, and 18 s.
    TimeLeft const faster = after(40, [](double t) { return t < 20 ? 1 : 10; });
    EXPECT_NEAR(faster.seconds(100), (10 + 100 * 40 / 220.) / 2, 0.2);
}

TEST(TimeLeft, DoesNotJumpWhereWorkEndsInPieces) {
    // Ten pieces of 10 units, 8 s each, of 200 units: between two of them the word rises and falls by less than half.
    TimeLeft history;
    double done = 0, least = 1e9, most = 0;
    for (double t = tick; t <= 80; t += tick) {
        if (std::fmod(t, 8) == 0) done += 10;
        history.note(t, done);
        double const end = t + history.seconds(200 - done);
        if (t < 40) continue;
        least = std::min(least, end);
        most = std::max(most, end);
    }
    EXPECT_GT(least, 160 * 0.85);
    EXPECT_LT(most, 160 * 1.3);
}

TEST(TimeLeft, GoesOnWhereWorkPauses) {
    double done = 0;
    TimeLeft const history = after(100, [](double t) { return t < 20 ? 5 : 0; }, &done);
    EXPECT_EQ(done, 100);
    EXPECT_NEAR(history.seconds(50), 50, 1e-9);  // nothing of late: 100 s for 100 units so far
}

}  // namespace
}  // namespace slideway::time_left_test
