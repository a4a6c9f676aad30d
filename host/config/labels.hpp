// Names of the entries along the dimensions of the quantity table, and of the numbers of a state.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/config/descriptors.hpp"

namespace slideway {

/// Labels along a dimension of the quantity table: "P1" … "P8", the mode classes, "roll" "yaw" "pitch",
/// "x" "y" "z" of a direction, "top" "front" of a channel (a sensor of the experiment).
/// Empty for an unknown dimension.
std::vector<std::string> labels_of(std::string_view dimension);

/// Number i of a mechanism's state.
template <class Index> constexpr SeriesInfo const& state_info(MechanismInfo const& mechanism, Index i) {
    return series_table[static_cast<int>(mechanism.state[i])];
}

}  // namespace slideway
