// The spatial mechanisms with rigid contacts, event by event, in the sense of model.md 13 and apart from the kernels: flight by extrapolation,
// events to 1e-18 m, impacts and lasting contact of up to sixteen pairs by coulomb_problem.hpp.
#pragma once

#include <array>
#include <kernels/inputs.hpp>
#include <vector>

namespace oracle {

/// y z vy vz roll yaw pitch wx wy wz x vx.
using RigidSliderState = std::array<long double, 12>;

struct RigidSliderEvent {
    enum class Kind { impact, rattle, rest, leave } kind;
    long double time;   // [s]
    int pair;           // 0 to 15: Y faces P1..P8, then Z faces P1..P8; the fastest of an impact
    long double speed;  // before an impact [m/s]
    int pairs = 1;      // that take part
};

struct RigidSliderRun {
    std::vector<RigidSliderState> samples;
    std::vector<std::vector<int>> held;  // pairs in lasting contact at the samples
    std::vector<int> impacts;            // up to each sample
    std::vector<RigidSliderEvent> events;
    long double friction_loss = 0, restitution_loss = 0;  // [J]
    long double largest_gain = 0;                         // of energy in one impact [J]
    long double energy_change = 0;                        // of the slider over the run [J]
    int limited = 0;                                      // impacts that (M13.7) weakened
    bool solved = true;                                   // all conditions of contact were met
};

/// @param times of the samples [s], which ascend  @param most_held the run ends with the first sample that has more pairs in lasting contact
RigidSliderRun rigid_slider_run(slideway::Inputs const& completed, slideway::Parts const& parts,
                                std::vector<long double> const& times, std::size_t most_held = 16);

}  // namespace oracle
