// The period of what drives a mechanism: a revolution of its crank, or the carriage's way there and back.
#pragma once

#include <string>

#include "kernels/inputs.hpp"

namespace slideway {

/// T [s]: 2π/|ω| of a driven crank, 2 (stroke/v + t_r) of the carriage (model.md 7); infinite where the crank rests or nothing drives.
double drive_period(Parts const& parts, Inputs const& inputs);

/// First time in (0, T] at which the drive has this phase [s]: the crank an angle, the carriage a share phase/2π of its period.
/// @param phase [rad], any turn of it  @param inputs whose drive has a period
double first_time_at(double phase, Parts const& parts, Inputs const& inputs);

/// Why there is no period: "mechanism.crank_speed is 0", "nothing drives a free_slider", "nothing drives a free crank".
std::string why_no_period(Parts const& parts);

}  // namespace slideway
