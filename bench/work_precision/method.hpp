// What is measured: methods that take a whole ensemble to its end time.
#pragma once

#include <time.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/work_precision/problem.hpp"

namespace slideway::bench {

/// Time that this thread has spent computing: other work on the machine counts neither in what is reported nor against a budget.
struct Clock {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<Clock>;
    static constexpr bool is_steady = true;

    static time_point now() {
        timespec t;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return time_point(std::chrono::seconds(t.tv_sec) + duration(t.tv_nsec));
    }
    /// The time at which a budget [s] that begins now is spent.
    static time_point after(double seconds) {
        return now() + std::chrono::duration_cast<duration>(std::chrono::duration<double>(seconds));
    }
};

/// @tparam C a clock  @return [s]
template <class C> double seconds_between(std::chrono::time_point<C> start, std::chrono::time_point<C> end) {
    return std::chrono::duration<double>(end - start).count();
}

/// Integrals of the energy audit from 0 to the end time [J], and what they leave of the change of energy.
struct Audit {
    double work = 0, friction_loss = 0, damping_loss = 0, residual = 0;
};

struct MemberOutcome {
    bool finished = false;
    std::vector<double> state;      // at the end time; Measure::extrema: the recorded ones
    Audit audit;                    // Measure::energy alone
    std::uint64_t evaluations = 0;  // of the right-hand side; an analytic Jacobian counts as one
};

/// One ensemble, or as many of its members as the time allowed.
struct Outcome {
    std::vector<MemberOutcome> members;
    double seconds_per_member = 0;
};

/// Time allowed for one outcome.  Methods end a member in work at the limit and leave out those not begun.
struct Task {
    Problem const& problem;
    double tolerance = 0;
    std::size_t members = 0;  // the leading ones of the problem
    double budget = 1e9;      // [s] of this thread
};

struct Method {
    std::string name;
    std::string code;  // instruction set, or library, that runs it
    bool ours = false;
    std::function<bool(Problem const&)> solves;
    std::function<Outcome(Task const&)> solve;
};

/// slideway's methods, each on the widest packs of this machine, on those of most others, and on one member at a time.
std::vector<Method> our_methods();
/// What users would take instead, one trajectory at a time on the same right-hand side.
std::vector<Method> peer_methods();
/// The one that locates the relief valve's events.
Method valve_peer();

}  // namespace slideway::bench
