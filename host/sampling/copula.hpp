// Correlation matrices.
#pragma once

#include <cstddef>
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

}  // namespace slideway
