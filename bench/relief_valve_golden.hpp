// Reference orbits of the relief valve as a file that tests/support/valve_golden.hpp reads: one period of every member that has one.
#pragma once

#include <string>
#include <vector>

#include "bench/relief_valve_orbit.hpp"
#include "tests/support/valve_golden.hpp"

namespace slideway::bench {

using testing::ValveGolden;

/// The events repeated to the length of a record.
ValveOrbit repeated(ValveGolden const& golden);

/// Period of an orbit within 1e-7 in x, and its last events.
ValveGolden valve_golden(ValveOrbit const& orbit, double inflow);

/// @return whether the file could be written.
bool write_valve_golden(std::string const& path, std::vector<ValveGolden> const& golden);

}  // namespace slideway::bench
