// How a varied input scatters.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slideway {

/// Distribution of one input, in its SI unit.  With z = Φ⁻¹(u):
///   constant          mean
///   uniform           low + u (high − low), low < high
///   triangular        density rises from 0 at low to its peak at mode, falls to 0 at high;
///                     low <= mode <= high, low < high
///   normal            mean + sd z, sd > 0
///   truncated_normal  a normal with this mean and sd, before it is cut to [low, high]; low < high, not both beyond 37
///                     sd on one side
///   lognormal         low + exp(μ + σ z), σ² = ln(1 + (sd/(mean − low))²), μ = ln(mean − low) − σ²/2: mean and sd are
///                     those of the quantity itself; mean > low, sd > 0
///   weibull           low + scale (−ln(1 − u))^(1/shape), scale > 0, shape > 0
///   values            each entry of `list` equally likely: list[⌊u n⌋], n >= 1
/// The domain is not checked here; the reader of scenes does.
struct Distribution {
    enum class Kind { constant, uniform, triangular, normal, truncated_normal, lognormal, weibull, values };
    Kind kind = Kind::constant;
    double mean = 0, sd = 0;        // normal, truncated_normal, lognormal; constant uses mean
    double low = 0, high = 0;       // uniform, truncated_normal, triangular; low shifts lognormal and weibull
    double mode = 0;                // triangular
    double scale = 0, shape = 0;    // weibull
    std::vector<double> list = {};  // values

    /// Quantile of u in (0, 1); by Boost.Math, so the same bits everywhere the same library is used.  Finite and within
    /// the support.
    double quantile(double u) const;

    /// The value where a standard normal has the value z: Q(Φ(z)), by the tail that z lies in, so that no digits are
    /// lost near Φ = 1.  Finite and within the support for every finite z.
    double from_standard_normal(double z) const;
};

/// Φ⁻¹(u), u in (0, 1).
double standard_normal_quantile(double u);

struct DistributionArgument {
    std::string_view name;
    double Distribution::*member;  // nullptr: the list of values
    bool plain = false;            // a plain number; else in the key's unit
    bool optional = false;         // 0 where it is not given
};

struct DistributionForm {
    std::string_view name;  // of `dist`
    Distribution::Kind kind;
    std::span<DistributionArgument const> arguments;
    std::string_view meaning;

    bool has_levels() const;  // of a grid: those without have one level, or one for each value
};

/// In the order of `Distribution::Kind`.
std::span<DistributionForm const> distribution_forms();
DistributionForm const& form_of(Distribution::Kind kind);

/// "mean, sd[, low]"
std::string listed_arguments(DistributionForm const& form);

}  // namespace slideway
