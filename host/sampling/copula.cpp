#include "host/sampling/copula.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "host/base/error.hpp"
#include "host/sampling/distribution.hpp"

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

/// What makes of columns of scores others with the matrix L Lᵀ: L Q⁻¹, Q Qᵀ the matrix that they have by chance.
/// @param factor L.  @return L itself where so few members leave Q singular.
Matrix mixing(std::span<std::vector<std::uint32_t> const> orders, std::span<double const> score,
              std::span<double const> factor) {
    auto const size = static_cast<Eigen::Index>(orders.size());
    Matrix const own = Matrix::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
        auto const &a = orders[static_cast<std::size_t>(i)], &b = orders[static_cast<std::size_t>(j)];
        return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                     [&](std::uint32_t p, std::uint32_t q) { return score[p] * score[q]; });
    });
    Matrix wanted = Eigen::Map<Matrix const>(factor.data(), size, size);
    Eigen::LLT<Matrix> const cholesky(own);
    Matrix const lower = cholesky.matrixL();
    // Columns that follow from others leave a pivot of the size of rounding.
    constexpr double least_pivot = 1e-6;
    bool const singular =
        cholesky.info() != Eigen::Success || !(lower.diagonal().minCoeff() > least_pivot * lower(0, 0));
    if (singular) return wanted;
    return lower.transpose().triangularView<Eigen::Upper>().solve(wanted.transpose()).transpose();
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

void correlate_orders(std::span<std::vector<std::uint32_t>> orders, std::span<double const> factor) {
    if (orders.empty()) return;
    std::size_t const members = orders[0].size();
    std::vector<double> score(members), mixed(members);
    for (std::size_t i = 0; i < members; ++i)
        score[i] = standard_normal_quantile(static_cast<double>(i + 1) / static_cast<double>(members + 1));
    Matrix const mix = mixing(orders, score, factor);
    std::vector<std::uint32_t> sorted(members);
    for (std::size_t row = orders.size(); row-- > 0;) {  // in place: row i needs the orders 0 … i only
        std::fill(mixed.begin(), mixed.end(), 0.0);
        for (std::size_t column = 0; column <= row; ++column) {
            double const weight = mix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
            for (std::size_t m = 0; m < members; ++m) mixed[m] += weight * score[orders[column][m]];
        }
        std::iota(sorted.begin(), sorted.end(), 0u);
        std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
            return mixed[a] < mixed[b] || (mixed[a] == mixed[b] && a < b);
        });
        for (std::size_t rank = 0; rank < members; ++rank) orders[row][sorted[rank]] = static_cast<std::uint32_t>(rank);
    }
}

}  // namespace slideway
