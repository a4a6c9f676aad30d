#pragma once

#include "kernels/loads/load_list.hpp"
#include "kernels/math/tangent.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A table's value and its first three derivatives.
struct TablePoint { double value, slope, bend, jerk; };

/// The piece of a table that a place within it is in.
SLIDEWAY_HD inline PieceTable::Piece const& piece_at(PieceTable const& table, double at) {
    int const found = static_cast<int>((at - table.low) * table.cells_per_unit), cell = found < table.cells ? found : table.cells - 1;
    int piece = table.first[cell], last = cell + 1 < table.cells ? table.first[cell + 1] : table.count - 1;
    while (piece < last) {
        int const middle = piece + (last - piece + 1) / 2;
        if (table.pieces[middle].from <= at) piece = middle;
        else last = middle - 1;
    }
    // Beginnings of cells are rounded: the piece may begin a hair behind, or the next one before.
    while (piece + 1 < table.count && table.pieces[piece + 1].from <= at) ++piece;
    while (piece > 0 && table.pieces[piece].from > at) --piece;
    return table.pieces[piece];
}

/// At one place.  NaN at what is no number.
SLIDEWAY_HD inline TablePoint table_point(PieceTable const& table, double at) {
    if (!(at - at == 0)) return {at - at, at - at, at - at, at - at};
    bool const inside = table.repeats || (at >= table.low && at <= table.high);
    double times = 0;
    if (table.repeats) {
        times = ::floor((at - table.low) / (table.high - table.low));
        at = fnma(times, table.high - table.low, at);
    }
    // Of places so far away that nothing is known of their phase, too.
    at = min(max(at, table.low), table.high);
    auto const& p = piece_at(table, at);
    double const u = at - p.from, cube = fma(u, p.fourth, p.cube);
    double const value = fma(times, table.advance, fma(u, fma(u, fma(u, cube, p.square), p.slope), p.value));
    if (!inside) return {value, 0, 0, 0};
    double const slope = fma(u, fma(u, fma(u, 4 * p.fourth, 3 * p.cube), 2 * p.square), p.slope);
    return {value, slope, fma(u, fma(12 * u, p.fourth, 6 * p.cube), 2 * p.square), fma(24 * u, p.fourth, 6 * p.cube)};
}

/// The values of a table in all lanes, and its slopes.  Lanes look theirs up one by one: pieces lie anywhere.
template <class Real> SLIDEWAY_HD void table_values(PieceTable const& table, Real const& at, Real& value, Real& slope) {
    for (int i = 0; i < lanes<Real>; ++i) {
        auto const point = table_point(table, lane(at, i));
        set_lane(value, i, point.value);
        set_lane(slope, i, point.slope);
    }
}

/// The values alone.
template <class Real> SLIDEWAY_HD Real table_value(PieceTable const& table, Real const& at) {
    if constexpr (is_tangent<Real>) {
        using Number = decltype(at.value);
        Number value = at.value, slope = at.value;
        table_values(table, at.value, value, slope);
        return {value, slope * at.slope};
    } else {
        Real value = at;
        for (int i = 0; i < lanes<Real>; ++i) set_lane(value, i, table_point(table, lane(at, i)).value);
        return value;
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
