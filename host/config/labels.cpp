#include "host/config/labels.hpp"

#include <iterator>

namespace slideway {

std::vector<std::string> labels_of(std::string_view dimension) {
    if (dimension == "apex") return {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"};
    if (dimension == "mode_class") return {std::begin(mode_class_names), std::end(mode_class_names)};
    if (dimension == "axis") return {"roll", "yaw", "pitch"};
    if (dimension == "direction") return {"x", "y", "z"};
    if (dimension == "channel") return {"top", "front"};
    return {};
}

}  // namespace slideway
