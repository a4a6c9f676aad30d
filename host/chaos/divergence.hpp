// How fast neighbours part: the largest Lyapunov exponent of small data sets.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "host/chaos/delay_embedding.hpp"

namespace slideway {

/// y ≈ intercept + slope·x.
struct LinearFit {
    double slope, intercept;
    double slope_error;  // standard error of the slope; NaN for two points
    double r_squared;    // 1 - Σ(y - ŷ)²/Σ(y - ȳ)², in [0, 1]; NaN if all y are the same
    std::size_t points;
};

/// Ordinary least squares.  With x̄, ȳ the means and Sxx = Σ(x - x̄)², Sxy = Σ(x - x̄)(y - ȳ):
/// slope = Sxy/Sxx, intercept = ȳ - slope·x̄, slope_error² = Σ(y - ŷ)²/((n - 2) Sxx).  The standard error takes the
/// residuals as independent; those of a smooth curve are not, and then it is too small.
/// @param x, y of one length, any units.
/// @return all NaN for less than two points, numbers that are not finite or one x only.
LinearFit fit_line(std::span<double const> x, std::span<double const> y);

/// Rosenstein, Collins and De Luca, Physica D 65 (1993) 117–134: with Xⱼ the nearest neighbour of Xᵢ (delay_embedding.hpp),
/// dᵢ(k) = |Xᵢ₊ₖ - Xⱼ₊ₖ| grows as e^(λ₁ k Δt) until it is as large as the attractor.
struct DivergenceCurve {
    std::vector<double> mean_log;    // ⟨ln dᵢ(k)⟩ for k = 0, 1, …; d in units of the series
    std::vector<std::size_t> pairs;  // that the mean is of: those with a distance
    /// ⟨ln d⟩ of points that have nothing to do with each other, half the series apart: where the growth ends.
    double saturation;
    /// [part][k]: the curve of the pairs that have neither point in one of ten successive parts of the series.
    std::vector<std::vector<double>> without;
};

/// Deviates from the paper in one point: only points with `longest` samples behind them are paired, so that every pair
/// lives at all k, and the curve does not change for a change of pairs.  It ends before a k at which no pair has a
/// distance; what is below 1e-10 of the range of the series is rounding and counts as none.
/// @param theiler neighbours are more than this many samples apart in time.  @param longest largest k [samples].
/// @return curves without entries if no pair is found.
DivergenceCurve divergence_curve(DelayEmbedding const& embedding, std::size_t theiler, std::size_t longest);

/// Samples k of the curve, both included.
struct FitWindow {
    std::size_t first, last;
};

/// Where the curve is most nearly a line.  Let k₁ be the first k at which it has done 0.7 of its way from its start to
/// saturation, or its end: beyond, too many pairs have grown to the size of the attractor.  k₀ is half of the embedding
/// window, in which coordinates still remember that the neighbours were chosen near, at most k₁/3.  Candidates are all windows
/// within [k₀, k₁] of at least four points that last one and a half periods, so that the swing of the curve with the period
/// averages out, or two thirds of k₁ - k₀ if that is shorter, and whose line makes at least half of the rise from k₀ to k₁: a slow
/// stretch is not the growth.  Taken is the one whose slope has the least relative standard error: it falls with a window's
/// length to the power 3/2 and rises with every bend.
/// @param span (m - 1)τ [samples].  @param period on average [samples]; NaN: unknown.
/// @return nothing if there are less than four points between k₀ and k₁, or the curve rises in no window.
std::optional<FitWindow> growth_window(DivergenceCurve const& curve, std::size_t span, double period);

struct Growth {
    FitWindow window;
    LinearFit line;     // ⟨ln d⟩ over time
    double exponent;    // λ₁ = line.slope [1/unit of spacing]
    double error;       // standard error of λ₁ by the jackknife over the parts of `without`
    double rise;        // exponent times the length of the window: e-foldings seen
    double of_power;    // squares of the curve, up to the window's end, that a power of time leaves, over those that a line leaves
    double systematic;  // what the choice of window changes, and what a caller knows besides [as the exponent]

    /// Of the 95 % interval: Student's t of ten parts times the error, and the systematic part in full.
    double chance() const { return 2.262 * error; }
    double half_width() const { return chance() + systematic; }
    bool is_beyond_a_power() const { return of_power >= 5; }
};

/// Line through the curve in the window.  The error of the regression takes the points of the curve as independent, which
/// they are not; the jackknife asks how the slope changes with the stretches of trajectory that happened to be there.  A pair
/// counts for both its stretches, which is cautious: over 5,000 points of Lorenz the error is half as large again as the scatter.
/// Systematic: the most that the slope changes where the window is moved by a quarter of its length, to either side; the jackknife
/// cannot see a bend that all stretches share.
/// Distances that grow like a power of time, d ~ k^p (a drifting frequency: p = 1), have a slope too, p over the length of the
/// window.  So ⟨ln d⟩ from k = 1 to the end of the window is fitted by a + b k and by a + p ln k: growth is beyond a power where the
/// line leaves a fifth of the power's squares or less.  The window alone, chosen for its straightness, tells less.  Of 43 Lorenz and
/// Rössler series of 1,000 to 5,000 samples the line leaves at most 0.17 in 41, of 24 chirps at least 0.6, of 7 walking phases 3 and
/// more, of 23 walking frequencies 0.01 to 1.8, more than a fifth in 14.
/// @param spacing of samples.  @return nothing for a window with less than two points or outside the curve.
std::optional<Growth> fit_growth(DivergenceCurve const& curve, FitWindow window, double spacing);

}  // namespace slideway
