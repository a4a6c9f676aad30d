// Points in delay coordinates, seen over the series: nothing is copied; and who is nearest in them, though far in time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
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

}  // namespace slideway
