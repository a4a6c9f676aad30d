// Reference orbits of the relief valve as a file: one period of every member that has one.
#pragma once

#include <string>
#include <vector>

#include "bench/relief_valve_orbit.hpp"

namespace slideway::bench {

struct ValveGolden {
    double inflow = 0;
    std::size_t period = 0;          // 0: the recorded events do not repeat
    std::vector<ValveEvent> events;  // [period]

    /// The events repeated to the length of a record.
    ValveOrbit orbit() const;
};

/// Period of an orbit within 1e-7 in x, and its last events.
ValveGolden valve_golden(ValveOrbit const& orbit, double inflow);

/// Columns member,inflow,period,impact,x,v,p; a member without a period has one row that ends after its 0.
/// @return whether the file could be written.
bool write_valve_golden(std::string const& path, std::vector<ValveGolden> const& golden);

/// Empty if the file cannot be read.
std::vector<ValveGolden> read_valve_golden(std::string const& path);

}  // namespace slideway::bench
