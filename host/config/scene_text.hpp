// The text of a scene file before it is parsed, and texts in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slideway {

/// The content of a scene file.  @throws SceneError where it cannot be read.
std::string read_scene_text(std::string const& path);

/// Refuses what is no text, is empty, or could exhaust the parser's stack.  @throws SceneError with file and line
void check_scene_text(std::string_view text, std::string const& path);

/// The text with its characters from U+0080 to U+FFFF moved to U+F0080 and up, without a byte order mark; broken UTF-8
/// stays as it is.  toml++ 3.3 runs into undefined behaviour where some of these characters stand outside quotes; of
/// those above U+FFFF it makes a proper error.
std::string shielded(std::string_view text);
/// The inverse; characters that were private ones from U+F0080 on before `shielded` do not come back.
std::string unshielded(std::string_view text);

/// The shortest text that TOML reads back to the same double.
std::string toml_number(double value);
/// "  # m"; "" for a plain number
std::string unit_comment(std::string_view unit);
/// "clearance_y = 0.0001  # m", with the end of the line
std::string number_line(std::string_view name, double value, std::string_view unit);

/// A TOML basic string, quotes included.
std::string toml_string(std::string_view text);

}  // namespace slideway
