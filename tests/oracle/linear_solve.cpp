#include "linear_solve.hpp"

#include <Eigen/LU>

namespace oracle {

Matrix solution(Matrix const& m, Matrix const& b) { return m.fullPivLu().solve(b); }

}  // namespace oracle
