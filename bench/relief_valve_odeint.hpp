#pragma once

#include "bench/relief_valve_orbit.hpp"

namespace slideway::bench {

/// The peer: Boost.Odeint's controlled Cash–Karp 5(4) in double, on the right-hand side that the kernels have.
ValveOrbit odeint_valve_orbit(double inflow, double tolerance);

/// The reference: Fehlberg 8(7) in 80-bit numbers, equations written anew.
ValveOrbit reference_valve_orbit(double inflow, double tolerance);

}  // namespace slideway::bench
