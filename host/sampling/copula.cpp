#include "host/sampling/copula.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "host/base/error.hpp"

namespace slideway {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Nothing if the matrix is not positive definite.
std::optional<Matrix> factor(std::span<double const> matrix, std::size_t n) {
    auto const size = static_cast<Eigen::Index>(n);
    Matrix const given = Eigen::Map<Matrix const>(matrix.data(), size, size);
    Eigen::LLT<Matrix> const cholesky(given);
    if (cholesky.info() != Eigen::Success) return {};
    Matrix lower = cholesky.matrixL();
    // A pivot of the size of its own rounding error: singular.
    double const least = std::numeric_limits<double>::epsilon() * static_cast<double>(n);
    for (Eigen::Index i = 0; i < size; ++i) {
        if (!(lower(i, i) * lower(i, i) > least)) return {};
    }
    return lower;
}

std::string at(std::size_t row, std::size_t column) { return fmt::format("row {}, column {}", row + 1, column + 1); }

}  // namespace

std::optional<std::string> matrix_defect(std::span<double const> matrix, std::size_t n) {
    if (matrix.size() != n * n) {
        return fmt::format("it has {} entries (a matrix of {} variables has {}); write {} rows of {}", matrix.size(), n,
                           n * n, n, n);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (matrix[i * n + i] != 1) {
            return fmt::format("{} is {} (each value follows itself); write 1 on the diagonal", at(i, i),
                               matrix[i * n + i]);
        }
        for (std::size_t j = 0; j < n; ++j) {
            double const r = matrix[i * n + j];
            if (!(std::abs(r) <= 1)) {
                return fmt::format("{} is {} (a correlation lies in [-1, 1]); use a value between", at(i, j), r);
            }
            if (r != matrix[j * n + i]) {
                return fmt::format("{} is {}, {} is {} (the matrix is symmetric); give both the same value", at(i, j),
                                   r, at(j, i), matrix[j * n + i]);
            }
        }
    }
    if (n > 0 && !factor(matrix, n)) {
        return std::string(
            "it is not positive definite (no variables have such correlations, or one follows from the others); "
            "use weaker correlations");
    }
    return {};
}

std::vector<double> cholesky_factor(std::span<double const> matrix, std::size_t n) {
    if (auto const defect = matrix_defect(matrix, n)) throw SceneError(fmt::format("correlation: {}", *defect));
    std::vector<double> lower(n * n);
    if (n == 0) return lower;
    Matrix const found = *factor(matrix, n);
    std::copy(found.data(), found.data() + n * n, lower.begin());
    return lower;
}

}  // namespace slideway
