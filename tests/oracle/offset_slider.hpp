// A slider whose centre of mass G and pin P do not lie in its hole's centre u.
#pragma once

#include <optional>

#include "mechanism.hpp"

namespace oracle::detail {

/// From u, along the axes of the ground: 0 where the parts have no offset.
Vector3 pin_of(Inputs const& in, Parts const& parts, Matrix3 const& attitude);
Vector3 mass_centre_of(Inputs const& in, Parts const& parts, Matrix3 const& attitude);

/// Newton and Euler for rod and slider as free bodies joined at P, twelve equations.  Unknown: u'', ω', the force on the rod at A and at P.
/// @param torque about u
Motion solve_offset_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& force, Vector3 const& torque);

/// The slider alone, whose pin is pushed along X until it has the acceleration `ax`, where that is given; `pin_force` is that push.
Motion solve_guided_motion(Inputs const& in, Parts const& parts, SliderMotion const& slider, Vector3 const& gravity, Vector3 const& force, Vector3 const& torque,
                           std::optional<Real> ax);

}  // namespace oracle::detail
