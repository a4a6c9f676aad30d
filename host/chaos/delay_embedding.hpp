// Points in delay coordinates, seen over the series: nothing is copied; and who is nearest in them, though far in time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace slideway {

/// Xᵢ = (xᵢ, xᵢ₊τ, …, xᵢ₊₍ₘ₋₁₎τ), i = 0 … n - 1 with n = N - (m - 1)τ (Takens 1981; Packard et al. 1980).
/// The series must outlive the view.  No points if the series is shorter than (m - 1)τ, or τ or m is zero.
class DelayEmbedding {
public:
    /// @param delay τ in samples, ≥ 1.  @param dimension m ≥ 1.
    DelayEmbedding(std::span<double const> series, std::size_t delay, std::size_t dimension)
        : series_(series), delay_(delay), dimension_(dimension) {}

    std::size_t delay() const { return delay_; }
    std::size_t dimension() const { return dimension_; }
    std::size_t span() const { return (dimension_ - 1) * delay_; }  // samples from the first coordinate to the last
    std::size_t size() const {
        if (delay_ == 0 || dimension_ == 0 || series_.size() <= span()) return 0;
        return series_.size() - span();
    }
    double operator()(std::size_t point, std::size_t coordinate) const { return series_[point + coordinate * delay_]; }

    double range() const {  // of the series; 0 for an empty one
        if (series_.empty()) return 0;
        auto const [low, high] = std::minmax_element(series_.begin(), series_.end());
        return *high - *low;
    }

    /// Euclidean, squared; in squared units of the series.
    double squared_distance(std::size_t i, std::size_t j) const {
        double sum = 0;
        for (std::size_t at = 0; at <= span(); at += delay_) {
            double const difference = series_[i + at] - series_[j + at];
            sum += difference * difference;
        }
        return sum;
    }

private:
    std::span<double const> series_;
    std::size_t delay_, dimension_;
};

struct Neighbour {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t index = none;
    double distance = std::numeric_limits<double>::quiet_NaN();  // Euclidean
};

/// For each of the first `points` points Xᵢ the nearest Xⱼ among them with |i - j| > theiler (Theiler 1986) and
/// |Xᵢ - Xⱼ| > resolution: the distance to a repeated point is none, or rounding, and tells nothing by its growth.  Of equally
/// near ones the first.
/// @param points at most embedding.size(); the points behind them are neither asked nor found.
/// @param resolution in units of the series, ≥ 0.
/// @return one entry per point; `none` where no point is left.
std::vector<Neighbour> nearest_neighbours(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler,
                                          double resolution = 0);

// Delay and window of an embedding from correlation sums: the C–C method.

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
