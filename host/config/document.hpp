// A scene file as a tree of values that know where they stand, with the --set options laid over it; and its text, before it is parsed and as it is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/keys.hpp"
#include "host/config/scene.hpp"

namespace slideway {

struct Node {
    enum class Type { boolean, integer, real, text, array, table, other };

    std::string key;              // last part of the name
    std::string name;             // dotted
    std::string where;            // "scenes/a.toml:12" or "--set joint.clearance=0.1 mm"
    int line = 0;                 // in the file; 0 for --set
    int order = 0;                // 0 for the file, i for the i-th --set
    std::size_t begin = 0, end = 0;  // where the file's text has the value
    Type type = Type::table;
    bool inline_table = false;    // {…}: one value, which --set replaces as a whole
    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0;
    std::string text;
    std::vector<Node> children;   // of a table or an array, in the order of the file

    bool is_table() const { return type == Type::table; }
    Node const* find(std::string_view child) const;
    /// By dotted parts that hold no dots themselves: find_path("study.members").
    Node const* find_path(std::string_view dotted) const;
};

/// Parses a scene and lays the overrides over it.  The root is a table named "".
/// @throws SceneError where the text is no TOML or an override is no key=value.
Node read_document(std::string const& text, std::string const& path, Overrides const& overrides);

/// "study.section has no on (what crosses the section); write for example {…}", behind the node's position.
[[noreturn]] void refuse_that(Node const& node, std::string_view fault, Problem const& problem);
/// "joint.clearance is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm".
[[noreturn]] void refuse(Node const& node, std::string_view shown, Problem const& problem);
/// The same with the node's value shown as it was written.
[[noreturn]] void refuse(Node const& node, Problem const& problem);

/// The value of a node for a message: short, on one line.
std::string shown_value(Node const& node);

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
