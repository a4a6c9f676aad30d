// Texts: those of others (titles, names of files, attributes) as they may go to a terminal, their characters, and the name that a mistyped one was meant to be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

// Characters of UTF-8.

/// Length of the character that begins at `at`, or 0 if none does: neither overlong forms nor surrogates are any (RFC 3629).
inline std::size_t character_length(std::string_view text, std::size_t at) {
    auto const byte = static_cast<unsigned char>(text[at]);
    if (byte < 0x80) return 1;
    std::size_t const length = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
    if (byte < 0xc2 || byte > 0xf4 || at + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((static_cast<unsigned char>(text[at + k]) & 0xc0u) != 0x80u) return 0;
    }
    auto const second = static_cast<unsigned char>(text[at + 1]);
    bool const overlong = (byte == 0xe0 && second < 0xa0) || (byte == 0xf0 && second < 0x90);
    bool const no_character = (byte == 0xed && second >= 0xa0) || (byte == 0xf4 && second >= 0x90);  // surrogates; end
    return overlong || no_character ? 0 : length;
}

/// The code point of a whole character.
inline std::uint32_t code_point(std::string_view character) {
    auto const first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first;
    std::uint32_t code = first & (0xffu >> (character.size() + 1));
    for (char const byte : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(byte) & 0x3fu);
    return code;
}

// The name that a mistyped one was meant to be.

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `names` if it is near enough to be meant, else an empty string.  An abbreviation is near (norm and
/// normal).  Where names are dotted, the part behind the last dot alone may match too: a key in the wrong table.
std::string_view nearest_name(std::string_view name, std::span<std::string_view const> names);

}  // namespace slideway
