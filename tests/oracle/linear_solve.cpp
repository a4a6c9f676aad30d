#include "linear_solve.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

namespace oracle {

Matrix solution(Matrix const& m, Matrix const& b) { return m.fullPivLu().solve(b); }

Column least_norm(Table const& m, Column const& b, long double threshold) {
    Eigen::CompleteOrthogonalDecomposition<Table> decomposition;
    decomposition.setThreshold(threshold);
    decomposition.compute(m);
    return decomposition.solve(b);
}

}  // namespace oracle
