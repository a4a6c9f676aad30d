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

// By their names, not by the program's own list.
constexpr int signals_of_schedulers[] = {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM};

TEST(SignalScope, TurnsTheFirstSignalIntoARequest) {
    for (int const signal : signals_of_schedulers) {
        StopRequest stop;
        SignalScope const scope(stop);
        std::raise(signal);
        EXPECT_EQ(stop.reason(), StopReason::signal) << signal;
    }
}

/// The kernel sends XCPU every second, and a terminal that closes HUP twice.
TEST(SignalScope, BearsSignalsThatTheirSendersRepeat) {
    for (int const signal : {SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM}) {
        StopRequest stop;
        SignalScope const scope(stop);
        std::raise(signal);
        std::raise(signal);
        EXPECT_EQ(stop.reason(), StopReason::signal) << signal;
    }
}

TEST(SignalScope, LeavesIgnoredWhatIsIgnored) {
    for (int const signal : signals_of_schedulers) {
        auto* const before = std::signal(signal, SIG_IGN);
        {
            StopRequest stop;
            SignalScope const scope(stop);
            std::raise(signal);
            EXPECT_EQ(stop.reason(), StopReason::none) << signal;
        }
        EXPECT_EQ(std::signal(signal, before), SIG_IGN) << signal;
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
    for (int const signal : signals_of_schedulers) {
        seen = 0;
        auto* const before = std::signal(signal, [](int) { seen = 1; });
        {
            StopRequest stop;
            SignalScope const scope(stop);
        }
        std::raise(signal);
        std::signal(signal, before);
        EXPECT_EQ(seen, 1) << signal;
    }
}

}  // namespace
}  // namespace slideway::stop_test
