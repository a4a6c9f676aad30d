// Homogeneous poses (Qian et al. 2020, Eq. 1-4) and the rates of their angles.
#pragma once

#include "numbers.hpp"

namespace oracle::detail {

Matrix4 translation(Vector3 const& u);
/// By the angle [rad] about axis 0, 1 or 2.
Matrix4 rotation(int axis, Real angle);
/// Position in the frame that the pose is given in, from position in the body.
Matrix4 pose_of(Vector3 const& centre, Real roll, Real yaw, Real pitch);
/// Transpose of the rotation, which is exact, in place of a general inverse.
Matrix4 inverse_of(Matrix4 const& pose);
/// W with W u = w × u.
Matrix3 cross_matrix(Vector3 const& w);
/// φ' ϑ' ψ' from ω of the body frame: ω is the sum of the three rates along their axes as the body sees them.
Vector3 euler_rates(Real roll, Real yaw, Vector3 const& angular_velocity);

}  // namespace oracle::detail
