// The numbers the oracle computes in, and the names of what it is given.
#pragma once

#include <Eigen/Core>
#include <kernels/inputs.hpp>
#include <limits>

namespace oracle::detail {

using slideway::Damping;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;
using slideway::Parts;

// 64 bits of mantissa: a penetration of 1e-10 m taken as the difference of two half widths keeps eleven digits.
using Real = long double;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Vector4 = Eigen::Matrix<Real, 4, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Matrix4 = Eigen::Matrix<Real, 4, 4>;

inline constexpr Real pi = 3.141592653589793238462643383279502884L;
inline constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();

}  // namespace oracle::detail
