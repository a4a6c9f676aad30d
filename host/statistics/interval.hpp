// A confidence interval.
#pragma once

#include <limits>

namespace slideway {

/// In the unit of what it bounds; a bound that cannot be given is NaN.
struct Interval {
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();

    double half_width() const { return 0.5 * (high - low); }
};

}  // namespace slideway
