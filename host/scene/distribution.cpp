#include "host/scene/distribution.hpp"

#include <algorithm>

#include <boost/math/distributions/normal.hpp>

namespace slideway {
namespace {

/// Φ⁻¹ of the probability that lies the fraction u of the way from Φ(low) to Φ(high).  Taken from the nearer tail:
/// close to 1, Φ has no digits left for a tail that its complement resolves.
double truncated_standard_normal(double low, double high, double u) {
    boost::math::normal const normal;
    using boost::math::cdf;
    using boost::math::complement;
    using boost::math::quantile;
    double const below = cdf(normal, low) * (1 - u) + cdf(normal, high) * u;
    if (below < 0.5) return quantile(normal, below);
    double const above = cdf(complement(normal, low)) * (1 - u) + cdf(complement(normal, high)) * u;
    return quantile(complement(normal, above));
}

}  // namespace

double Distribution::quantile(double u) const {
    switch (kind) {
    case Kind::constant: break;
    case Kind::triangular:
    case Kind::lognormal:
    case Kind::weibull:
    case Kind::values: break;
    case Kind::uniform: return std::clamp(low + u * (high - low), low, high);
    case Kind::normal: return mean + sd * boost::math::quantile(boost::math::normal(), u);
    case Kind::truncated_normal: {
        double const z = truncated_standard_normal((low - mean) / sd, (high - mean) / sd, u);
        return std::clamp(mean + sd * z, low, high);
    }
    }
    return mean;
}

}  // namespace slideway
