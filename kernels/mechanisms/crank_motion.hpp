#pragma once

#include "kernels/loads/drive_plan.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/mechanisms/motor.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How something moves that has one coordinate: place, velocity and acceleration, or angle, speed and its rate.
template <class Real> struct GivenMotion { Real place, velocity, acceleration; };

/// A drive's profile at a time.
template <class Real> SLIDEWAY_NOINLINE GivenMotion<Real> profile_motion(PieceTable const& table, Real const& t) {
    if constexpr (is_tangent<Real>) {
        auto const at = table_point(table, t.value);
        return {{at.value, at.slope * t.slope}, {at.slope, at.bend * t.slope}, {at.bend, at.jerk * t.slope}};
    } else {
        auto const at = table_point(table, t);
        return {at.value, at.slope, at.bend};
    }
}

/// A profile times the member's scale, from where it begins.
template <class Real> SLIDEWAY_FN GivenMotion<Real> scaled(GivenMotion<Real> const& profile, Real scale, Real start) {
    return {fma(scale, profile.place, start), scale * profile.velocity, scale * profile.acceleration};
}

/// Angle [rad], speed and acceleration of a crank that is driven: θ0 + ω t, or θ0 and what a profile turns by (model.md 15).
/// @param p has crank_speed, start_angle and motor
template <class Real, class Parameters>
SLIDEWAY_FN GivenMotion<Real> driven_crank(DrivePlan const& drive, Real t, Parameters const& p) {
    if (drive.by != DriveBy::profile) return {fma(p.crank_speed, t, p.start_angle), p.crank_speed, Real(0.0)};
    return scaled(profile_motion(*drive.table, t), p.motor.scale, p.start_angle);
}

/// What loads read of the crank of a guide; 0 where none turns.
template <class Guide, class Real, class Parameters>
SLIDEWAY_FN GivenMotion<Real> crank_of(Real t, Real const* s, Parameters const& p, DrivePlan const& drive) {
    if constexpr (requires { Guide::crank(t, s, p, drive); }) return Guide::crank(t, s, p, drive);
    else return {Real(0.0), Real(0.0), Real(0.0)};
}

}  // namespace slideway::inline SLIDEWAY_ISA
