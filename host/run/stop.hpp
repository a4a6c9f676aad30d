// Ending a run early: by a signal, or when its time is up.
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <iterator>

#include "host/base/process.hpp"

namespace slideway {

enum class StopReason { none, signal, time_limit };

/// Asked before each block is handed out, and now and then by the blocks in work.
class StopRequest {
public:
    /// Safe in a signal handler.
    void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
    /// Call before the run starts.
    void stop_after(std::chrono::duration<double> limit);
    /// A flag of somebody else's, which asks to stop once it is true; nullptr: none.  Call before the run starts.
    void watch(std::atomic<bool> const* flag) { flag_ = flag; }
    StopReason reason() const noexcept;

private:
    using Clock = std::chrono::steady_clock;
    std::atomic<bool> requested_ = false;
    std::atomic<bool> const* flag_ = nullptr;
    Clock::time_point deadline_ = Clock::time_point::max();
    static_assert(std::atomic<bool>::is_always_lock_free);
};

/// Of who asks for nothing.
inline StopRequest const never_stops;

/// While it lives, each of `stop_signals` becomes a request, but for those that are ignored already; a second one ends the process as usual,
/// where its senders do not repeat it.  At most one at a time.
class SignalScope {
public:
    explicit SignalScope(StopRequest& stop);
    ~SignalScope();
    SignalScope(SignalScope const&) = delete;
    SignalScope& operator=(SignalScope const&) = delete;

private:
    struct sigaction former_[std::size(stop_signals)];
};

/// Wall time [s].
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace slideway
