#include "host/chaos/power_spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <unsupported/Eigen/FFT>

#include "host/base/numbers.hpp"

namespace slideway {
namespace {

bool all_finite(std::span<double const> series) {
    return std::all_of(series.begin(), series.end(), [](double x) { return std::isfinite(x); });
}

std::vector<double> weights(std::size_t n, Taper taper) {
    std::vector<double> w(n, 1.0);
    if (taper == Taper::none) return w;
    // Zero half a sample outside both ends: no sample is lost.
    for (std::size_t i = 0; i < n; ++i) {
        double const s = std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
        w[i] = s * s;
    }
    return w;
}

/// w(x - x̄), padded with zeros.
std::vector<double> tapered(std::span<double const> series, std::span<double const> w) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
        sum += w[i] * series[i];
        weight += w[i];
    }
    std::vector<double> out(std::bit_ceil(series.size()), 0.0);
    for (std::size_t i = 0; i < series.size(); ++i) out[i] = w[i] * (series[i] - sum / weight);
    return out;
}

bool is_constant(std::span<double const> series) {
    auto const [low, high] = std::minmax_element(series.begin(), series.end());
    double const size = std::max(std::abs(*low), std::abs(*high));
    return !(*high - *low > 8 * std::numeric_limits<double>::epsilon() * size);
}

}  // namespace

PowerSpectrum power_spectrum(std::span<double const> series, double spacing, Taper taper) {
    if (series.size() < 4 || !all_finite(series) || !(spacing > 0) || !std::isfinite(spacing)) return {};
    std::vector<double> const w = weights(series.size(), taper);
    std::vector<double> const input = tapered(series, w);
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> transform;
    fft.fwd(transform, input);

    double squares = 0;
    for (double const weight : w) squares += weight * weight;
    std::size_t const length = input.size(), bins = length / 2 + 1;
    PowerSpectrum spectrum{std::vector<double>(bins), std::vector<double>(bins)};
    for (std::size_t k = 0; k < bins; ++k) {
        double const sides = k == 0 || 2 * k == length ? 1 : 2;
        spectrum.frequency[k] = static_cast<double>(k) / (static_cast<double>(length) * spacing);
        spectrum.density[k] = sides * spacing * std::norm(transform[k]) / squares;
    }
    return spectrum;
}

double average_period(std::span<double const> series, double spacing, Taper taper) {
    if (series.empty() || is_constant(series)) return nan;
    PowerSpectrum const spectrum = power_spectrum(series, spacing, taper);
    double power = 0, moment = 0;
    for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
        power += spectrum.density[k];
        moment += spectrum.frequency[k] * spectrum.density[k];
    }
    return power > 0 && moment > 0 ? power / moment : nan;
}

}  // namespace slideway
