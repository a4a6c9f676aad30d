#include "host/config/reader.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/shown.hpp"
#include "host/base/suggest.hpp"
#include "host/config/scene_text.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

std::string number_advice(std::string_view unit) {
    return unit == "1" ? "use a number" : fmt::format("use a number in {0} or a text like \"1 {0}\"", unit);
}

/// The number as the user wrote it, with the unit that it is in.
std::string shown_number(Node const& node, std::string_view unit) {
    if (node.type == Node::Type::text) return shown_briefly(node.text);
    return unit == "1" ? shown_value(node) : fmt::format("{} {}", shown_value(node), unit);
}

}  // namespace

double read_number(Node const& node, std::string_view unit) {
    double value = 0;
    switch (node.type) {
    case Node::Type::integer: value = static_cast<double>(node.integer); break;
    case Node::Type::real: value = node.real; break;
    case Node::Type::text: {
        auto const converted = to_si(node.text, unit);
        if (auto const* problem = std::get_if<Problem>(&converted)) {
            refuse(node, {shown_briefly(problem->reason), problem->advice});
        }
        value = std::get<double>(converted);
        break;
    }
    default: refuse(node, {"not a number", number_advice(unit)});
    }
    if (!std::isfinite(value)) refuse(node, {"not a finite number", "use a finite number"});
    return value;
}

double read_number(Node const& node, Key const& key) {
    double const value = read_number(node, key.unit);
    if (auto const problem = broken_rule(key, value)) refuse(node, shown_number(node, key.unit), *problem);
    return value;
}

std::vector<double> read_list(Node const& list, Key const& key, std::uint64_t most, std::string_view example) {
    if (list.type != Node::Type::array || list.children.empty() || list.children.size() > most) {
        refuse(list, {fmt::format("not a list of 1 to {} values", most), fmt::format("write for example {}", example)});
    }
    std::vector<double> values;
    for (Node const& node : list.children) values.push_back(read_number(node, key));
    return values;
}

double read_number(Node const& node, Setting const& row) {
    double const value = read_number(node, row.unit);
    if (row.range.contains(value)) return value;
    std::string limits = fmt::format("{} {}", row.range.low_included ? ">=" : ">", with_unit(row.range.low, row.unit));
    if (std::isfinite(row.range.high)) limits += fmt::format(" and <= {}", with_unit(row.range.high, row.unit));
    refuse(node, shown_number(node, row.unit), {fmt::format("out of range for the {}", row.what), fmt::format("use a value {}", limits)});
}

std::uint64_t read_count(Node const& node, Setting const& setting) {
    return read_count(node, setting.what, setting.least, setting.most);
}

void read_value(Node const& node, Setting const& row, double& to) { to = read_number(node, row); }
void read_value(Node const& node, Setting const& row, std::uint64_t& to) { to = read_count(node, row); }
void read_value(Node const& node, Setting const& row, std::optional<std::uint64_t>& to) { to = read_count(node, row); }
void read_value(Node const& node, Setting const& row, bool& to) { to = row.type == Setting::Type::truth ? read_boolean(node) : read_choice(node, row) != 0; }
void read_value(Node const& node, Setting const& row, Span& to) { to = {read_number(node, row), row.unit == "1"}; }

std::size_t read_choice(Node const& node, Setting const& setting) { return read_choice(node, setting.what, setting.all_choices()); }

std::uint64_t read_count(Node const& node, std::string_view meaning, std::uint64_t low, std::uint64_t high) {
    Problem const problem{fmt::format("the {} must be an integer from {} to {}", meaning, low, high),
                          fmt::format("use an integer >= {} and <= {}", low, high)};
    constexpr double exact = 9007199254740992;  // 2^53: every integer below is a double
    bool const whole = node.type == Node::Type::real && node.real >= 0 && node.real <= exact && node.real == std::floor(node.real);
    bool const integral = whole || (node.type == Node::Type::integer && node.integer >= 0);
    if (!integral) refuse(node, problem);
    auto const value = whole ? static_cast<std::uint64_t>(node.real) : static_cast<std::uint64_t>(node.integer);
    if (value < low || value > high) refuse(node, problem);
    return value;
}

bool read_boolean(Node const& node) {
    if (node.type != Node::Type::boolean) refuse(node, {"not a truth value", "use true or false"});
    return node.boolean;
}

std::string const& read_text_value(Node const& node) {
    if (node.type != Node::Type::text) refuse(node, {"not a text", "put it in quotes"});
    return node.text;
}

std::string choice_advice(std::string_view name, std::span<std::string_view const> names) {
    std::string_view const near = nearest_name(name, names);
    if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
    return fmt::format("use one of {}", fmt::join(names, ", "));
}

std::size_t read_choice(Node const& node, std::string_view meaning, std::span<std::string_view const> names) {
    std::string const& text = read_text_value(node);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == text) return i;
    }
    refuse(node, {fmt::format("there is no such {}", meaning), choice_advice(text, names)});
}

}  // namespace slideway
