#include "host/config/scene_text.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/base/utf8.hpp"

namespace slideway {
namespace {

constexpr std::size_t largest_file = 1 << 20;  // bytes; keeps devices and result files from filling the memory
constexpr std::size_t longest_line = 4096;     // bounds how deep "a.a.a.a…" nests, as toml++ recurses

[[noreturn]] void refuse_file(std::string const& path, std::string_view reason, std::string_view advice) {
    throw SceneError(fmt::format("{}: the scene cannot be read ({}); {}", path, reason, advice));
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
    InputText input = read_input(path, largest_file);
    if (input.error != 0) refuse_file(path, input.why(), "check the path and its permissions");
    if (input.text.size() > largest_file) refuse_file(path, "it is larger than 1 MiB", "name a scene file, which is text");
    return std::move(input.text);
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
