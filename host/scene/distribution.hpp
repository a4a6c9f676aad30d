// How a varied input scatters.
#pragma once

#include <string>
#include <vector>

namespace slideway {

struct Distribution {
    enum class Kind { constant, uniform, triangular, normal, truncated_normal, lognormal, weibull, values };
    Kind kind = Kind::constant;
    double mean = 0, sd = 0;  // normal, truncated_normal (before the cut), lognormal (of the value); constant uses mean
    double low = 0, high = 0;     // uniform, triangular, truncated_normal; low alone: lognormal, weibull
    double mode = 0;              // triangular
    double scale = 0, shape = 0;  // weibull
    std::vector<double> list;     // values, each as likely

    /// Quantile of u in (0, 1); by Boost.Math, so the same bits everywhere the same library is used.
    double quantile(double u) const;
};

}  // namespace slideway
