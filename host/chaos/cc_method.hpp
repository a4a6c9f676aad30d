// Delay and window of an embedding from correlation sums: the C–C method.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace slideway {

/// Curves over t = 1 … longest; element t - 1 belongs to t.
struct CcCurves {
    std::vector<double> mean;         // S̄(t)
    std::vector<double> spread;       // ΔS̄(t)
    std::vector<double> correlation;  // S_cor(t)
    std::size_t points = 0;           // samples used, from the first on
};

struct CcOptions {
    std::size_t longest = 200;        // largest t [samples]
    std::size_t max_points = 10'000;  // only the first so many samples are used; the cost grows with their square
};

/// Kim, Eykholt and Salas, Physica D 127 (1999) 48–60.  For every t the series is split into t disjoint ones, xₛ, xₛ₊ₜ,
/// xₛ₊₂ₜ …; with the correlation sum C of each in m successive samples and the maximum norm (share of pairs not farther
/// apart than r), S(m, r, t) = mean over s of C(m, r) - C(1, r)^m.  Over m = 2 … 5 and r = σ/2, σ, 3σ/2, 2σ, σ the
/// standard deviation of the whole series:
///   S̄(t) = mean of S over m and r,  ΔS̄(t) = mean over m of (max over r of S - min over r of S),  S_cor = ΔS̄ + |S̄|.
/// All pairs are counted: N²/(2t) of them for each t.
/// @param series equally spaced, any unit.
/// @return curves that end early where a part would have less than 10 samples; empty for a series that is constant or
/// not finite.
CcCurves cc_curves(std::span<double const> series, CcOptions const& options = {});

/// What is read off the curves, in samples.
struct CcChoice {
    std::optional<std::size_t> first_zero;  // of S̄: first t with S̄(t) ≤ 0
    std::optional<std::size_t> first_minimum;  // of ΔS̄: first t whose ΔS̄ is the least within two samples on both sides
    std::optional<std::size_t> window;         // τ_w: where S_cor is least
    /// τ: the first minimum of ΔS̄, without one the first zero of S̄.  Kim et al. name both; on chaotic flows S̄ may
    /// stay just above zero for long, so that the minimum is the steadier of them.
    std::optional<std::size_t> delay() const { return first_minimum ? first_minimum : first_zero; }
};

CcChoice cc_choice(CcCurves const& curves);

}  // namespace slideway
