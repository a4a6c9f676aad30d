// Functions through given points in cubic pieces, as kernels read them: tables of loads.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/loads/load_list.hpp"

namespace slideway {

/// How a function runs between its points.
///   spline    a cubic spline: slope and curvature are continuous (natural ends: no curvature there)
///   monotone  cubic pieces that rise and fall as the points do; slopes are the weighted harmonic means of Fritsch & Butland 1984
///   linear    straight, with kinks at the points
enum class Interpolation { spline, monotone, linear };
inline constexpr std::string_view interpolation_names[] = {"spline", "monotone", "linear"};

/// What is wrong with points, and at which of them.
struct PointFault {
    std::size_t point;
    std::string reason, advice;
};

/// A function of one number.  It repeats itself, or stays outside as it is at its nearer end.
class PieceFunction {
public:
    /// Why points make no function: places that do not rise, values that are none, a period that does not close.
    static std::optional<PointFault> fault_of(std::span<double const> places, std::span<double const> values, bool repeats);

    /// @param places rising  @param values at them; where it repeats the last is the first again
    PieceFunction(std::span<double const> places, std::span<double const> values, Interpolation interpolation, bool repeats);

    /// The first point behind which it has no finite numbers.
    std::optional<std::size_t> not_finite() const;
    /// For as long as this lives.
    PieceTable table() const;

private:
    std::vector<PieceTable::Piece> pieces_;
    std::vector<int> first_;
    double high_;
    bool repeats_;
};

}  // namespace slideway
