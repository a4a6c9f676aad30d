#include "host/config/piece_function.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseLU>
#include <fmt/format.h>

namespace slideway {
namespace {

/// Points, and the parts between them.
struct Points {
    std::span<double const> places, values;
    bool repeats;

    std::size_t parts() const { return places.size() - 1; }
    double width(std::size_t part) const { return places[part + 1] - places[part]; }
    double rise(std::size_t part) const { return (values[part + 1] - values[part]) / width(part); }
    /// The part before a point; nothing before the first one of a function that does not repeat.
    std::optional<std::size_t> before(std::size_t point) const {
        if (point > 0) return point - 1;
        return repeats ? std::optional(parts() - 1) : std::nullopt;
    }
    std::optional<std::size_t> behind(std::size_t point) const {
        if (point < parts()) return point;
        return repeats ? std::optional<std::size_t>(0) : std::nullopt;
    }
};

/// Curvature is as large on both sides of each point, and 0 at ends: of the parts h with rises d on both sides
/// s₋/h₋ + 2 s (1/h₋ + 1/h₊) + s₊/h₊ = 3 (d₋/h₋ + d₊/h₊).
std::vector<double> spline_slopes(Points const& points) {
    auto const count = points.parts() + (points.repeats ? 0 : 1);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
        auto const row = static_cast<int>(i);
        auto const add = [&](std::size_t part, std::size_t other) {
            double const inverse = 1 / points.width(part);
            entries.emplace_back(row, row, 2 * inverse);
            entries.emplace_back(row, static_cast<int>(other % count), inverse);
            right[row] += 3 * points.rise(part) * inverse;
        };
        if (auto const part = points.before(i)) add(*part, *part);
        if (auto const part = points.behind(i)) add(*part, *part + 1);
    }
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    matrix.setFromTriplets(entries.begin(), entries.end());  // sums entries of one place
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors;
    bool const finite = right.allFinite() && std::ranges::all_of(entries, [](auto const& entry) { return std::isfinite(entry.value()); });
    if (finite) factors.compute(matrix);
    if (!finite || factors.info() != Eigen::Success) return std::vector<double>(count, std::nan(""));
    Eigen::VectorXd const slopes = factors.solve(right);
    return {slopes.begin(), slopes.end()};
}

/// 0 where rises differ in sign, else 3 (h₋ + h₊)/((2 h₊ + h₋)/d₋ + (h₊ + 2 h₋)/d₊).
double monotone_slope(Points const& points, std::size_t point) {
    auto const before = points.before(point), behind = points.behind(point);
    if (!before || !behind) return points.rise(before ? *before : *behind);
    double const d0 = points.rise(*before), d1 = points.rise(*behind), h0 = points.width(*before), h1 = points.width(*behind);
    if (d0 * d1 <= 0) return 0;
    return 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
}

}  // namespace

std::optional<PointFault> PieceFunction::fault_of(std::span<double const> places, std::span<double const> values, bool repeats) {
    if (places.size() < 2) return PointFault{0, "a function needs two points at least", "add rows"};
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!std::isfinite(places[i]) || !std::isfinite(values[i])) return PointFault{i, "not a finite number", "use finite numbers"};
        if (i > 0 && places[i] == places[i - 1]) return PointFault{i, "the place stands twice", "remove one of them"};
        if (i > 0 && places[i] < places[i - 1]) return PointFault{i, "the places do not rise", "sort the rows"};
    }
    auto const [least, most] = std::ranges::minmax(values);
    if (repeats && std::abs(values.back() - values.front()) > 1e-6 * (most - least)) {
        return PointFault{values.size() - 1, fmt::format("the period does not close: it begins with {} and ends with {}", values.front(), values.back()),
                          "end with the first value again, or set repeats = false"};
    }
    return std::nullopt;
}

PieceFunction::PieceFunction(std::span<double const> places, std::span<double const> values, Interpolation interpolation, bool repeats)
    : high_(places.back()), repeats_(repeats) {
    // What it grows by each time is a line; the rest closes.
    double const low = places.front();
    advance_ = repeats ? values.back() - values.front() : 0;
    double const rate = advance_ / (high_ - low);
    std::vector<double> closed(values.begin(), values.end());
    for (std::size_t i = 0; rate != 0 && i < closed.size(); ++i) closed[i] -= rate * (places[i] - low);
    Points const points{places, closed, repeats};
    auto const slopes = interpolation == Interpolation::spline ? spline_slopes(points) : std::vector<double>();
    auto const slope = [&](std::size_t part, std::size_t point) {
        if (interpolation == Interpolation::linear) return points.rise(part);
        return interpolation == Interpolation::spline ? slopes[point % slopes.size()] : monotone_slope(points, point);
    };
    for (std::size_t i = 0; i < points.parts(); ++i) {
        double const h = points.width(i), d = points.rise(i), s0 = slope(i, i), s1 = slope(i, i + 1);
        pieces_.push_back({places[i], values[i], s0 + rate, (3 * d - 2 * s0 - s1) / h, (s0 + s1 - 2 * d) / (h * h)});
    }
    find_cells();
}

std::vector<int> first_pieces(std::span<PieceTable::Piece const> pieces, PieceTable const& table) {
    std::vector<int> first;
    int piece = 0;
    for (int cell = 0; cell < table.cells; ++cell) {
        while (piece + 1 < table.count && static_cast<int>(table.cell_of(pieces[static_cast<std::size_t>(piece + 1)].from)) < cell) ++piece;
        first.push_back(piece);
    }
    first.push_back(table.count - 1);
    return first;
}

void PieceFunction::find_cells() {
    first_.assign(pieces_.size() + 1, 0);
    // Beginnings that are rounded are even: values are continuous.  The last piece may be longer.
    double const low = pieces_.front().from, span = pieces_.back().from - low, last = static_cast<double>(pieces_.size() - 1);
    width_ = last > 0 ? span / last : high_ - low;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (std::abs(pieces_[i].from - low - static_cast<double>(i) * width_) > 1e-9 * width_) width_ = 0;
    }
    if (!not_finite()) first_ = first_pieces(pieces_, table());
}

std::optional<std::size_t> PieceFunction::not_finite() const {
    auto const found = std::ranges::find_if(pieces_, [](PieceTable::Piece const& p) {
        return !std::isfinite(p.value) || !std::isfinite(p.slope) || !std::isfinite(p.square) || !std::isfinite(p.cube) || !std::isfinite(p.fourth);
    });
    return found == pieces_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - pieces_.begin()));
}

PieceFunction PieceFunction::integral() const {
    PieceFunction grown = *this;
    double sum = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        auto const& p = pieces_[i];
        double const h = (i + 1 < pieces_.size() ? pieces_[i + 1].from : high_) - p.from;
        grown.pieces_[i] = {p.from, sum, p.value, p.slope / 2, p.square / 3, p.cube / 4};
        sum += h * (p.value + h * (p.slope / 2 + h * (p.square / 3 + h * (p.cube / 4))));
    }
    grown.advance_ = repeats_ ? sum : 0;
    return grown;
}

PieceFunction PieceFunction::less_its_value_at(double place) const {
    PieceFunction shifted = *this;
    double const by = value(place);
    for (auto& piece : shifted.pieces_) piece.value -= by;
    return shifted;
}

PieceFunction PieceFunction::less_a_line(double slope) const {
    PieceFunction tilted = *this;
    for (auto& piece : tilted.pieces_) piece.value -= slope * (piece.from - pieces_.front().from), piece.slope -= slope;
    // Of what it advances by, rounding may be left.
    double const left = advance_ - slope * (high_ - pieces_.front().from);
    tilted.advance_ = std::abs(left) < 1e-12 * std::abs(advance_) ? 0 : left;
    return tilted;
}

PieceFunction PieceFunction::longer_by(double share) const {
    PieceFunction longer = *this;
    longer.high_ += share * (high_ - pieces_.front().from);
    longer.find_cells();
    return longer;
}

PieceFunction::At PieceFunction::at(double place) const {
    double const low = pieces_.front().from, times = repeats_ ? std::floor((place - low) / (high_ - low)) : 0;
    double const inside = std::clamp(place - times * (high_ - low), low, high_);
    auto const behind = std::ranges::upper_bound(pieces_, inside, {}, &PieceTable::Piece::from);
    auto const& piece = behind == pieces_.begin() ? pieces_.front() : *std::prev(behind);
    return {&piece, inside - piece.from, times};
}

double PieceFunction::value(double place) const {
    auto const [p, u, times] = at(place);
    return p->value + u * (p->slope + u * (p->square + u * (p->cube + u * p->fourth))) + times * advance_;
}

double PieceFunction::slope(double place) const {
    auto const [p, u, times] = at(place);
    return p->slope + u * (2 * p->square + u * (3 * p->cube + u * (4 * p->fourth)));
}

template <class See> void PieceFunction::look_at_pieces(See const& see) const {
    constexpr int parts = 8;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        double const from = pieces_[i].from, to = i + 1 < pieces_.size() ? pieces_[i + 1].from : high_;
        for (int part = 0; part < parts; ++part) see(from + (to - from) * part / parts);
    }
    if (!repeats_) see(high_);
}

double PieceFunction::steepest() const {
    double most = 0;
    look_at_pieces([&](double place) { most = std::max(most, std::abs(slope(place))); });
    return most;
}

double PieceFunction::least() const {
    double least = pieces_.front().value;
    look_at_pieces([&](double place) { least = std::min(least, value(place)); });
    return least;
}

double PieceFunction::range() const {
    double high = pieces_.front().value;
    look_at_pieces([&](double place) { high = std::max(high, value(place)); });
    return high - least();
}

PieceTable PieceFunction::table() const {
    PieceTable table;
    table.pieces = pieces_.data(), table.count = static_cast<int>(pieces_.size());
    table.low = pieces_.front().from, table.high = high_, table.repeats = repeats_, table.advance = advance_;
    table.first = first_.data(), table.cells = table.count;
    table.is_even = width_ > 0;
    table.cells_per_unit = table.is_even ? 1 / width_ : table.cells / (table.high - table.low);
    return table;
}

}  // namespace slideway
