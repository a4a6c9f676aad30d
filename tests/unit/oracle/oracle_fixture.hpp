// What the tests of the oracle share: its cases, sums over the sixteen pairs, and a numeric derivative.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"

namespace oracle::testing {

/// Contacts by kind: surfaces, lines, points.
using Triple = std::tuple<int, int, int>;

inline constexpr std::uint64_t seed = 20200103717;

inline Result evaluate(Case const& c) { return oracle::evaluate(c.inputs, c.parts, c.t, c.state, &c.impact_speeds); }

inline Pairs joined(std::array<double, 8> const& y, std::array<double, 8> const& z) {
    Pairs all;
    std::copy(y.begin(), y.end(), all.begin());
    std::copy(z.begin(), z.end(), all.begin() + 8);
    return all;
}

inline double sum(Pairs const& values) {
    double total = 0;
    for (double value : values) total += value;
    return total;
}

/// Distance of the nearest pair from changing its contact.
inline double margin(Result const& r) {
    double least = std::numeric_limits<double>::infinity();
    for (double depth : joined(r.pen_y, r.pen_z)) least = std::min(least, std::abs(depth));
    return least;
}

/// Roll and pitch that leave one apex of the bottom face in contact, 1 µm deep, at rest: P3 (-,-,+).
inline Case on_one_apex() {
    Case c;
    c.inputs = completed({});
    c.state[4] = 1e-3, c.state[6] = 1e-3;
    Pairs const level = penetrations(c.inputs, c.parts, 0, c.state);
    double const lowest = std::max({level[1], level[2], level[5], level[6]});
    // Going up deepens the pairs of the way's bottom by n_y, the Y component of the slider's Y axis.
    c.state[0] = (1e-6 - lowest) / (std::cos(1e-3) * std::cos(1e-3));
    return c;
}

/// (f(h) - f(-h))/2h without its h² error.
inline double slope(std::function<double(double)> const& f, double h) {
    auto const central = [&](double step) { return (f(step) - f(-step)) / (2 * step); };
    return (4 * central(h) - central(2 * h)) / 3;
}

}  // namespace oracle::testing
