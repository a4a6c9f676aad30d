// Names of the entries along the dimensions of the quantity table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slideway {

/// Labels along a dimension of the quantity table: "P1" … "P8", the mode classes, "roll" "yaw" "pitch",
/// "x" "y" "z" of a direction, "top" "front" of a channel (a sensor of the experiment).
/// Empty for an unknown dimension.
std::vector<std::string> labels_of(std::string_view dimension);

}  // namespace slideway
