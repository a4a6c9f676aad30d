// A spatial mechanism over time, with the books of section 8: what the drive gave, what friction and damping took.
#pragma once

#include "oracle.hpp"

namespace oracle {

struct SpatialRun {
    State state{};                                    // at the end
    long double energy_change = 0;                    // E(t) - E(0) [J]
    long double work = 0, friction = 0, damping = 0;  // W, D_f, D_d [J]
    int changes = 0;                                  // pairs that began or ceased to touch or to push
    [[nodiscard]] long double residual() const { return energy_change - work + friction + damping; }
};

/// Classical Runge-Kutta steps from t = 0 that end where a pair begins or ceases to touch or to push, as the force may
/// have a kink or a jump there.  Impact speeds are their start value.
SpatialRun spatial_run(slideway::Inputs const& completed, slideway::Parts const& parts, State const& start,
                       long double duration, long double step);

}  // namespace oracle
