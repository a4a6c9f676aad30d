// [drive]: what moves a mechanism (docs/explanation/model.md 15).
#pragma once

#include <string_view>

#include "host/config/loads.hpp"
#include "kernels/loads/drive_plan.hpp"

namespace slideway {

inline constexpr std::string_view drive_names[] = {"speed", "profile", "torque", "free"};  // in the order of DriveBy
/// What scenes of earlier versions say in the place of drive.kind, and those of their results: "driven" or "free".
inline constexpr std::string_view former_crank = "mechanism.crank", former_cranks[] = {"driven", "free"};
inline constexpr std::string_view drive_arguments[] = {"crank_speed", "crank_angle", "time"};

/// What the column of a profile is.
enum class ProfileGives { angle, speed, position };
inline constexpr std::string_view profile_names[] = {"angle", "speed", "position"};

/// The table of a scene's drive: its `function` is what the kernels see, angle or place where the column is a speed.
struct SceneDrive {
    LoadTable table;
    ProfileGives gives = ProfileGives::angle;

    SceneDrive() = default;
    SceneDrive(SceneDrive const&) = delete;  // kernels point to what is in it
    SceneDrive& operator=(SceneDrive const&) = delete;

    /// The same for kernels, for as long as this lives.
    PieceTable const* plan_table() {
        plan_table_ = table.function->table();
        return &plan_table_;
    }

private:
    PieceTable plan_table_;
};

}  // namespace slideway
