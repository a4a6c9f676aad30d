#include "host/config/document.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/base/open_file.hpp"
#include "host/base/text.hpp"
#include "host/config/settings.hpp"

// toml++ asserts that "[" is followed by a key, and with NDEBUG has clang assume it, ahead of the code that reports the
// error.  A damaged file must be refused in every build: the assertions are left out and nothing is assumed.
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#include <toml++/toml.h>

namespace slideway {
namespace {

constexpr int deepest = 10;  // levels; a scene has five: study.vary.joint.clearance.low

struct Origin {
    std::string path;       // of the file, or empty
    std::string option;     // "--set key=value", or empty
    int order = 0;
    std::string_view text;  // of the file, or empty
    std::vector<std::size_t> lines = {};  // where each begins in it

    /// toml++ counts lines, and the characters of a line.
    std::size_t offset(toml::source_position position) const {
        if (position.line < 1 || position.line > lines.size()) return text.size();
        std::size_t at = lines[position.line - 1];
        for (toml::source_index column = 1; column < position.column && at < text.size(); ++column) {
            do ++at;
            while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u);
        }
        return at;
    }
};

Origin of_file(std::string_view text, std::string const& path) {
    Origin origin{path, {}, 0, text, {0}};
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos;) origin.lines.push_back(++at);
    return origin;
}

/// What a value is, and of a table or an array its type alone.
void take_value(toml::node const& from, Node& node) {
    using Type = Node::Type;
    node.type = Type::other;  // dates and times
    if (auto const* boolean = from.as_boolean()) node.type = Type::boolean, node.boolean = boolean->get();
    if (auto const* integer = from.as_integer()) node.type = Type::integer, node.integer = integer->get();
    if (auto const* real = from.as_floating_point()) node.type = Type::real, node.real = real->get();
    if (auto const* text = from.as_string()) node.type = Type::text, node.text = unshielded(text->get());
    if (from.is_array()) node.type = Type::array;
    if (auto const* table = from.as_table()) node.type = Type::table, node.inline_table = table->is_inline();
}

Node convert(toml::node const& from, std::string key, std::string name, toml::source_position at, Origin const& origin, int depth = 0) {
    Node node;
    node.key = std::move(key);
    node.name = std::move(name);
    node.order = origin.order;
    node.line = origin.order == 0 ? std::max(1, static_cast<int>(at.line)) : 0;
    node.where = origin.order == 0 ? fmt::format("{}:{}", origin.path, node.line) : origin.option;
    node.begin = origin.offset(from.source().begin), node.end = origin.offset(from.source().end);
    if (depth > deepest) refuse_that(node, "is no key of a scene", {fmt::format("it nests deeper than {} levels", deepest), "remove it"});
    take_value(from, node);
    if (auto const* array = from.as_array()) {
        for (auto const& child : *array) node.children.push_back(convert(child, {}, node.name, child.source().begin, origin, depth + 1));
    }
    if (auto const* table = from.as_table()) {
        std::vector<std::pair<toml::source_position, Node>> placed;
        for (auto const& [child_key, child] : *table) {
            std::string child_part = unshielded(child_key.str());
            std::string child_name = node.name.empty() ? child_part : fmt::format("{}.{}", node.name, child_part);
            auto const position = child_key.source().begin;
            placed.emplace_back(position, convert(child, std::move(child_part), std::move(child_name), position, origin, depth + 1));
        }
        // toml++ sorts by name; the position of the key restores the order of the file.
        std::ranges::stable_sort(placed, {}, [](auto const& one) { return std::pair(one.first.line, one.first.column); });
        for (auto& [position, child] : placed) node.children.push_back(std::move(child));
    }
    return node;
}

Node parse_text(std::string const& text, std::string const& path) {
    check_scene_text(text, path);
    try {
        return convert(toml::parse(shielded(text)), {}, {}, {1, 1}, of_file(text, path));
    } catch (toml::parse_error const& error) {
        throw SceneError(fmt::format("{}:{}: not TOML ({}); correct the line", path,
                                     std::max(1, static_cast<int>(error.source().begin.line)),
                                     shown_briefly(unshielded(error.description()))));
    }
}

/// One number and nothing else, as from_chars reads it: 5., .5, 007, which TOML does not.
std::optional<double> plain_number(std::string_view text) { return parse_number<double>(text.starts_with('+') ? text.substr(1) : text); }

/// The innermost single child: the value that "a.b.c = value" names.
bool names_one_value(Node const& root) {
    Node const* node = &root;
    while (node->is_table() && !node->inline_table) {
        if (node->children.size() != 1) return false;
        node = &node->children.front();
    }
    return true;
}

/// "key = value" as a tree with one leaf; nothing where it is no TOML.
std::optional<Node> parse_pair(std::string const& key, std::string const& value, Origin const& origin) {
    std::string const text = fmt::format("{} = {}", key, value);
    try {
        Node node = convert(toml::parse(shielded(text)), {}, {}, {}, origin);
        if (names_one_value(node)) return node;
    } catch (toml::parse_error const&) {  // nothing, as promised
    }
    return std::nullopt;
}

Node parse_override(std::string const& key, std::string const& value, int order) {
    constexpr std::size_t longest_option = 4096;
    Origin const origin{{}, fmt::format("--set {}={}", shown_briefly(key), shown_briefly(value)), order, {}};
    if (key.find_first_of("\r\n=#") == std::string::npos && key.size() <= longest_option) {
        if (auto node = value.size() <= longest_option ? parse_pair(key, value, origin) : std::nullopt) return *node;
        auto const number = plain_number(value);
        std::string const literal = number ? fmt::format("{}", *number) : toml_string(value);
        if (auto node = parse_pair(key, literal, origin)) return *node;
    }
    constexpr std::string_view advice = "no key=value (the part before = must be a dotted key); write for example --set joint.clearance=\"0.1 mm\"";
    throw SceneError(fmt::format("{}: {}", origin.option, advice));
}

/// What an override of a key makes void in the file: keys that say the same in other words.
std::vector<std::string_view> rivals_of(std::string_view name) {
    std::vector<std::string_view> result;
    // The numbers of the physics have but this one.
    if (name == "contact.restitution") result.assign(std::begin(rates_of_damping), std::end(rates_of_damping));
    auto const row = std::ranges::find(settings(), name, &Setting::name);
    if (row != settings().end()) std::ranges::copy_if(row->rivals, std::back_inserter(result), [](auto rival) { return !rival.empty(); });
    if (Key const* const twin = find_key(name); twin != nullptr && twin->twin != nullptr) {
        for (Key const& single : keys()) {
            if (single.overlaps(*twin)) result.push_back(single.name);
        }
    }
    return result;
}

void lay_over(Node& base, Node const& over) {
    for (Node const& child : over.children) {
        auto const rivals = rivals_of(child.name);
        std::erase_if(base.children, [&](Node const& node) { return std::ranges::count(rivals, node.name) > 0; });
        auto const found = std::ranges::find(base.children, child.key, &Node::key);
        if (found == base.children.end()) {
            base.children.push_back(child);
        } else if (child.is_table() && !child.inline_table && found->is_table()) {
            lay_over(*found, child);
        } else {
            *found = child;
        }
    }
}

}  // namespace

Node const* Node::find(std::string_view child) const {
    for (Node const& node : children) {
        if (is_table() && node.key == child) return &node;
    }
    return nullptr;
}

Node const* Node::find_path(std::string_view dotted) const {
    Node const* node = this;
    while (node != nullptr) {
        auto const dot = dotted.find('.');
        node = node->find(dotted.substr(0, dot));
        if (dot == std::string_view::npos) break;
        dotted.remove_prefix(dot + 1);
    }
    return node;
}

Node read_document(std::string const& text, std::string const& path, Overrides const& overrides) {
    Node root = parse_text(text, path);
    int order = 0;
    for (auto const& [key, value] : overrides) lay_over(root, parse_override(key, value, ++order));
    return root;
}

void refuse_that(Node const& node, std::string_view fault, Problem const& problem) {
    throw SceneError(fmt::format("{}: {} {} ({}); {}", node.where, shown_briefly(node.name), fault, problem.reason, problem.advice));
}

void refuse(Node const& node, std::string_view shown, Problem const& problem) { refuse_that(node, fmt::format("is {}", shown), problem); }

void refuse(Node const& node, Problem const& problem) { refuse(node, shown_value(node), problem); }

std::string shown_value(Node const& node) {
    switch (node.type) {
        case Node::Type::boolean: return node.boolean ? "true" : "false";
        case Node::Type::integer: return fmt::format("{}", node.integer);
        case Node::Type::real: return fmt::format("{}", node.real);
        case Node::Type::text: return fmt::format("\"{}\"", shown_briefly(node.text));
        case Node::Type::array: return "a list";
        case Node::Type::table: return "a table";
        case Node::Type::other: break;
    }
    return "a date or time";
}

// The text of a scene file before it is parsed, and texts in messages.

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
