// How far a run has come, on stderr.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

#include "host/run/stop.hpp"

namespace slideway {

/// ` 37.5 %  384 of 1024 members  12.3 members/s  ETA 0:52`.  The ETA is the rate so far carried on.
/// @param before of `done`, those done before the clock started.
std::string progress_line(std::uint64_t done, std::uint64_t members, double seconds, std::uint64_t before = 0);

/// Writes from a thread of its own: a line redrawn four times a second on a terminal, else a line every ten seconds.
class Progress {
public:
    enum class Style { none, lines, terminal };
    /// terminal if `out` is one, lines if not, none if quiet.
    static Style style_for(std::FILE* out, bool quiet);

    /// @param before members that were done before the start: they count, but not towards the rate.
    Progress(std::uint64_t members, std::uint64_t before, Style style, std::FILE* out, StopRequest const& stop);
    ~Progress();
    Progress(Progress const&) = delete;
    Progress& operator=(Progress const&) = delete;

    /// From any thread.
    void add(std::uint64_t members) noexcept { done_.fetch_add(members, std::memory_order_relaxed); }

private:
    void report();
    void print_line();
    void tell(std::string const& text);

    std::uint64_t const members_, before_;
    Style const style_;
    std::FILE* const out_;
    StopRequest const& stop_;
    std::chrono::steady_clock::time_point const start_ = std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> done_ = 0;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    std::thread reporter_;
};

}  // namespace slideway
