#include "host/sampling/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/weibull.hpp>

namespace slideway {
namespace {

/// A probability by both of its tails: near 1, `below` has no digits left for what `above` resolves.
struct Tails {
    double below, above;
};

/// What underflowed is still not impossible: quantiles stay finite.
double possible(double probability) { return std::max(probability, std::numeric_limits<double>::min()); }

/// Long tails can leave the range of a double.
double finite(double value) {
    constexpr double most = std::numeric_limits<double>::max();
    return std::clamp(value, -most, most);
}

/// Quantile by the smaller tail.
template <class Known> double tail_quantile(Known const& distribution, Tails const& p) {
    if (p.below < 0.5) return quantile(distribution, possible(p.below));
    return quantile(complement(distribution, possible(p.above)));
}

/// Φ⁻¹ of the probability that lies the fraction u of the way from Φ(low) to Φ(high).  Taken from the nearer tail:
/// close to 1, Φ has no digits left for a tail that its complement resolves.
double truncated_standard_normal(double low, double high, Tails const& p) {
    boost::math::normal const normal;
    double const below = cdf(normal, low) * p.above + cdf(normal, high) * p.below;
    if (below < 0.5) return quantile(normal, possible(below));
    double const above = cdf(complement(normal, low)) * p.above + cdf(complement(normal, high)) * p.below;
    return quantile(complement(normal, possible(above)));
}

double truncated_normal(Distribution const& d, Tails const& p) {
    double const z = truncated_standard_normal((d.low - d.mean) / d.sd, (d.high - d.mean) / d.sd, p);
    return std::clamp(d.mean + d.sd * z, d.low, d.high);
}

double triangular(Distribution const& d, Tails const& p) {
    return std::clamp(tail_quantile(boost::math::triangular(d.low, d.mode, d.high), p), d.low, d.high);
}

double lognormal(Distribution const& d, double z) {
    double const ratio = d.sd / (d.mean - d.low);
    // ln(1 + ratio²), also where the square overflows
    double const variance = ratio < 1 ? std::log1p(ratio * ratio) : 2 * std::log(std::hypot(1.0, ratio));
    double const middle = std::log(d.mean - d.low) - variance / 2;
    return finite(d.low + std::exp(middle + std::sqrt(variance) * z));
}

double weibull(Distribution const& d, Tails const& p) {
    return finite(d.low + tail_quantile(boost::math::weibull(d.shape, d.scale), p));
}

double listed(Distribution const& d, double u) {
    std::size_t const n = d.list.size();
    return d.list[std::min(static_cast<std::size_t>(u * static_cast<double>(n)), n - 1)];
}

/// Of those that have no shorter way.
double by_tails(Distribution const& d, Tails const& p) {
    switch (d.kind) {
        case Distribution::Kind::truncated_normal:
            return truncated_normal(d, p);
        case Distribution::Kind::triangular:
            return triangular(d, p);
        case Distribution::Kind::weibull:
            return weibull(d, p);
        case Distribution::Kind::values:
            return listed(d, p.below);
        default:
            return d.mean;
    }
}

}  // namespace

double standard_normal_quantile(double u) { return boost::math::quantile(boost::math::normal(), u); }

double Distribution::quantile(double u) const {
    if (kind == Kind::uniform) return std::clamp(low + u * (high - low), low, high);
    if (kind == Kind::normal) return mean + sd * standard_normal_quantile(u);
    if (kind == Kind::lognormal) return lognormal(*this, standard_normal_quantile(u));
    return by_tails(*this, {u, 1 - u});
}

double Distribution::from_standard_normal(double z) const {
    if (kind == Kind::normal) return finite(mean + sd * z);
    if (kind == Kind::lognormal) return lognormal(*this, z);
    boost::math::normal const normal;
    double const below = cdf(normal, z), above = cdf(complement(normal, z));
    if (kind == Kind::uniform) return std::clamp(z < 0 ? low + below * (high - low) : high - above * (high - low), low, high);
    return by_tails(*this, {below, above});
}

}  // namespace slideway
