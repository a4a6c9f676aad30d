#include "host/run/stop.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace slideway::stop_test {
namespace {

using std::chrono::duration;

TEST(StopRequest, HasNoReasonOfItsOwn) { EXPECT_EQ(StopRequest().reason(), StopReason::none); }

TEST(StopRequest, EndsAtItsTimeLimit) {
    StopRequest now, later, never;
    now.stop_after(duration<double>(0));
    later.stop_after(duration<double>(1e6));
    never.stop_after(duration<double>(std::numeric_limits<double>::infinity()));
    EXPECT_EQ(now.reason(), StopReason::time_limit);
    EXPECT_EQ(later.reason(), StopReason::none);
    EXPECT_EQ(never.reason(), StopReason::none);
}

TEST(SignalScope, TurnsTheFirstSignalIntoARequest) {
    for (int const signal : {SIGINT, SIGTERM}) {
        StopRequest stop;
        SignalScope const scope(stop);
        std::raise(signal);
        EXPECT_EQ(stop.reason(), StopReason::signal);
    }
}

TEST(SignalScopeDeathTest, LetsASecondSignalEndTheProcess) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            StopRequest stop;
            SignalScope const scope(stop);
            std::raise(SIGINT);
            std::raise(SIGINT);
        },
        ::testing::KilledBySignal(SIGINT), "");
}

TEST(SignalScope, GivesTheFormerHandlerBack) {
    static volatile std::sig_atomic_t seen = 0;
    auto* const before = std::signal(SIGTERM, [](int) { seen = 1; });
    {
        StopRequest stop;
        SignalScope const scope(stop);
    }
    std::raise(SIGTERM);
    std::signal(SIGTERM, before);
    EXPECT_EQ(seen, 1);
}

}  // namespace
}  // namespace slideway::stop_test
