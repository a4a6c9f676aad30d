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

char further_byte(std::uint32_t code) { return static_cast<char>(0x80u | (code & 0x3fu)); }

std::string four_bytes(std::uint32_t code) {
    return {static_cast<char>(0xf0u | code >> 18), further_byte(code >> 12), further_byte(code >> 6), further_byte(code)};
}

std::string two_or_three_bytes(std::uint32_t code) {
    if (code < 0x800) return {static_cast<char>(0xc0u | code >> 6), further_byte(code)};
    return {static_cast<char>(0xe0u | code >> 12), further_byte(code >> 6), further_byte(code)};
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
    auto const fail_at = [&](std::size_t at, std::string const& what) {
        throw SceneError(fmt::format("{}:{}: {}", path, 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'), what));
    };
    auto const nul = text.find('\0');
    if (nul != text.npos) fail_at(nul, "not TOML (it holds a zero byte, so it is no text); name a scene file");
    if (text.find_first_not_of(" \t\r\n") == text.npos) fail_at(0, "schema is missing (the file is empty); write a scene, see scenes/");
    for (std::size_t start = 0; start < text.size();) {
        std::size_t const end = std::min(text.find('\n', start), text.size());
        if (end - start > longest_line) fail_at(start, fmt::format("not TOML of a scene (the line is longer than {} bytes); break it", longest_line));
        start = end + 1;
    }
}

namespace {

/// The text with each of its characters of several bytes, and what is no character byte by byte, as a function has them.
template <class Moved> std::string with_each(std::string_view text, Moved const& moved) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t const length = character_length(text, at);
        std::string_view const character = text.substr(at, length == 0 ? 1 : length);
        at += character.size();
        result += moved(character, length);
    }
    return result;
}

}  // namespace

std::string shielded(std::string_view text) {
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return with_each(text, [](std::string_view character, std::size_t length) {
        return length == 2 || length == 3 ? four_bytes(safe_plane + code_point(character)) : std::string(character);
    });
}

std::string unshielded(std::string_view text) {
    return with_each(text, [](std::string_view character, std::size_t length) {
        std::uint32_t const moved = length == 4 ? code_point(character) - safe_plane : 0;
        return moved >= 0x80 && moved < 0x10000 ? two_or_three_bytes(moved) : std::string(character);
    });
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
        if (byte < 0x20 || byte == 0x7f) quoted += fmt::format("\\u{:04X}", byte);
        else quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return quoted + '"';
}

}  // namespace slideway
