// What the benchmark of the relief valve asks of each instruction set.
#pragma once

#include <cstddef>

#include "kernels/block.hpp"

namespace slideway {

/// Relief valves with the engine's automatic steps, until each has recorded the events asked for (bench/relief_valve_orbit.hpp).
struct ValveRun {
    double const* inflows = nullptr;  // [members]: q
    std::size_t members = 0;
    double tolerance = 0;
    MemberRecord* records = nullptr;  // [members], the result
    double* lifts = nullptr;          // [members][valve_recorded_events], the result: x at the events
};

/// Each instruction set's namespace has one, `integrate_valves`.
using ValveIntegrator = void(ValveRun const& run);

}  // namespace slideway
