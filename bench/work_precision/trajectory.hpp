// What every peer is asked for: one member, from its start to the end time.
#pragma once

#include <array>

#include "bench/work_precision/method.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct Limits {
    double end_time, max_step, tolerance;
    bool audited;
    bench::Clock::time_point deadline;
};

template <class System> struct Trajectory {
    bool finished = false;
    std::array<double, System::size + System::audits> end;  // the audit's integrals behind the state
};

}  // namespace slideway::inline SLIDEWAY_ISA
