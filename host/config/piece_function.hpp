// Functions through given points in cubic pieces, as kernels read them: tables of loads and drives.
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
inline constexpr std::string_view interpolation_names[] = {"spline", "monotone", "linear"}, smooth_interpolation_names[] = {"spline", "monotone"};

/// What is wrong with points, and at which of them.
struct PointFault {
    std::size_t point;
    std::string reason, advice;
};

/// What PieceTable::first is of pieces; of the table the rest is known.
std::vector<int> first_pieces(std::span<PieceTable::Piece const> pieces, PieceTable const& table);

/// A function of one number.  It repeats itself, or stays outside as it is at its nearer end.
class PieceFunction {
public:
    /// Why points make no function: places that do not rise, values that are none, a period that does not close.
    static std::optional<PointFault> fault_of(std::span<double const> places, std::span<double const> values, bool repeats);

    /// @param places rising  @param values at them; where it repeats the last is the first again, or each time it is larger by their difference
    PieceFunction(std::span<double const> places, std::span<double const> values, Interpolation interpolation, bool repeats);

    /// What grows as this says: its integral, 0 at the first point.
    PieceFunction integral() const;
    /// The same, shifted so that it is 0 at a place.
    PieceFunction less_its_value_at(double place) const;
    /// Less a line through its first point, as steep as this.
    PieceFunction less_a_line(double slope) const;
    /// Its last piece goes on for this share of its length.
    PieceFunction longer_by(double share) const;
    double value(double place) const;
    double slope(double place) const;
    /// The largest magnitude of its slope, looked for at some places of each piece; its least value there, and how far its values are apart.
    double steepest() const;
    double least() const;
    double range() const;

    /// The first point behind which it has no finite numbers.
    std::optional<std::size_t> not_finite() const;
    /// For as long as this lives.
    PieceTable table() const;

private:
    std::vector<PieceTable::Piece> pieces_;
    std::vector<int> first_;
    double high_, advance_ = 0;
    bool repeats_;
    double width_ = 0;  // of pieces that are evenly spread

    void find_cells();
    /// The piece of a place, how far behind its beginning that is, and how often the function has repeated there.
    struct At { PieceTable::Piece const* piece; double u, times; };
    At at(double place) const;
    template <class See> void look_at_pieces(See const& see) const;
};

}  // namespace slideway
