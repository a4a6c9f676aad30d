// The period of what drives a mechanism: a revolution of its crank, or the carriage's way there and back.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// T [s]: 2π/|ω| of a driven crank, 2 (stroke/v + t_r) of the carriage (model.md 7), or that of a profile that repeats; infinite where nothing comes round.
static inline double drive_period(MechanismInfo const& mechanism, DrivePlan const& drive, Inputs const& in) {
    if (drive.turns_freely() || mechanism.drive == DriveKind::none) return std::numeric_limits<double>::infinity();
    if (drive.by == DriveBy::profile) return drive.table->repeats ? drive.table->high - drive.table->low : std::numeric_limits<double>::infinity();
    if (mechanism.drive == DriveKind::carriage) return 2 * (in.stroke / in.carriage_speed + in.reversal_time);
    return 2 * std::numbers::pi / std::abs(in.crank_speed);
}

/// First time in (0, T] at which the drive has this phase [s]: the crank an angle, the carriage, and a profile, a share phase/2π of its period.
/// @param phase [rad], any turn of it  @param in whose drive has a period
static inline double first_time_at(double phase, MechanismInfo const& mechanism, DrivePlan const& drive, Inputs const& in) {
    double const turn = drive_period(mechanism, drive, in);
    bool const by_share = mechanism.drive == DriveKind::carriage || drive.by == DriveBy::profile;
    double const from_start = by_share ? phase * (turn / (2 * std::numbers::pi))
                                                                     : (phase - in.start_angle) / in.crank_speed;
    double const time = std::fmod(from_start, turn);
    double const positive = time > 0 ? time : time + turn;
    // A start at the phase itself is no return to it.
    return positive > 1e-9 * turn ? positive : positive + turn;
}

}  // namespace slideway
