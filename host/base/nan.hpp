#pragma once

#include <limits>

namespace slideway {

/// What stands where there is no number.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace slideway
