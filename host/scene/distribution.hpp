// How a varied input scatters.
#pragma once

#include <string>

namespace slideway {

struct Distribution {
    enum class Kind { constant, uniform, normal, truncated_normal };
    Kind kind = Kind::constant;
    double mean = 0, sd = 0;     // normal, truncated_normal; constant uses mean
    double low = 0, high = 0;    // uniform, truncated_normal

    /// Quantile of u in (0, 1); by Boost.Math, so the same bits everywhere the same library is used.
    double quantile(double u) const;
};

}  // namespace slideway
