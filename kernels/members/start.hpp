// The numbers of a mechanism's state, and the inputs with which a member starts in it.
#pragma once

#include <array>
#include <cmath>

#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

using StateNumbers = std::array<double, most_states>;  // the first `states` of the mechanism count

/// The input with which a component of a spatial mechanism's state starts.
struct StartInput {
    Series component;
    double Inputs::*input;
};
inline constexpr StartInput start_inputs[] = {
    {Series::y, &Inputs::y},         {Series::z, &Inputs::z},     {Series::vy, &Inputs::vy}, {Series::vz, &Inputs::vz},
    {Series::roll, &Inputs::roll},   {Series::yaw, &Inputs::yaw}, {Series::pitch, &Inputs::pitch},
    {Series::wx, &Inputs::wx},       {Series::wy, &Inputs::wy},   {Series::wz, &Inputs::wz}, {Series::x, &Inputs::x},
    {Series::vx, &Inputs::vx},       {Series::crank_angle, &Inputs::start_angle},
    {Series::crank_angular_velocity, &Inputs::crank_speed}};

/// nullptr of a component that has none.
constexpr double Inputs::*start_input(Series component) {
    for (StartInput const& row : start_inputs) {
        if (row.component == component) return row.input;
    }
    return nullptr;
}

/// Whether `start_of` and `set_start` know all of a mechanism's state.
constexpr bool has_start_inputs(MechanismInfo const& mechanism) {
    for (int i = 0; mechanism.spatial && i < mechanism.states; ++i) {
        if (start_input(mechanism.state[i]) == nullptr) return false;
    }
    return true;
}

/// The state in which a member starts.  Of a planar mechanism the rod's angle θ2 and its rate follow from the slider's:
/// y = r sin θ1 + L sin θ2.  @param mechanism `has_start_inputs`  @param in complete
static inline StateNumbers start_of(MechanismInfo const& mechanism, Inputs const& in) {
    if (mechanism.spatial) {
        StateNumbers state{};
        for (int i = 0; i < mechanism.states; ++i) state[i] = in.*start_input(mechanism.state[i]);
        return state;
    }
    double const sine = (in.y - in.crank_length * std::sin(in.start_angle)) / in.rod_length;
    double const rate = (in.vy - in.crank_length * start_speed(in) * std::cos(in.start_angle)) /
                        (in.rod_length * std::sqrt((1 - sine) * (1 + sine)));
    return {in.start_angle, std::asin(sine), in.pitch, start_speed(in), rate, in.wz};
}

/// Makes a member start in a state.  The planar rod is to point along the way: |θ2| < π/2.
static inline void set_start(MechanismInfo const& mechanism, StateNumbers const& state, Inputs& in) {
    if (!mechanism.own_series.empty()) {
        for (int i = 0; i < mechanism.states; ++i) in.*mechanism_inputs[i] = state[i];
        in.start_angle = state[0], in.crank_speed = state[1], in.profile_speed = follows;
        return;
    }
    if (mechanism.spatial) {
        for (int i = 0; i < mechanism.states; ++i) in.*start_input(mechanism.state[i]) = state[i];
        return;
    }
    double const crank = state[0], rod = state[1];
    in.start_angle = crank, in.pitch = state[2], in.crank_speed = state[3], in.profile_speed = follows, in.wz = state[5];
    in.y = in.crank_length * std::sin(crank) + in.rod_length * std::sin(rod);
    in.vy = in.crank_length * std::cos(crank) * state[3] + in.rod_length * std::cos(rod) * state[4];
}

}  // namespace slideway
