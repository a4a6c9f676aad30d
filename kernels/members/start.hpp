// The numbers of a mechanism's state, and the inputs with which a member starts in it.
#pragma once

#include <array>
#include <cmath>

#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

using StateNumbers = std::array<double, most_states>;  // the first `states` of the mechanism count

/// The inputs of a slider that is free in space, in the order of its state.
inline constexpr double Inputs::*slider_inputs[most_states] = {
    &Inputs::y,     &Inputs::z,  &Inputs::vy, &Inputs::vz, &Inputs::roll, &Inputs::yaw,
    &Inputs::pitch, &Inputs::wx, &Inputs::wy, &Inputs::wz, &Inputs::x,    &Inputs::vx};

/// The state in which a member starts.  Of a planar mechanism the rod's angle θ2 and its rate follow from the slider's:
/// y = r sin θ1 + L sin θ2.  @param in complete
static inline StateNumbers start_of(MechanismInfo const& mechanism, Inputs const& in) {
    if (mechanism.spatial) {
        StateNumbers state{};
        for (int i = 0; i < mechanism.states; ++i) state[i] = in.*slider_inputs[i];
        return state;
    }
    double const sine = (in.y - in.crank_length * std::sin(in.start_angle)) / in.rod_length;
    double const rate = (in.vy - in.crank_length * in.crank_speed * std::cos(in.start_angle)) /
                        (in.rod_length * std::sqrt((1 - sine) * (1 + sine)));
    return {in.start_angle, std::asin(sine), in.pitch, in.crank_speed, rate, in.wz};
}

/// Makes a member start in a state.  The planar rod is to point along the way: |θ2| < π/2.
static inline void set_start(MechanismInfo const& mechanism, StateNumbers const& state, Inputs& in) {
    if (mechanism.spatial) {
        for (int i = 0; i < mechanism.states; ++i) in.*slider_inputs[i] = state[i];
        return;
    }
    double const crank = state[0], rod = state[1];
    in.start_angle = crank, in.pitch = state[2], in.crank_speed = state[3], in.wz = state[5];
    in.y = in.crank_length * std::sin(crank) + in.rod_length * std::sin(rod);
    in.vy = in.crank_length * std::cos(crank) * state[3] + in.rod_length * std::cos(rod) * state[4];
}

/// The time at which a member that starts in the state of a time t is to be evaluated: a planar one has the crank's angle at t for its
/// start_angle, and its drive would turn on by ω t.
static inline double time_of_start(MechanismInfo const& mechanism, double t) { return mechanism.spatial ? t : 0; }

}  // namespace slideway
