#include "host/chaos/delay_embedding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>

namespace slideway {
namespace {

/// The embedding in the words of nanoflann.
struct Points {
    DelayEmbedding const& embedding;
    std::size_t count;

    std::size_t kdtree_get_point_count() const { return count; }
    double kdtree_get_pt(std::size_t point, std::size_t coordinate) const { return embedding(point, coordinate); }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, -1, std::size_t>;

/// Keeps the one nearest point that counts as a neighbour; the tree skips whatever lies beyond it.
class NearestOutsideWindow {
public:
    NearestOutsideWindow(std::size_t self, std::size_t theiler, double resolution)
        : self_(self), theiler_(theiler), least_(resolution * resolution) {}

    // NOLINTNEXTLINE(readability-identifier-naming): the tree calls it so
    bool addPoint(double squared, std::size_t index) {
        std::size_t const apart = index > self_ ? index - self_ : self_ - index;
        if (apart <= theiler_ || !(squared > least_)) return true;
        // The order in which the tree finds points shall not show.
        if (squared < squared_ || (squared == squared_ && index < index_)) {
            squared_ = squared;
            index_ = index;
        }
        return true;
    }
    // The tree asks for less than this; equally near ones shall come too.
    // NOLINTNEXTLINE(readability-identifier-naming): the tree calls it so
    double worstDist() const { return std::nextafter(squared_, std::numeric_limits<double>::infinity()); }
    bool full() const { return index_ != Neighbour::none; }
    std::size_t size() const { return full() ? 1 : 0; }
    Neighbour result() const { return full() ? Neighbour{index_, std::sqrt(squared_)} : Neighbour{}; }

private:
    std::size_t self_, theiler_;
    double least_;
    std::size_t index_ = Neighbour::none;
    double squared_ = std::numeric_limits<double>::max();
};

}  // namespace

std::vector<Neighbour> nearest_neighbours(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler,
                                          double resolution) {
    points = std::min(points, embedding.size());
    std::vector<Neighbour> neighbours(points);
    if (points < 2) return neighbours;
    Points const adaptor{embedding, points};
    Tree const tree(static_cast<int>(embedding.dimension()), adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    std::vector<double> query(embedding.dimension());
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t k = 0; k < query.size(); ++k) query[k] = embedding(i, k);
        NearestOutsideWindow nearest(i, theiler, resolution);
        tree.findNeighbors(nearest, query.data(), nanoflann::SearchParams());
        neighbours[i] = nearest.result();
    }
    return neighbours;
}

namespace {

constexpr int largest_dimension = 5;
constexpr int radii = 4;
constexpr std::size_t shortest_part = 10;  // samples
constexpr std::size_t either_side = 2;     // samples that a minimum has to undercut

using Radii = std::array<double, radii>;
/// [m - 1][j]: pairs within rⱼ, then their share.
using Counts = std::array<std::array<double, radii>, largest_dimension>;

/// 0 for a constant, whatever its mean rounds to.
double standard_deviation(std::span<double const> series) {
    auto const [low, high] = std::minmax_element(series.begin(), series.end());
    if (*low == *high) return 0;
    auto const n = static_cast<double>(series.size());
    double mean = 0, squares = 0;
    for (double const x : series) mean += x / n;
    for (double const x : series) squares += (x - mean) * (x - mean);
    return std::sqrt(squares / (n - 1));
}

/// Level of a distance: how many of the radii it exceeds.  The level of a maximum is the maximum of levels, so that
/// after this loop bytes are enough.
void levels(std::span<double const> x, std::size_t lag, Radii const& r, std::span<std::uint8_t> out) {
    double const r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3];
    for (std::size_t i = 0; i + lag < x.size(); ++i) {
        double const d = std::abs(x[i] - x[i + lag]);
        out[i] = static_cast<std::uint8_t>((d > r0) + (d > r1) + (d > r2) + (d > r3));
    }
}

std::array<std::uint32_t, radii> count_levels(std::span<std::uint8_t const> level) {
    std::uint32_t c0 = 0, c1 = 0, c2 = 0, c3 = 0;
    for (std::uint8_t const l : level) {
        c0 += l <= 0;
        c1 += l <= 1;
        c2 += l <= 2;
        c3 += l <= 3;
    }
    return {c0, c1, c2, c3};
}

/// Correlation sums of one part.  All pairs of one lag together: the distance in m + 1 samples is the larger of that in
/// m and that of the next sample, m places on in the same row.
Counts correlation_sums(std::span<double const> x, Radii const& r, std::vector<std::uint8_t>& row,
                        std::vector<std::uint8_t>& largest) {
    Counts sums{};
    for (std::size_t lag = 1; lag < x.size(); ++lag) {
        std::size_t const pairs = x.size() - lag;
        levels(x, lag, r, row);
        std::copy_n(row.begin(), pairs, largest.begin());
        for (std::size_t m = 1; m <= largest_dimension && pairs >= m; ++m) {
            std::size_t const left = pairs - (m - 1);
            std::uint8_t const* const next = row.data() + (m - 1);
            std::uint8_t* const so_far = largest.data();
            for (std::size_t i = 0; i < left; ++i) so_far[i] = std::max(so_far[i], next[i]);
            auto const counted = count_levels(std::span(so_far, left));
            for (std::size_t j = 0; j < radii; ++j) sums[m - 1][j] += counted[j];
        }
    }
    for (std::size_t m = 1; m <= largest_dimension; ++m) {
        auto const points = static_cast<double>(x.size() - (m - 1));
        for (double& sum : sums[m - 1]) sum /= points * (points - 1) / 2;
    }
    return sums;
}

/// S(m, r, t) for m from 2 on: the mean over the t parts.
Counts dependence(std::span<double const> series, std::size_t t, Radii const& r) {
    Counts total{};
    std::size_t const length = series.size() / t;  // the same for all parts
    std::vector<double> part(length);
    std::vector<std::uint8_t> row(length), largest(length);
    for (std::size_t s = 0; s < t; ++s) {
        for (std::size_t i = 0; i < length; ++i) part[i] = series[s + i * t];
        Counts const sums = correlation_sums(part, r, row, largest);
        for (std::size_t m = 2; m <= largest_dimension; ++m) {
            for (std::size_t j = 0; j < radii; ++j) {
                double const independent = std::pow(sums[0][j], static_cast<double>(m));
                total[m - 1][j] += (sums[m - 1][j] - independent) / static_cast<double>(t);
            }
        }
    }
    return total;
}

}  // namespace

CcCurves cc_curves(std::span<double const> series, CcOptions const& options) {
    series = series.first(std::min(series.size(), options.max_points));
    CcCurves curves;
    curves.points = series.size();
    if (series.size() < shortest_part) return curves;
    double const sigma = standard_deviation(series);
    if (!(sigma > 0) || !std::isfinite(sigma)) return curves;
    Radii const r{sigma / 2, sigma, 1.5 * sigma, 2 * sigma};

    for (std::size_t t = 1; t <= options.longest && series.size() / t >= shortest_part; ++t) {
        Counts const s = dependence(series, t, r);
        double mean = 0, spread = 0;
        for (std::size_t m = 2; m <= largest_dimension; ++m) {
            auto const& row = s[m - 1];
            for (double const value : row) mean += value / ((largest_dimension - 1) * radii);
            auto const [low, high] = std::minmax_element(row.begin(), row.end());
            spread += (*high - *low) / (largest_dimension - 1);
        }
        curves.mean.push_back(mean);
        curves.spread.push_back(spread);
        curves.correlation.push_back(spread + std::abs(mean));
    }
    return curves;
}

CcChoice cc_choice(CcCurves const& curves) {
    CcChoice choice;
    std::size_t const count = curves.mean.size();
    for (std::size_t i = 0; i < count && !choice.first_zero; ++i) {
        if (curves.mean[i] <= 0) choice.first_zero = i + 1;
    }
    for (std::size_t i = 1; i + 1 < count && !choice.first_minimum; ++i) {
        std::size_t const from = i - std::min(i, either_side), to = std::min(i + either_side, count - 1);
        auto const least = std::min_element(curves.spread.begin() + static_cast<std::ptrdiff_t>(from),
                                            curves.spread.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        if (least - curves.spread.begin() == static_cast<std::ptrdiff_t>(i)) choice.first_minimum = i + 1;
    }
    if (count > 0) {
        auto const least = std::min_element(curves.correlation.begin(), curves.correlation.end());
        choice.window = static_cast<std::size_t>(least - curves.correlation.begin()) + 1;
    }
    return choice;
}

}  // namespace slideway
