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

using Clock = std::chrono::steady_clock;  // for limits and progress

inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Time that this thread has spent computing: what is reported, for other work on the machine does not count in it.
class ThreadTimer {
public:
    double seconds() const { return now() - start_; }

private:
    static double now() {
        timespec t;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    double start_ = now();
};

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
    double budget = 1e9;      // [s]
};

struct Method {
    std::string name;
    std::string code;  // instruction set, or library, that runs it
    bool ours = false;
    std::function<bool(Problem const&)> solves;
    std::function<Outcome(Task const&)> solve;
};

/// slideway's methods, each on one member at a time and on the widest packs of this machine.
std::vector<Method> our_methods();
/// What users would take instead, one trajectory at a time on the same right-hand side.
std::vector<Method> peer_methods();
/// The one that locates the relief valve's events.
Method valve_peer();

}  // namespace slideway::bench
