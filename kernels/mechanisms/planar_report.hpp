#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches of the planar slider.  Corners as (s3 along X, s1 along Y): a (+,+), b (+,−), c (−,−), d (−,+).
template <class Real> struct PlanarContact {
    Quad<Real> penetration[1];     // [m]
    Quad<Real> rate[1];            // [m/s]
    Quad<Real> normal_force[1];    // [N]
    Real surfaces, lines, points;  // a wall that both its corners touch, none, other touching corners
    Real potential;                // U of the contacts [J]
    Real friction_power;           // Σ μ F V [W]
    Real damping_power;            // Σ (F − F_elastic) δ' [W]

    /// Sum of all normal forces [N].
    SLIDEWAY_FN Real total_force() const { return sum(normal_force[0]); }
};

/// All that a state of the planar slider-crank tells beside its derivative.
template <class Real> struct PlanarReport {
    static constexpr int apices = 0;  // corners, of which no quantity tells one by one

    PlanarContact<Real> contact;
    Real x, y, vx, vy;  // slider's centre
    Vec3<Real> acceleration;
    Real top, front;      // sensors that it has not
    Real crank_power;     // of the drive [W]
    Real crank_torque;    // of the drive [N m]
    Real drive_torque;    // the same: the crank's weight is in the equations
    Real energy;          // kinetic, of gravity and of the contacts [J]
    Real position_error;  // distance of the slider's centre from the ideal mechanism's at this crank angle [m]
    Real rod_spin;        // |θ2'| [rad/s]

    /// The pitch is the only angle that is not 0 [rad].
    SLIDEWAY_FN static Real tilt(Real const* state, int axis) { return axis == 2 ? state[2] : Real(0.0); }

    /// Value of an entry of `series_table` beyond the state.
    SLIDEWAY_FN Real series_value(int entry) const {
        switch (static_cast<Series>(entry)) {
            case Series::x:
                return x;
            case Series::y:
                return y;
            case Series::vx:
                return vx;
            case Series::vy:
                return vy;
            case Series::normal_force:
                return contact.total_force();
            case Series::crank_torque:
                return drive_torque;
            case Series::surfaces:
                return contact.surfaces;
            case Series::points:
                return contact.points;
            case Series::ax:
                return acceleration.x;
            case Series::ay:
                return acceleration.y;
            default:
                return Real(not_a_number);
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
