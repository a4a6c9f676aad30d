// Linear equations for the oracle and for tests: compiled once, for Eigen's decompositions cost a unit seconds for each size.
#pragma once

#include <Eigen/Core>

namespace oracle {

/// Up to twelve rows and columns.
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;

/// m⁻¹ b by elimination with full pivoting; one column for each of b's.
Matrix solution(Matrix const& m, Matrix const& b);

using Table = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// The shortest x of those for which |m x − b| is least.  Pivots below the threshold, over the largest, are none.
Column least_norm(Table const& m, Column const& b, long double threshold);

}  // namespace oracle
