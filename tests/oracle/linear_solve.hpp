// Linear equations for the oracle and for tests: compiled once, for Eigen's elimination costs a unit seconds for each size.
#pragma once

#include <Eigen/Core>

namespace oracle {

/// Up to ten rows and columns.
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 10, 10>;

/// m⁻¹ b by elimination with full pivoting; one column for each of b's.
Matrix solution(Matrix const& m, Matrix const& b);

}  // namespace oracle
