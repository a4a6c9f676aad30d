// Values of nodes as the reader wants them, or an error at the node's position.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/document.hpp"
#include "host/config/settings.hpp"

namespace slideway {

/// A finite number, or a text with a unit that converts to `unit`; in SI units.  @throws SceneError
double read_number(Node const& node, std::string_view unit);
/// The same for a value within a range.
double read_number(Node const& node, std::string_view unit, std::string_view meaning, Range range);
/// The same for a key of the physics: within the key's rule.
double read_number(Node const& node, Key const& key);

/// One or more of them.  @param example for refusals: "[1, 2]"
std::vector<double> read_list(Node const& list, Key const& key, std::uint64_t most, std::string_view example);

/// Of a setting: within its limits.
double read_number(Node const& node, Setting const& setting);
std::uint64_t read_count(Node const& node, Setting const& setting);
std::size_t read_choice(Node const& node, Setting const& setting);

/// An integer (or a real number that is one) from low to high.
std::uint64_t read_count(Node const& node, std::string_view meaning, std::uint64_t low, std::uint64_t high);

bool read_boolean(Node const& node);
std::string const& read_text_value(Node const& node);

/// Index of the text in `names`.  @throws SceneError naming the nearest or all.
std::size_t read_choice(Node const& node, std::string_view meaning, std::span<std::string_view const> names);

/// "; did you mean x?" where a name is near enough, else "use one of a, b, c".
std::string choice_advice(std::string_view name, std::span<std::string_view const> names);

}  // namespace slideway
