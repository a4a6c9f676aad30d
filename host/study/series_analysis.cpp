#include "host/study/series_analysis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/chaos/power_spectrum.hpp"

namespace slideway {
namespace {

constexpr std::size_t fewest_samples = 100;
constexpr double map_period = 6;  // [samples]
constexpr std::size_t map_dimension = 3;
constexpr double straight = 0.95;  // least R² of a line
constexpr double regular_k = 0.2, chaotic_k = 0.8;

void require_usable(std::span<double const> series) {
    auto const bad = std::find_if(series.begin(), series.end(), [](double x) { return !std::isfinite(x); });
    if (bad != series.end()) {
        auto const count = std::count_if(bad, series.end(), [](double x) { return !std::isfinite(x); });
        throw SceneError(
            fmt::format("{} of the {} samples are no finite numbers, sample {} is the first (a member that "
                        "failed leaves NaN); use a whole series",
                        count, series.size(), bad - series.begin()));
    }
    if (series.size() < fewest_samples) {
        throw SceneError(
            fmt::format("the series has {} samples; at least {} are needed", series.size(), fewest_samples));
    }
}

/// Of C–C, sought where at least two coordinates fit in.
std::size_t cc_window(CcCurves const& curves, std::size_t delay) {
    if (curves.correlation.size() <= delay) return delay;
    auto const from = curves.correlation.begin() + static_cast<std::ptrdiff_t>(delay) - 1;
    return static_cast<std::size_t>(std::min_element(from, curves.correlation.end()) - curves.correlation.begin()) + 1;
}

void choose_embedding(SeriesAnalysis& analysis, std::span<double const> series, SeriesOptions const& options) {
    double const period = analysis.average_period / analysis.spacing;
    auto const n = static_cast<double>(series.size());
    // S_cor goes on falling slowly as long as one looks.  For x of Lorenz, 0.01 apart, this is about 200 samples.
    CcOptions cc;
    cc.longest = static_cast<std::size_t>(std::clamp(1.5 * period, 30.0, std::max(30.0, n / 10)));
    analysis.curves = cc_curves(series, cc);
    analysis.choice = cc_choice(analysis.curves);
    std::size_t const found = analysis.from_map ? 1 : analysis.choice.delay().value_or(1);
    analysis.delay = options.delay.value_or(found);

    auto const quotient =
        static_cast<double>(cc_window(analysis.curves, analysis.delay)) / static_cast<double>(analysis.delay);
    auto const by_window = static_cast<std::size_t>(std::lround(quotient)) + 1;
    analysis.wanted_dimension = analysis.from_map ? map_dimension : std::max<std::size_t>(by_window, 2);
    auto const allowed = std::max<std::size_t>(2, static_cast<std::size_t>(2 * std::log10(n)));
    analysis.dimension = options.dimension.value_or(std::min(analysis.wanted_dimension, allowed));
    analysis.window = (analysis.dimension - 1) * analysis.delay;
    analysis.theiler = options.theiler.value_or(static_cast<std::size_t>(std::ceil(std::min(period, n))));
}

void require_room(SeriesAnalysis const& analysis) {
    if (analysis.window + fewest_samples > analysis.points) {
        throw SceneError(fmt::format("delay {} and dimension {} leave less than {} points of {} samples; take less",
                                     analysis.delay, analysis.dimension, fewest_samples, analysis.points));
    }
}

/// Ten periods, but no more than a sixth of the points: those behind them cannot be reference points.
std::size_t longest_growth(SeriesAnalysis const& analysis, SeriesOptions const& options) {
    std::size_t const points = analysis.points - analysis.window, most = points / 6;
    auto const wanted = std::max(50.0, 10 * analysis.average_period / analysis.spacing);
    auto const found = static_cast<std::size_t>(std::min(wanted, static_cast<double>(most)));
    if (!options.fit) return found;
    if (options.fit->last >= points / 2) {
        throw SceneError(
            fmt::format("--fit ends at sample {}; it must lie below half of the {} points", options.fit->last, points));
    }
    return std::max(found, options.fit->last);
}

/// Of sampled motions curves are bent by pairs that grow at unlike speeds: of Rössler's flow slopes read 15 to 20 % low wherever
/// the window lies, of Lorenz's 5 to 8 %, of maps not at all.  No variation of the fit shows it.
constexpr double flow_bend = 0.2;  // of the exponent

/// The most that the exponent changes with one coordinate more or less.
double change_with_dimension(SeriesAnalysis const& analysis, std::span<double const> series,
                             SeriesOptions const& options) {
    double most = 0;
    for (std::size_t const dimension : {analysis.dimension - 1, analysis.dimension + 1}) {
        if (dimension < 2) continue;
        DelayEmbedding const embedding(series, analysis.delay, dimension);
        auto const curve = divergence_curve(embedding, analysis.theiler, analysis.divergence.mean_log.size() - 1);
        double const period = analysis.average_period / analysis.spacing;
        auto const window = options.fit ? options.fit : growth_window(curve, embedding.span(), period);
        auto const growth = window ? fit_growth(curve, *window, analysis.spacing) : std::nullopt;
        if (growth) most = std::max(most, std::abs(growth->exponent - analysis.growth->exponent));
    }
    return most;
}

char const* why_no_growth(DivergenceCurve const& curve) {
    if (curve.mean_log.empty())
        return "no neighbours: points are alike, or all near ones lie within the Theiler window";
    double const top = *std::max_element(curve.mean_log.begin(), curve.mean_log.end()), start = curve.mean_log.front();
    if (top - start < 0.5 * (curve.saturation - start))
        return "neighbours stay near each other: there is no growth to fit";
    return "neighbours are as far apart as any points within a few samples: there is nothing to fit";
}

std::string exponent_text(Growth const& growth) {
    return fmt::format("{:.3g} ± {:.2g} per second", growth.exponent, growth.half_width());
}

}  // namespace

bool SeriesAnalysis::few_points() const {
    return static_cast<double>(points) < std::pow(10.0, static_cast<double>(dimension) / 2);
}

bool SeriesAnalysis::growth_is_seen() const {
    return growth && growth->exponent > 2 * growth->error && growth->rise >= std::log(2.0);
}

bool SeriesAnalysis::growth_is_exponential() const {
    return growth_is_seen() && growth->line.r_squared >= straight && growth->is_beyond_a_power();
}

SeriesAnalysis analyse_series(std::span<double const> series, double spacing, SeriesOptions const& options) {
    require_usable(series);
    SeriesAnalysis analysis{};
    analysis.points = series.size();
    analysis.spacing = spacing;
    analysis.average_period = average_period(series, spacing);
    if (std::isnan(analysis.average_period)) throw SceneError("the series is constant: there is nothing to measure");
    double const period = analysis.average_period / spacing;
    analysis.from_map = period < map_period;
    choose_embedding(analysis, series, options);
    require_room(analysis);

    DelayEmbedding const embedding(series, analysis.delay, analysis.dimension);
    analysis.divergence = divergence_curve(embedding, analysis.theiler, longest_growth(analysis, options));
    auto const window = options.fit ? options.fit : growth_window(analysis.divergence, analysis.window, period);
    if (window) analysis.growth = fit_growth(analysis.divergence, *window, spacing);
    if (analysis.growth) {
        analysis.growth->systematic += change_with_dimension(analysis, series, options);
        if (!analysis.from_map) analysis.growth->systematic += flow_bend * std::abs(analysis.growth->exponent);
        if (!analysis.growth->is_beyond_a_power()) {
            analysis.growth->systematic = std::max(analysis.growth->systematic, std::abs(analysis.growth->exponent));
        }
    }
    analysis.stride = zero_one_stride(period);
    analysis.zero_one = zero_one_test(series, {.stride = analysis.stride});
    return analysis;
}

std::string verdict(SeriesAnalysis const& analysis) {
    double const k = analysis.zero_one.k;
    bool const has_k = !std::isnan(k);
    char const* const no_k = has_k ? "the 0–1 test does not decide" : "the 0–1 test has too few samples";
    if (analysis.growth_is_exponential()) {
        std::string const exponent = exponent_text(*analysis.growth);
        if (has_k && k < regular_k) return "undecided: neighbours part exponentially, but the 0–1 test says regular";
        if (has_k && k > chaotic_k) return fmt::format("consistent with chaos, exponent {}", exponent);
        return fmt::format("neighbours part exponentially, {}; {}", exponent, no_k);
    }
    if (analysis.growth_is_seen()) {
        return fmt::format("undecided: neighbours part, but {}; the exponent means little",
                           analysis.growth->is_beyond_a_power() ? "not along a line" : "no faster than a power of time");
    }
    if (has_k && k > chaotic_k) {
        return "irregular, but no exponential growth is seen: noise, sampling too coarse, or too few points";
    }
    if (has_k && k < regular_k) return "no sign of chaos: no exponential growth, and the 0–1 test says regular";
    return fmt::format("no exponential growth is seen; {}", no_k);
}

std::vector<std::string> reservations(SeriesAnalysis const& analysis) {
    std::vector<std::string> lines;
    double const periods = static_cast<double>(analysis.points) * analysis.spacing / analysis.average_period;
    if (periods < 30) lines.push_back(fmt::format("only {:.0f} average periods long; some tens are needed", periods));
    if (analysis.few_points()) {
        lines.push_back(fmt::format("{} points are few for dimension {}: at least 10^(m/2) = {:.0f} are needed",
                                    analysis.points, analysis.dimension,
                                    std::ceil(std::pow(10.0, static_cast<double>(analysis.dimension) / 2))));
    }
    if (analysis.growth && analysis.growth->line.r_squared < straight) {
        lines.push_back(
            fmt::format("R² = {:.3f}: the curve is no line in the fit window", analysis.growth->line.r_squared));
    }
    if (analysis.growth && !analysis.growth->is_beyond_a_power()) {
        lines.emplace_back("a power of time fits the curve about as well as a line: the interval reaches to 0");
    }
    if (!analysis.growth) {
        lines.emplace_back(why_no_growth(analysis.divergence));
    } else if (analysis.growth->rise < 1.5 && analysis.growth_is_seen()) {
        lines.push_back(fmt::format("distances grow by e^{:.1f} only within the fit window", analysis.growth->rise));
    }
    if (analysis.zero_one.points < fewest_for_zero_one) {
        lines.push_back(
            fmt::format("no 0–1 test: {} samples, one of every {}, are too few; it needs {}, for of fewer "
                        "regular motion looks irregular",
                        analysis.zero_one.points, analysis.stride, fewest_for_zero_one));
    }
    if (analysis.growth_is_seen()) lines.emplace_back("coloured noise can look alike; compare with surrogate data");
    return lines;
}

}  // namespace slideway
