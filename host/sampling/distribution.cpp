#include "host/sampling/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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
        case Distribution::Kind::constant:
        case Distribution::Kind::uniform:
        case Distribution::Kind::normal:
        case Distribution::Kind::lognormal:
            break;
    }
    return d.mean;
}

using D = Distribution;
using Argument = DistributionArgument;

constexpr Argument value_of_constant[] = {{"value", &D::mean}};
constexpr Argument ends[] = {{"low", &D::low}, {"high", &D::high}};
constexpr Argument corners[] = {{"low", &D::low}, {"mode", &D::mode}, {"high", &D::high}};
constexpr Argument moments[] = {{"mean", &D::mean}, {"sd", &D::sd}};
constexpr Argument moments_and_ends[] = {{"mean", &D::mean}, {"sd", &D::sd}, {"low", &D::low}, {"high", &D::high}};
constexpr Argument moments_and_low[] = {{"mean", &D::mean}, {"sd", &D::sd}, {"low", &D::low, false, true}};
constexpr Argument scale_and_shape[] = {
    {"scale", &D::scale}, {"shape", &D::shape, true}, {"low", &D::low, false, true}};
constexpr Argument list_of_values[] = {{"values", nullptr}};

constexpr DistributionForm forms[] = {
    {"const", D::Kind::constant, value_of_constant, "one value"},
    {"unif", D::Kind::uniform, ends, "evenly from low to high"},
    {"triang", D::Kind::triangular, corners, "a triangle with its peak at mode"},
    {"norm", D::Kind::normal, moments, "normal, mean and standard deviation"},
    {"truncnorm", D::Kind::truncated_normal, moments_and_ends, "a normal one cut off at low and high"},
    {"lognorm", D::Kind::lognormal, moments_and_low, "mean and sd of the value itself, which lies above low (0)"},
    {"weibull", D::Kind::weibull, scale_and_shape, "low (0) + scale (-ln(1 - u))^(1/shape)"},
    {"values", D::Kind::values, list_of_values, "a list, each of its values as likely"},
};

constexpr bool in_order() {
    for (std::size_t i = 0; i < std::size(forms); ++i) {
        if (static_cast<std::size_t>(forms[i].kind) != i) return false;
    }
    return std::size(forms) == static_cast<std::size_t>(D::Kind::values) + 1;
}
static_assert(in_order());

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

bool DistributionForm::has_levels() const {
    return kind != Distribution::Kind::constant && kind != Distribution::Kind::values;
}

std::span<DistributionForm const> distribution_forms() { return forms; }
DistributionForm const& form_of(Distribution::Kind kind) { return forms[static_cast<std::size_t>(kind)]; }

std::string listed_arguments(DistributionForm const& form) {
    std::string text;
    for (DistributionArgument const& argument : form.arguments) {
        std::string const next = (text.empty() ? "" : ", ") + std::string(argument.name);
        text += argument.optional ? "[" + next + "]" : next;
    }
    return text;
}

}  // namespace slideway
