// What the relief valve's benchmark asks of every solver, and how orbits are compared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/valve_golden.hpp"

namespace slideway::bench {

inline constexpr std::size_t valve_transient_events = 2048;  // extrema or impacts, not kept
inline constexpr std::size_t valve_recorded_events = 64;

using testing::ValveEvent;

struct ValveOrbit {
    std::vector<ValveEvent> events;  // the recorded ones; fewer if the run gave up
    std::uint64_t steps = 0;         // accepted
    std::uint64_t rhs = 0;
    bool at_rest = false;  // came to the equilibrium
};

/// q of a member: from 0.2 to 10 linearly.
double valve_inflow(std::size_t member, std::size_t members);

/// Events after which the recorded ones repeat, in kind and in x within `tolerance`; 0 if they do not within half their number.
std::size_t valve_period(ValveOrbit const& orbit, double tolerance);

/// Largest difference in x between two orbits of the same period, started where they fit best (a transient of other length shifts
/// them); infinite where the kinds of events differ.
double valve_difference(ValveOrbit const& a, ValveOrbit const& b, std::size_t period);

}  // namespace slideway::bench
