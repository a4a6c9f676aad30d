// The planar slider-crank whose block and walls are rigid, with tilt and friction: event by event, in the sense of model.md 13, and apart from
// the kernels.  Dense equations of crank, rod and block with unknown forces in the contacts, solved anew for each guess of what they do.
#pragma once

#include <kernels/inputs.hpp>
#include <vector>

#include "planar.hpp"

namespace oracle {

struct RigidBlockEvent {
    enum class Kind { impact, rattle, rest, leave, slip } kind;
    long double time;  // [s]
    int corner;        // 0 to 3, as of Corners
    long double speed; // towards the wall before an impact, of its fastest corner [m/s]
};

struct RigidBlockRun {
    std::vector<PlanarState> samples;
    std::vector<RigidBlockEvent> events;
    long double friction_loss = 0, restitution_loss = 0;  // of impacts [J]
    long double largest_gain = 0;                         // of energy in one impact [J]
    long double energy_change = 0;                        // over the run [J]; of a driven crank its work is in it
    bool solved = true;                                   // some guess was always right
};

/// @param every between samples [s], `count` of them after the first
/// @param step of the Runge-Kutta method [s], which ends early at events
RigidBlockRun rigid_block_run(slideway::Inputs const& completed, slideway::Parts const& parts, long double every, int count, long double step);

}  // namespace oracle
