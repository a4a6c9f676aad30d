// Points in delay coordinates, seen over the series: nothing is copied.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

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

}  // namespace slideway
