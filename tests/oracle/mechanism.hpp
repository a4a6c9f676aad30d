// Where crank, rod, slider and way are, and how they move under the forces on them.
#pragma once

#include "numbers.hpp"
#include "oracle.hpp"

namespace oracle::detail {

struct SliderMotion {
    Vector3 centre, velocity;
    Real roll = 0, yaw = 0, pitch = 0;
    Vector3 angular_velocity;  // body frame
    Matrix4 pose, pose_rate;   // slider in the inertial frame
};

/// Attitude and its rate are the state's.
SliderMotion slider_motion(Vector3 const& centre, Vector3 const& velocity, State const& state);

struct Kinematics {
    bool reached = true;
    Real angle = 0;  // θ of the crank
    Vector3 pin, pin_velocity, pin_acceleration;  // of the crank
    Vector3 end, end_velocity;                    // of the rod: the slider's pin
    SliderMotion slider;
};

/// Of a crank [rad], [rad/s], [rad/s²].
struct CrankMotion { Real angle = 0, speed = 0, acceleration = 0; };
/// At constant speed, on a profile, or as the state has it: then without its acceleration, which the torque gives.
CrankMotion crank_motion(Inputs const& in, Parts const& parts, Real t, State const& state);
/// Of a motor, with the torque that its bearings take [N m].
Real motor_torque(Inputs const& in, Parts const& parts, CrankMotion const& crank, Real t);

/// Of the mechanism; nothing but the crank where the rod does not reach.
Kinematics kinematics_of(Inputs const& in, Parts const& parts, CrankMotion const& crank, State const& state);

/// The way where the parts have it: misaligned, or along X.  It turns about x = L where there is a rod, else about
/// x = 0.  @throws std::invalid_argument for a mechanism that is not spatial
Matrix4 pose_of_way(Inputs const& in, Parts const& parts);

struct Motion {
    Vector3 slider_acceleration, pin_force, rod_force;
    Vector3 spin_up = Vector3::Constant(nan);  // ω' along the slider's axes, where it is coupled to them
};

/// Newton and Euler for rod and slider as free bodies joined at B.  Unknown: a_B, the force on the rod at A and at B.
/// Equations: momentum of the rod, momentum of the slider, moment about the rod's centre of mass in the two
/// directions across it (spherical ends and no spin leave none along it), and |AB| = L differentiated twice.
Motion solve_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& contact_force);

/// Energy [J] of a body: kinetic and of its weight.
Real slider_energy(Inputs const& in, Parts const& parts, SliderMotion const& slider, Vector3 const& gravity);
Real rod_energy(Inputs const& in, Kinematics const& k, Vector3 const& gravity);

}  // namespace oracle::detail
