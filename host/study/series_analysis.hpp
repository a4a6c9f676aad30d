// From a stored series to a statement on chaos: average period, delay and window, divergence of neighbours, 0–1 test.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/chaos/delay_embedding.hpp"
#include "host/chaos/divergence.hpp"
#include "host/chaos/zero_one_test.hpp"

namespace slideway {

/// What the user fixes; the rest is found.
struct SeriesOptions {
    std::optional<std::size_t> delay = {};      // [samples]
    std::optional<std::size_t> dimension = {};  // coordinates
    std::optional<std::size_t> theiler = {};    // [samples]
    std::optional<FitWindow> fit = {};          // [samples]
};

struct SeriesAnalysis {
    std::size_t points;
    double spacing;         // [s]
    double average_period;  // [s]
    bool from_map;          // few samples per period: iterates of a map, not a sampled motion

    CcCurves curves;
    CcChoice choice;
    std::size_t delay, window, dimension, theiler;  // window = (m - 1)τ
    std::size_t wanted_dimension;                   // what the C–C window asks for, before it was cut to the points

    DivergenceCurve divergence;
    /// Its systematic part: change with the window, with one coordinate more or less, and of sampled motions a fifth of the exponent; all
    /// of the exponent where a power of time fits as well, for then there may be none.
    std::optional<Growth> growth;
    ZeroOneTest zero_one;
    std::size_t stride;  // of the 0–1 test [samples]

    bool few_points() const;             // fewer than 10^(m/2), the least for dimension m (Eckmann and Ruelle 1992)
    bool growth_is_seen() const;         // exponent > 2 standard errors, and distances at least double in the window
    bool growth_is_exponential() const;  // seen, along a line, and beyond a power of time
};

/// τ: C–C; one sample if the average period is shorter than six, for then the series is taken as iterates of a map.
/// m = τ_w/τ + 1 rounded with τ_w of C–C (three for a map), from 2 to 2·log₁₀ N.  Theiler window: the average period.
/// @param series equally spaced, any unit.  @param spacing [s], > 0.
/// @throws SceneError for a series that is constant, has NaN or has less than 100 samples, and for options that do not fit it.
SeriesAnalysis analyse_series(std::span<double const> series, double spacing, SeriesOptions const& options = {});

/// One line; no more than the numbers allow.
std::string verdict(SeriesAnalysis const& analysis);

/// What weakens the verdict, one line each.
std::vector<std::string> reservations(SeriesAnalysis const& analysis);

}  // namespace slideway
