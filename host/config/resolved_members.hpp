// The parts of a resolved scene that say what varies, how members are spread, and what limits they are to meet.
#pragma once

#include <string>
#include <string_view>

#include "host/config/scene.hpp"

namespace slideway {

/// The shortest text that TOML reads back to the same double.
std::string toml_number(double value);
/// "  # m"; "" for a plain number
std::string unit_comment(std::string_view unit);
/// "clearance_y = 0.0001  # m", with the end of the line
std::string number_line(std::string_view name, double value, std::string_view unit);

/// Lines of [study]: design, base, table.
std::string design_text(Scene const& scene);
/// [study.vary], [study.correlation] and [study.limits], where the scene has them.
std::string members_text(Scene const& scene);

}  // namespace slideway
