#pragma once

#include "kernels/math/vec3.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Motion of a point: of an end of the rod, or of the slider's centre.
template <class Real> struct PointMotion { Vec3<Real> position, velocity, acceleration; };

/// What every mechanism tells of a state beside its derivative and its contacts.  What it does not have is 0.
template <class Real> struct MechanismReport {
    Real x, vx;               // slider's centre along the way [m], [m/s]
    Vec3<Real> acceleration;  // of the slider's centre [m/s²]
    Real top, front;          // what sensors 10 mm above the way's Y+ and Z+ faces feel along the slider's Y and Z [m/s²]
    Real crank_power;         // of the drive: F_A · v_A, or F_x vx of a slider that is driven along the way [W]
    Real crank_torque;        // (A × F_A)_z [N m]
    Real drive_torque;        // the crank's own weight included [N m]
    Real energy;              // E of model.md 8, potentials of contacts, springs and stops included [J]
    Real load_power = Real(0.0), ground_power = Real(0.0);      // of the loads on slider and crank, and of the ground's motion [W]
    Real spring_loss = Real(0.0), spring_potential = Real(0.0);  // of springs and stops: power of their dampers [W], what they store [J]
    Real film_loss = Real(0.0);  // power of what the oil film takes [W]
    Real position_error;      // distance of the slider's centre from the ideal mechanism's [m]
    Real rod_spin;            // rod's angular velocity, magnitude [rad/s]

    /// Value of an entry of `series_table` that all mechanisms may have; NaN of another.  @param contact of the report
    template <class Contact> SLIDEWAY_FN Real common_series(Series series, Contact const& contact) const {
        switch (series) {
            case Series::x:
                return x;
            case Series::vx:
                return vx;
            case Series::normal_force:
                return contact.total_force();
            case Series::crank_torque:
                return drive_torque;
            case Series::surfaces:
                return contact.surfaces;
            case Series::lines:
                return contact.lines;
            case Series::points:
                return contact.points;
            case Series::ax:
                return acceleration.x;
            case Series::ay:
                return acceleration.y;
            case Series::az:
                return acceleration.z;
            case Series::acceleration_top:
                return top;
            case Series::acceleration_front:
                return front;
            case Series::y:
            case Series::z:
            case Series::vy:
            case Series::vz:
            case Series::roll:
            case Series::yaw:
            case Series::pitch:
            case Series::wx:
            case Series::wy:
            case Series::wz:
            case Series::rod_angular_velocity:
            case Series::crank_angle:
            case Series::crank_angular_velocity:
            case Series::rod_angle:
            // JointForces has these.
            case Series::face_force_y_plus: case Series::face_force_y_minus: case Series::face_force_z_plus: case Series::face_force_z_minus:
            case Series::face_along_y_plus: case Series::face_along_y_minus: case Series::face_along_z_plus: case Series::face_along_z_minus:
            case Series::face_across_y_plus: case Series::face_across_y_minus: case Series::face_across_z_plus: case Series::face_across_z_minus:
            case Series::face_pv_y_plus: case Series::face_pv_y_minus: case Series::face_pv_z_plus: case Series::face_pv_z_minus:
            case Series::friction_force_x: case Series::friction_force_y: case Series::friction_force_z:
            case Series::contact_force_x: case Series::contact_force_y: case Series::contact_force_z:
            case Series::rod_force_x: case Series::rod_force_y: case Series::rod_force_z:
            case Series::crank_pin_force_x: case Series::crank_pin_force_y: case Series::crank_pin_force_z:
            case Series::count:
                break;
        }
        return Real(not_a_number);
    }

protected:
    /// Distance from the ideal mechanism's slider, whose x is √(L² − y_A²) beyond the pin: x − x_ideal = (D² − D0²)/(D + D0), no
    /// difference of lengths.  @param d x − x_A, @param ya height of the pin, @param y, z place of the slider's centre [m]
    SLIDEWAY_FN static Real error_of(Real d, Real ya, Real y, Real z, Real rod_length) {
        Real const ideal = sqrt(max(fnma(ya, ya, rod_length * rod_length), Real(0.0)));
        Real const shift = fnma(z, z, y * (ya + ya - y)) / (d + ideal);
        return sqrt(fma(shift, shift, fma(y, y, z * z)));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
