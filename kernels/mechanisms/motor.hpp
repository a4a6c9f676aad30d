#pragma once

#include "kernels/inputs.hpp"
#include "kernels/loads/drive_plan.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Numbers of [drive] (model.md 15).
template <class Real> struct DriveNumbers {
    Real torque;   // T0 [N m]
    Real droop;    // 1/ω0 along the torque, 0 of one that does not fall with the speed [s/rad]
    Real viscous;  // c [N m s/rad]
    Real inertia;  // J of crank and flywheel about the shaft [kg m²]
    Real scale;    // of a profile
};

SLIDEWAY_FN DriveNumbers<double> drive_numbers(Inputs const& in) {
    double const own = in.crank_inertia + 0.25 * in.crank_mass * in.crank_length * in.crank_length;
    double const droop = in.drive_no_load_speed == 0 ? 0 : 1 / in.drive_no_load_speed;
    return {in.drive_torque, in.drive_torque < 0 ? -droop : droop, in.drive_viscous, own + in.drive_inertia, in.drive_scale};
}

/// Rate [rad/s] that tolerances of speeds are meant against: of a crank how fast it turns, on a profile or motor at most; at least 1, for a crank at
/// rest would ask for velocities to any number of digits.
SLIDEWAY_FN double drive_scale_rate(Inputs const& in) {
    return max(max(::fabs(in.crank_speed * in.drive_scale), in.drive_no_load_speed), 1.0);
}

/// T = f T0 (1 − ω/ω0) − c ω [N m], with ω0 on the side of T0 and f what the drive's table is over angle, time or speed, 1 without one.
template <class Real>
SLIDEWAY_FN Real motor_torque(DrivePlan const& drive, DriveNumbers<Real> const& motor, Real t, Real angle, Real speed) {
    Real torque = motor.torque * fnma(speed, motor.droop, Real(1.0));
    if (drive.table != nullptr) {
        Real const over = drive.over == LoadArgument::crank_angle ? angle : drive.over == LoadArgument::time ? t : speed;
        torque = torque * table_value(*drive.table, over);
    }
    return fnma(motor.viscous, speed, torque);
}

}  // namespace slideway::inline SLIDEWAY_ISA
