// The period of what drives a mechanism: a revolution of its crank, or the carriage's way there and back.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// T [s]: 2π/|ω| of a driven crank, 2 (stroke/v + t_r) of the carriage (model.md 7); infinite where the crank rests or nothing drives.
static inline double drive_period(MechanismInfo const& mechanism, bool free_crank, Inputs const& in) {
    if (free_crank || mechanism.drive == DriveKind::none) return std::numeric_limits<double>::infinity();
    if (mechanism.drive == DriveKind::carriage) return 2 * (in.stroke / in.carriage_speed + in.reversal_time);
    return 2 * std::numbers::pi / std::abs(in.crank_speed);
}

/// First time in (0, T] at which the drive has this phase [s]: the crank an angle, the carriage a share phase/2π of its period.
/// @param phase [rad], any turn of it  @param in whose drive has a period
static inline double first_time_at(double phase, MechanismInfo const& mechanism, bool free_crank, Inputs const& in) {
    double const turn = drive_period(mechanism, free_crank, in);
    double const from_start = mechanism.drive == DriveKind::carriage ? phase * (turn / (2 * std::numbers::pi))
                                                                     : (phase - in.start_angle) / in.crank_speed;
    double const time = std::fmod(from_start, turn);
    double const positive = time > 0 ? time : time + turn;
    // A start at the phase itself is no return to it.
    return positive > 1e-9 * turn ? positive : positive + turn;
}

}  // namespace slideway
