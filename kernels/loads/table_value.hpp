#pragma once

#include "kernels/loads/load_list.hpp"
#include "kernels/math/tangent.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A table's value and its first three derivatives.
template <class Real> struct TablePoint { Real value, slope, bend, jerk; };

/// The piece of a table that a place within it is in, which is in a cell.
SLIDEWAY_FN PieceTable::Piece const& piece_at(PieceTable const& table, double at, double cell) {
    int const found = static_cast<int>(cell);
    int piece = table.first[found], last = table.first[found + 1];
    while (piece < last) {
        int const middle = piece + (last - piece + 1) / 2;
        if (table.pieces[middle].from <= at) piece = middle;
        else last = middle - 1;
    }
    return table.pieces[piece];
}

/// In all lanes, which look their pieces up one by one: those lie anywhere.  NaN at what is no number.
template <class Real> SLIDEWAY_FN TablePoint<Real> table_point(PieceTable const& table, Real const& place) {
    Real const zero(0.0), two(2.0), three(3.0), low(table.low), high(table.high), nothing = place - place;
    Real at = select(nothing == zero, place, low), times = zero;
    Mask<Real> inside = mask_of<Real>(true);
    if (table.repeats) {
        times = rounded_down((at - low) / (high - low));
        at = fnma(times, high - low, at);
    } else {
        inside = Mask<Real>((at >= low) & (at <= high));
    }
    // Of places so far away that nothing is known of their phase, too.
    at = min(max(at, low), high);
    Real const cell = min((at - low) * Real(table.cells_per_unit), Real(table.cells - 1.0));
    PieceTable::Piece const* pieces[lanes<Real>];
    for (int i = 0; i < lanes<Real>; ++i) pieces[i] = table.is_even ? &table.pieces[static_cast<int>(lane(cell, i))] : &piece_at(table, lane(at, i), lane(cell, i));
    auto const number = [&](double PieceTable::Piece::* of) { return of_lanes<Real>([&](int i) { return pieces[i]->*of; }); };
    using Piece = PieceTable::Piece;
    Real const u = at - number(&Piece::from), fourth = number(&Piece::fourth), third = number(&Piece::cube), square = number(&Piece::square);
    Real const first = number(&Piece::slope), cube = fma(u, fourth, third);
    Real const value = fma(times, Real(table.advance), fma(u, fma(u, fma(u, cube, square), first), number(&Piece::value)));
    Real const slope = fma(u, fma(u, fma(u, Real(4.0) * fourth, three * third), two * square), first);
    Real const bend = fma(u, fma(Real(12.0) * u, fourth, Real(6.0) * third), two * square), jerk = fma(Real(24.0) * u, fourth, Real(6.0) * third);
    return {value + nothing, select(inside, slope, zero) + nothing, select(inside, bend, zero) + nothing, select(inside, jerk, zero) + nothing};
}

/// The value alone.
template <class Real> SLIDEWAY_NOINLINE Real table_value(PieceTable const& table, Real const& at) {
    if constexpr (is_tangent<Real>) {
        auto const point = table_point(table, at.value);
        return {point.value, point.slope * at.slope};
    } else {
        return table_point(table, at).value;
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
