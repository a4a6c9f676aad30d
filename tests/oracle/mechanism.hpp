// Where crank, rod, slider and way are, and how they move under the forces on them.
#pragma once

#include "numbers.hpp"
#include "oracle.hpp"

namespace oracle::detail {

struct Kinematics {
    bool reached = true;
    Real angle = 0;  // θ of the crank
    Vector3 pin, pin_velocity, pin_acceleration;
    Vector3 centre, velocity;  // of the slider
    Real roll = 0, yaw = 0, pitch = 0;
    Vector3 angular_velocity;  // body frame
    Matrix4 pose, pose_rate;   // slider in the inertial frame
};

/// Of the mechanism at t [s]; nothing but the crank where the rod does not reach.
Kinematics kinematics_of(Inputs const& in, Real t, State const& state);

/// The way where the parts have it: misaligned, or along X.
Matrix4 pose_of_way(Inputs const& in, Parts const& parts);

struct Motion {
    Vector3 slider_acceleration, pin_force;
};

/// Newton and Euler for rod and slider as free bodies joined at B.  Unknown: a_B, the force on the rod at A and at B.
/// Equations: momentum of the rod, momentum of the slider, moment about the rod's centre of mass in the two
/// directions across it (spherical ends and no spin leave none along it), and |AB| = L differentiated twice.
Motion solve_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& contact_force);

/// Energy [J] of slider and rod: kinetic and of their weight, without contact and crank.
Real kinetic_and_weight(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& inertia);

}  // namespace oracle::detail
