#include "host/base/shown.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "host/base/utf8.hpp"

namespace slideway {
namespace {

/// First and last code point of what is obeyed instead of seen.
constexpr std::uint32_t obeyed[][2] = {
    {0x00, 0x1f}, {0x7f, 0x9f}, {0x061c, 0x061c}, {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x206f}};

bool is_obeyed(std::uint32_t code) {
    for (auto const& [first, last] : obeyed) {
        if (first <= code && code <= last) return true;
    }
    return false;
}

std::string escaped(std::string_view text, std::size_t longest, std::string_view kept) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        if (result.size() > longest) return result + "...";
        std::size_t const length = character_length(text, at);
        if (length == 0) {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at++]));
            continue;
        }
        std::string_view const character = text.substr(at, length);
        std::uint32_t const code = code_point(character);
        if (is_obeyed(code) && kept.find(text[at]) == kept.npos)
            result += fmt::format("\\u{:04x}", code);
        else
            result += character;
        at += length;
    }
    return result;
}

}  // namespace

std::string shown(std::string_view text, std::size_t longest) { return escaped(text, longest, ""); }

std::string shown_lines(std::string_view text) { return escaped(text, std::string_view::npos, "\n\t"); }

bool is_plain(std::string_view text) { return shown(text) == text; }

}  // namespace slideway
