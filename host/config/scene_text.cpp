#include "host/config/scene_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

constexpr std::size_t largest_file = 1 << 20;  // bytes; keeps devices and result files from filling the memory
constexpr std::size_t longest_line = 4096;     // bounds how deep "a.a.a.a…" nests, as toml++ recurses

[[noreturn]] void refuse_file(std::string const& path, std::string_view reason, std::string_view advice) {
    throw SceneError(fmt::format("{}: the scene cannot be read ({}); {}", path, reason, advice));
}

/// Length of the UTF-8 character that begins at `at`, or 0 if none does.
std::size_t character_length(std::string_view text, std::size_t at) {
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

/// The code point of a whole UTF-8 character.
std::uint32_t code_point(std::string_view character) {
    auto const first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first;
    std::uint32_t code = first & (0xffu >> (character.size() + 1));
    for (char const byte : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(byte) & 0x3fu);
    return code;
}

std::string four_bytes(std::uint32_t code) {
    return {static_cast<char>(0xf0u | code >> 18), static_cast<char>(0x80u | (code >> 12 & 0x3fu)),
            static_cast<char>(0x80u | (code >> 6 & 0x3fu)), static_cast<char>(0x80u | (code & 0x3fu))};
}

std::string two_or_three_bytes(std::uint32_t code) {
    if (code < 0x800) return {static_cast<char>(0xc0u | code >> 6), static_cast<char>(0x80u | (code & 0x3fu))};
    return {static_cast<char>(0xe0u | code >> 12), static_cast<char>(0x80u | (code >> 6 & 0x3fu)),
            static_cast<char>(0x80u | (code & 0x3fu))};
}

constexpr std::uint32_t safe_plane = 0xf0000;

}  // namespace

std::string read_scene_text(std::string const& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse_file(path, "it is a directory", "name a scene file in it");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        refuse_file(path, errno != 0 ? std::strerror(errno) : "it does not open", "check the path and its permissions");
    }
    std::string text(largest_file + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (file.bad()) refuse_file(path, "reading failed", "check the file");
    if (text.size() > largest_file) refuse_file(path, "it is larger than 1 MiB", "name a scene file, which is text");
    return text;
}

void check_scene_text(std::string_view text, std::string const& path) {
    auto const line_of = [&](std::size_t at) {
        return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    };
    auto const nul = text.find('\0');
    if (nul != std::string_view::npos) {
        throw SceneError(fmt::format("{}:{}: not TOML (it holds a zero byte, so it is no text); name a scene file",
                                     path, line_of(nul)));
    }
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        throw SceneError(fmt::format("{}:1: schema is missing (the file is empty); write a scene, see scenes/", path));
    }
    for (std::size_t start = 0; start < text.size();) {
        std::size_t const end = std::min(text.find('\n', start), text.size());
        if (end - start > longest_line) {
            throw SceneError(fmt::format("{}:{}: not TOML of a scene (the line is longer than {} bytes); break it",
                                         path, line_of(start), longest_line));
        }
        start = end + 1;
    }
}

std::string shielded(std::string_view text) {
    std::string result;
    std::size_t at = 0;
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark)) {
        at = byte_order_mark.size();
    }
    while (at < text.size()) {
        std::size_t const length = character_length(text, at);
        std::string_view const character = text.substr(at, length == 0 ? 1 : length);
        at += character.size();
        bool const moves = length == 2 || length == 3;
        result += moves ? four_bytes(safe_plane + code_point(character)) : std::string(character);
    }
    return result;
}

std::string unshielded(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t const length = character_length(text, at);
        std::string_view const character = text.substr(at, length == 0 ? 1 : length);
        at += character.size();
        std::uint32_t const moved = length == 4 ? code_point(character) - safe_plane : 0;
        result += length == 4 && moved >= 0x80 && moved < 0x10000 ? two_or_three_bytes(moved) : std::string(character);
    }
    return result;
}

std::string one_line(std::string_view text, std::size_t longest) {
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        if (line.size() > longest) return line + "...";
        auto const byte = static_cast<unsigned char>(text[at]);
        std::size_t const length = character_length(text, at);
        // U+0080 to U+009F are control characters too, U+0085 a new line.
        bool const control = byte < 0x20 || byte == 0x7f ||
                             (byte == 0xc2 && length == 2 && static_cast<unsigned char>(text[at + 1]) < 0xa0);
        if (length > 0 && !control) {
            line += text.substr(at, length);
            at += length;
        } else {
            line += fmt::format("\\x{:02x}", byte);
            at += 1;
        }
    }
    return line;
}

std::string toml_number(double value) {
    std::string text = fmt::format("{}", value);
    // Without a point TOML reads an integer, and -0 loses its sign.
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string unit_comment(std::string_view unit) { return unit.empty() || unit == "1" ? std::string() : fmt::format("  # {}", unit); }

std::string number_line(std::string_view name, double value, std::string_view unit) {
    return fmt::format("{} = {}{}\n", name, toml_number(value), unit_comment(unit));
}

std::string toml_string(std::string_view text) {
    std::string quoted = "\"";
    for (char const c : text) {
        auto const byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            quoted += fmt::format("\\u{:04X}", byte);
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

}  // namespace slideway
