#include "host/study/state_numbers.hpp"

#include <cmath>
#include <span>

namespace slideway {
namespace {

/// The inputs of a slider that is free in space, in the order of its state.
constexpr double Inputs::*slider_inputs[most_states] = {&Inputs::y,    &Inputs::z,   &Inputs::vy,    &Inputs::vz,
                                                        &Inputs::roll, &Inputs::yaw, &Inputs::pitch, &Inputs::wx,
                                                        &Inputs::wy,   &Inputs::wz,  &Inputs::x,     &Inputs::vx};

std::span<double Inputs::*const> slider_inputs_of(Mechanism mechanism) {
    return std::span(slider_inputs).first(static_cast<std::size_t>(info(mechanism).states));
}

}  // namespace

StateNumbers start_of(Mechanism mechanism, Inputs const& in) {
    StateNumbers state{};
    if (info(mechanism).spatial) {
        auto const inputs = slider_inputs_of(mechanism);
        for (std::size_t i = 0; i < inputs.size(); ++i) state[i] = in.*inputs[i];
        return state;
    }
    double const sine = (in.y - in.crank_length * std::sin(in.start_angle)) / in.rod_length;
    double const rate = (in.vy - in.crank_length * in.crank_speed * std::cos(in.start_angle)) /
                        (in.rod_length * std::sqrt((1 - sine) * (1 + sine)));
    return {in.start_angle, std::asin(sine), in.pitch, in.crank_speed, rate, in.wz};
}

void set_start(Mechanism mechanism, StateNumbers const& state, Inputs& in) {
    if (info(mechanism).spatial) {
        auto const inputs = slider_inputs_of(mechanism);
        for (std::size_t i = 0; i < inputs.size(); ++i) in.*inputs[i] = state[i];
        return;
    }
    double const crank = state[0], rod = state[1];
    in.start_angle = crank, in.pitch = state[2], in.crank_speed = state[3], in.wz = state[5];
    in.y = in.crank_length * std::sin(crank) + in.rod_length * std::sin(rod);
    in.vy = in.crank_length * std::cos(crank) * state[3] + in.rod_length * std::cos(rod) * state[4];
}

}  // namespace slideway
