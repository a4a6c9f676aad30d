#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slideway {

/// The upper one where their number is even; there must be some.
inline double median(std::vector<double> values) {
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace slideway
