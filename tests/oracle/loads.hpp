// Loads, springs, stops and the motion of the ground, as the textbook writes them (model.md 14).
#pragma once

#include "numbers.hpp"
#include "oracle.hpp"

namespace oracle::detail {

/// What a load may be read over.
struct LoadPlace { Real crank_angle = 0, time = 0, x = 0, vx = 0, crank_speed = 0; };

/// A table with its first two derivatives.
struct TableMotion { Real value = 0, slope = 0, bend = 0; };
TableMotion table_motion(slideway::PieceTable const& table, Real at);

/// Of all loads.
struct LoadSum {
    Vector3 force = Vector3::Zero();   // on the slider, inertial frame [N]
    Vector3 torque = Vector3::Zero();  // about the slider's centre, inertial frame [N m]
    Real crank_torque = 0;             // [N m]
    Real slider_power = 0;             // Σ F · v of the points they act at, and of the torques; not of springs and stops [W]
    Vector3 ground = Vector3::Zero();  // acceleration of the ground [m/s²]
    Real potential = 0;                // of springs and stops [J]
    Real spring_loss = 0;              // what their dampers take [W]
};
/// How far a face of the way, 0: Y+, Y−, Z+, Z−, lies back at a place along it [m], and its slope.
TableMotion way_depth(Inputs const& in, Parts const& parts, int face, Real x);

/// The place on the way that is nearest.
Real way_place(Inputs const& in, Parts const& parts, Real x);

/// @param pose, pose_rate of the slider: 4 × 4 matrices
LoadSum load_sum(Inputs const& in, Parts const& parts, LoadPlace const& place, Matrix4 const& pose, Matrix4 const& pose_rate);

}  // namespace oracle::detail
