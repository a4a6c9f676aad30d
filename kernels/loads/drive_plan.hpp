// What moves a mechanism, as a block has it.  Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include "kernels/loads/load_list.hpp"

namespace slideway {

/// How a crank turns, or a carriage moves.
enum class DriveBy {
    speed,    // a crank at constant speed, a carriage to and fro
    profile,  // as a function of time says
    torque,   // as a motor's torque lets it: angle and speed of the crank are states
    nothing,  // as it likes, likewise
};

struct DrivePlan {
    DriveBy by = DriveBy::speed;
    /// The profile: of a crank the angle that it turns by [rad], of a carriage its place [m], over time.  Or what a motor's torque is multiplied by;
    /// nullptr: 1.  Memory that the host owns.
    PieceTable const* table = nullptr;
    LoadArgument over = LoadArgument::nothing;  // of a motor's table

    /// Whether angle and speed of the crank are states that forces change.
    constexpr bool turns_freely() const { return by == DriveBy::torque || by == DriveBy::nothing; }

    friend bool operator==(DrivePlan const&, DrivePlan const&) = default;
};

}  // namespace slideway
