#include "host/statistics/proportion.hpp"

#include <algorithm>
#include <cmath>

#include "host/sampling/distribution.hpp"

namespace slideway {

Proportion proportion(std::uint64_t successes, std::uint64_t trials, double level) {
    Proportion result{successes, trials, std::numeric_limits<double>::quiet_NaN(), {0, 1}};
    if (trials == 0) return result;
    auto const n = static_cast<double>(trials);
    double const p = static_cast<double>(successes) / n;
    double const z = standard_normal_quantile(0.5 + 0.5 * level);
    double const scale = 1 / (1 + z * z / n);
    double const centre = (p + z * z / (2 * n)) * scale;
    double const half = z * scale * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    result.value = p;
    // At the ends the two terms cancel but for rounding.
    result.interval.low = successes == 0 ? 0 : std::max(0.0, centre - half);
    result.interval.high = successes == trials ? 1 : std::min(1.0, centre + half);
    return result;
}

}  // namespace slideway
