// Text of others (titles, names of files, attributes) as it may go to a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slideway {

/// The text on one line, with what a terminal or an editor would obey as an escape: control characters (C0, DEL, C1), those that turn or
/// mark the direction of text (UAX #9) and separators of lines as \uNNNN, bytes that are no UTF-8 as \xNN.  TOML and JSON read
/// the former back.  What is shown once is shown again as it is.
/// @param longest [B], about: a longer text ends with "..."
std::string shown(std::string_view text, std::size_t longest = std::string_view::npos);

/// The same of a text that has lines and columns of its own: new lines and tabs stay.
std::string shown_lines(std::string_view text);

/// Whether `shown` changes nothing.
bool is_plain(std::string_view text);

/// As a message repeats a word of a scene.
inline std::string shown_briefly(std::string_view text) { return shown(text, 80); }

}  // namespace slideway
