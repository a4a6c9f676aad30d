// What the states should be at the end time, computed twice by means that share as little as can be.
#pragma once

#include "bench/work_precision/problem.hpp"

namespace slideway::bench {

/// Distance of two states in the norm of Measure::state.
double state_error(std::vector<double> const& state, std::vector<double> const& reference,
                   std::vector<double> const& scale);

/// The scales of the error control for one member.
std::vector<double> scales(Ensemble const& ensemble, std::size_t member);

/// Fills in the reference states of a problem measured by states; does nothing for others.  Time and state are kept in 80
/// bits. Slider-cranks: the independent right-hand side of tests/oracle under Cash–Karp 5(4), against our kernels' under
/// Dormand–Prince 5(4).  (Fehlberg 7(8) estimates its error from the two ends of a step and so misses impacts that begin
/// inside.) Lorenz: Fehlberg 7(8) against Bulirsch–Stoer.  Bouncing mass: its closed form alone.  The first is the reference.
/// Members whose references differ by more than 1e-11 are dropped: chaos has made the state at the end a matter of rounding.
/// @throws std::runtime_error if
/// fewer than half of those wanted are left.
///
/// Only the shared members get references; those behind them stay as company.
void find_references(Problem& problem);

}  // namespace slideway::bench
