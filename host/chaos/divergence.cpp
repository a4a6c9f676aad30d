#include "host/chaos/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/numbers.hpp"

namespace slideway {
namespace {

struct Moments {
    double mean_x = 0, mean_y = 0;
    double xx = 0, xy = 0, yy = 0;  // about the means
};

/// Two passes: sums of squares about zero would cancel.
Moments moments(std::span<double const> x, std::span<double const> y) {
    Moments m;
    auto const n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        m.mean_x += x[i] / n;
        m.mean_y += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const dx = x[i] - m.mean_x, dy = y[i] - m.mean_y;
        m.xx += dx * dx;
        m.xy += dx * dy;
        m.yy += dy * dy;
    }
    return m;
}

constexpr std::size_t parts = 10;
constexpr std::size_t fewest_points = 4;  // of a window that is chosen
constexpr double share_of_rise = 0.7;
constexpr double periods_wanted = 1.5;
constexpr double share_in_window = 0.5;
constexpr double rounding = 1e-10;  // of the range of the series

/// Sums over pairs, per k.
struct PairSums {
    explicit PairSums(std::size_t longest) : log(longest + 1), pairs(longest + 1) {}
    std::vector<double> log;
    std::vector<std::size_t> pairs;
};

/// [part of i][part of j]: a pair belongs to two stretches of the series.
using PartSums = std::vector<std::vector<PairSums>>;

void add_pair(PairSums& sums, DelayEmbedding const& embedding, std::size_t i, std::size_t j, double resolution) {
    for (std::size_t k = 0; k < sums.log.size(); ++k) {
        double const squared = embedding.squared_distance(i + k, j + k);
        if (!(squared > resolution * resolution)) continue;
        sums.log[k] += 0.5 * std::log(squared);
        ++sums.pairs[k];
    }
}

PartSums sums_by_parts(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler, std::size_t longest) {
    double const resolution = rounding * embedding.range();
    std::vector<Neighbour> const neighbours = nearest_neighbours(embedding, points, theiler, resolution);
    PartSums sums(parts, std::vector<PairSums>(parts, PairSums(longest)));
    for (std::size_t i = 0; i < points; ++i) {
        std::size_t const j = neighbours[i].index;
        if (j == Neighbour::none) continue;
        add_pair(sums[i * parts / points][j * parts / points], embedding, i, j, resolution);
    }
    return sums;
}

double mean_log_of_strangers(DelayEmbedding const& embedding) {
    std::size_t const half = embedding.size() / 2;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < half; ++i) {
        double const squared = embedding.squared_distance(i, i + half);
        if (!(squared > 0)) continue;
        sum += 0.5 * std::log(squared);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : nan;
}

constexpr std::size_t nothing = parts;  // as `omitted`

/// Over the pairs that have neither end in the omitted part.
PairSums sums_without(PartSums const& sums, std::size_t omitted, std::size_t longest) {
    PairSums total(longest);
    for (std::size_t i = 0; i < parts; ++i) {
        for (std::size_t j = 0; j < parts; ++j) {
            if (i == omitted || j == omitted) continue;
            for (std::size_t k = 0; k <= longest; ++k) {
                total.log[k] += sums[i][j].log[k];
                total.pairs[k] += sums[i][j].pairs[k];
            }
        }
    }
    return total;
}

std::vector<double> means(PairSums const& sums, std::size_t length) {
    std::vector<double> mean(length, nan);
    for (std::size_t k = 0; k < length; ++k) {
        if (sums.pairs[k] > 0) mean[k] = sums.log[k] / static_cast<double>(sums.pairs[k]);
    }
    return mean;
}

/// Fits over any window of a curve in constant time.
class WindowFits {
public:
    explicit WindowFits(std::vector<double> const& y) : sums_(y.size() + 1) {
        // About the middle, or the squares would cancel.
        double const middle = static_cast<double>(y.size()) / 2;
        double mean = 0;
        for (double const value : y) mean += value / static_cast<double>(y.size());
        for (std::size_t k = 0; k < y.size(); ++k) {
            double const u = static_cast<double>(k) - middle, v = y[k] - mean;
            Sums const& s = sums_[k];
            sums_[k + 1] = {s.x + u, s.y + v, s.xx + u * u, s.xy + u * v, s.yy + v * v};
        }
    }

    /// Squared, of the slope over [from, to); infinite where the line rises by less than `least_rise`, or not at all.
    double relative_error(std::size_t from, std::size_t to, double least_rise) const {
        Sums const &a = sums_[from], &b = sums_[to];
        double const n = static_cast<double>(to - from), x = b.x - a.x, y = b.y - a.y;
        double const xx = b.xx - a.xx - x * x / n, xy = b.xy - a.xy - x * y / n, yy = b.yy - a.yy - y * y / n;
        if (!(xy > 0) || xy / xx * (n - 1) < least_rise) return std::numeric_limits<double>::infinity();
        return std::max(0.0, yy * xx / (xy * xy) - 1) / (n - 2);
    }

private:
    struct Sums {
        double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    };
    std::vector<Sums> sums_;
};

std::size_t end_of_growth(DivergenceCurve const& curve) {
    double const start = curve.mean_log.front();
    double const level = start + share_of_rise * (curve.saturation - start);
    if (!(level > start)) return curve.mean_log.size();
    auto const reached =
        std::find_if(curve.mean_log.begin(), curve.mean_log.end(), [&](double y) { return y >= level; });
    auto const count = static_cast<std::size_t>(reached - curve.mean_log.begin());
    return std::min(count + 1, curve.mean_log.size());
}

LinearFit fit_part(std::vector<double> const& curve, FitWindow window, double spacing) {
    std::vector<double> time;
    for (std::size_t k = window.first; k <= window.last; ++k) time.push_back(static_cast<double>(k) * spacing);
    return fit_line(time, std::span(curve).subspan(window.first, time.size()));
}

double jackknife_error(DivergenceCurve const& curve, FitWindow window, double spacing) {
    std::vector<double> slopes;
    double mean = 0;
    for (auto const& rest : curve.without) {
        slopes.push_back(fit_part(rest, window, spacing).slope);
        mean += slopes.back() / static_cast<double>(curve.without.size());
    }
    double squares = 0;
    for (double const slope : slopes) squares += (slope - mean) * (slope - mean);
    auto const n = static_cast<double>(slopes.size());
    return std::sqrt((n - 1) / n * squares);
}

double change_with_window(DivergenceCurve const& curve, FitWindow window, double spacing, double slope) {
    std::size_t const step = std::max<std::size_t>(1, (window.last - window.first) / 4);
    double most = 0;
    if (window.first >= step) {
        FitWindow const before{window.first - step, window.last - step};
        most = std::abs(fit_part(curve.mean_log, before, spacing).slope - slope);
    }
    if (window.last + step < curve.mean_log.size()) {
        FitWindow const after{window.first + step, window.last + step};
        most = std::max(most, std::abs(fit_part(curve.mean_log, after, spacing).slope - slope));
    }
    return most;
}

/// Σ(y - ŷ)² of the best line through y over x.
double unexplained(std::span<double const> x, std::span<double const> y) {
    Moments const m = moments(x, y);
    return std::max(0.0, m.yy - m.xy * m.xy / m.xx);
}

/// Unexplained by a line over ln k, over that by a line over k; from k = 1, where there is a logarithm.
double power_over_line(DivergenceCurve const& curve, std::size_t last) {
    std::vector<double> k, log_k;
    for (std::size_t i = 1; i <= last; ++i) {
        k.push_back(static_cast<double>(i));
        log_k.push_back(std::log(k.back()));
    }
    if (k.size() < 3) return 0;
    auto const y = std::span(curve.mean_log).subspan(1, k.size());
    return unexplained(log_k, y) / std::max(unexplained(k, y), std::numeric_limits<double>::min());
}

}  // namespace

LinearFit fit_line(std::span<double const> x, std::span<double const> y) {
    LinearFit fit{nan, nan, nan, nan, x.size()};
    if (x.size() != y.size() || x.size() < 2) return fit;
    Moments const m = moments(x, y);
    if (!(m.xx > 0) || !std::isfinite(m.xx + m.yy)) return fit;
    fit.slope = m.xy / m.xx;
    fit.intercept = m.mean_y - fit.slope * m.mean_x;
    double residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const r = (y[i] - m.mean_y) - fit.slope * (x[i] - m.mean_x);
        residual += r * r;
    }
    if (x.size() > 2) fit.slope_error = std::sqrt(residual / (static_cast<double>(x.size() - 2) * m.xx));
    if (m.yy > 0) fit.r_squared = std::clamp(1 - residual / m.yy, 0.0, 1.0);
    return fit;
}

DivergenceCurve divergence_curve(DelayEmbedding const& embedding, std::size_t theiler, std::size_t longest) {
    DivergenceCurve curve{{}, {}, mean_log_of_strangers(embedding), {}};
    if (embedding.size() <= longest + 1) return curve;
    PartSums const sums = sums_by_parts(embedding, embedding.size() - longest, theiler, longest);
    PairSums const all = sums_without(sums, nothing, longest);
    auto const length = std::find(all.pairs.begin(), all.pairs.end(), std::size_t{0}) - all.pairs.begin();
    curve.pairs.assign(all.pairs.begin(), all.pairs.begin() + length);
    curve.mean_log = means(all, curve.pairs.size());
    for (std::size_t part = 0; part < parts; ++part) {
        curve.without.push_back(means(sums_without(sums, part, longest), curve.pairs.size()));
    }
    return curve;
}

std::optional<FitWindow> growth_window(DivergenceCurve const& curve, std::size_t span, double period) {
    if (curve.mean_log.size() < fewest_points) return std::nullopt;
    std::size_t const end = end_of_growth(curve), start = std::min(span / 2, end / 3);
    if (end - start < fewest_points) return std::nullopt;
    std::size_t const two_thirds = (end - start) * 2 / 3;
    auto const most = static_cast<double>(two_thirds);
    double const wanted = std::isfinite(period) ? std::min(periods_wanted * period, most) : most;
    std::size_t const shortest = std::max(fewest_points, static_cast<std::size_t>(wanted));

    WindowFits const fits(curve.mean_log);
    double const least_rise = share_in_window * (curve.mean_log[end - 1] - curve.mean_log[start]);
    double least = std::numeric_limits<double>::infinity();
    std::optional<FitWindow> best;
    for (std::size_t from = start; from + shortest <= end; ++from) {
        for (std::size_t to = from + shortest; to <= end; ++to) {
            double const error = fits.relative_error(from, to, least_rise);
            if (!(error < least)) continue;
            least = error;
            best = FitWindow{from, to - 1};
        }
    }
    return best;
}

std::optional<Growth> fit_growth(DivergenceCurve const& curve, FitWindow window, double spacing) {
    if (window.last <= window.first || window.last >= curve.mean_log.size()) return std::nullopt;
    LinearFit const line = fit_part(curve.mean_log, window, spacing);
    double const length = static_cast<double>(window.last - window.first) * spacing;
    return Growth{window,
                  line,
                  line.slope,
                  jackknife_error(curve, window, spacing),
                  line.slope * length,
                  power_over_line(curve, window.last),
                  change_with_window(curve, window, spacing, line.slope)};
}

}  // namespace slideway
