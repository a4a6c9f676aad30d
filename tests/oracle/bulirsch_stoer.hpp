// Gragg's midpoint rule, extrapolated: a step of high order that tells its error (Bulirsch & Stoer 1966).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace oracle::detail {

/// The midpoint rule with an even number of substeps; its error has even powers of the substep alone.
template <class State, class Real, class Rates>
State midpoint_rule(State const& start, Real h, int substeps, Rates const& rates) {
    Real const piece = h / substeps;
    auto const moved = [](State from, Real by, State const& along) {
        for (std::size_t i = 0; i < from.size(); ++i) from[i] += by * along[i];
        return from;
    };
    State before = start, now = moved(start, piece, rates(start));
    for (int i = 1; i < substeps; ++i) {
        State const next = moved(before, 2 * piece, rates(now));
        before = now, now = next;
    }
    State const beyond = moved(before, 2 * piece, rates(now));
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = (before[i] + 2 * now[i] + beyond[i]) / 4;
    return now;
}

/// A step of order 2 `columns`.  @param rates of a state, which is an array of numbers  @param scale what error of each number counts as one
/// @return the state, and its error by the last extrapolation
template <int columns, class State, class Real, class Rates>
std::pair<State, Real> extrapolated(State const& start, Real h, Rates const& rates, State const& scale) {
    std::array<State, columns> row{}, above{};
    for (int k = 0; k < columns; ++k) {
        row[0] = midpoint_rule(start, h, 2 * (k + 1), rates);
        for (int j = 1; j <= k; ++j) {
            Real const ratio = Real(k + 1) / Real(k + 1 - j), part = 1 / (ratio * ratio - 1);
            auto const at = static_cast<std::size_t>(j);
            for (std::size_t i = 0; i < start.size(); ++i)
                row[at][i] = row[at - 1][i] + part * (row[at - 1][i] - above[at - 1][i]);
        }
        above = row;
    }
    Real error = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        error = std::max(error, std::abs(row[columns - 1][i] - row[columns - 2][i]) / scale[i]);
    return {row[columns - 1], error};
}

}  // namespace oracle::detail
