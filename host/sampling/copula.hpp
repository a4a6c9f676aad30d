// Correlation matrices, and orders that follow one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slideway {

/// Why a matrix is no correlation matrix, and what to do; nothing if it is one: |r| <= 1, ones on the diagonal,
/// symmetric, positive definite.  Rows and columns are counted from 1 in the text, "row 1, column 2 is 1.5 (…); …".
/// @param matrix [n][n].
std::optional<std::string> matrix_defect(std::span<double const> matrix, std::size_t n);

/// Lower triangular L with L Lᵀ = matrix, [n][n] with zeros above the diagonal.
/// @throws SceneError with the defect of a matrix that is no correlation matrix.
std::vector<double> cholesky_factor(std::span<double const> matrix, std::size_t n);

/// Reorders columns so that they correlate, and no value of any column changes: those of the scores Φ⁻¹((rank + 1)/(members + 1)) then have
/// this matrix to within 1/members or so, for their own chance correlations are taken out first (Iman & Conover, Commun. Stat. Simul.
/// Comput. 11 (1982) 311).  So few members that these are singular keep them.  Of the first column the order stays.
/// Memory: 20 bytes a member beside the orders.
/// @param orders [n][members], each a permutation of 0 … members − 1: the ranks of its members.
/// @param factor [n][n], lower triangular: of the matrix, by cholesky_factor.
void correlate_orders(std::span<std::vector<std::uint32_t>> orders, std::span<double const> factor);

}  // namespace slideway
