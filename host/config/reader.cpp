#include "host/config/reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/text.hpp"
#include "host/config/document.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/outputs.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

bool contains(std::span<std::string_view const> names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

void check_known(Reading const& reading) {
    std::vector<std::string_view> tables, keys;
    for (Setting const& key : reading.keys) {
        keys.push_back(key.name);
        // The keys of a table stand together.
        if (!key.table().empty() && (tables.empty() || tables.back() != key.table())) tables.push_back(key.table());
    }
    std::vector<std::string_view> all = keys;
    all.insert(all.end(), tables.begin(), tables.end());
    for (Node const& node : reading.root.children) {
        if (has_named_tables(node.key)) continue;
        bool const is_table = contains(tables, node.key);
        if (is_table && !node.is_table()) refuse(node, {"it must be a table", fmt::format("write [{}] and its keys below", node.key)});
        for (Node const& child : node.children) {
            if (child.name == former_crank) continue;  // choose_drive does it
            if (is_table && (child.key.find('.') != std::string::npos || !contains(all, child.name))) refuse_unknown(child, "key", all);
        }
        if (is_table || (node.key.find('.') == std::string::npos && contains(keys, node.key))) continue;
        if (node.is_table()) refuse_unknown(node, "table", tables);
        refuse_unknown(node, "key", all);
    }
}

void check_schema(Node const& root) {
    Node const* const schema = root.find("schema");
    if (schema == nullptr) refuse_missing(root, "schema", "it says which format the scene is written in", "add the line schema = 1 at the top");
    if (schema->type != Node::Type::integer || schema->integer != 1) refuse(*schema, {"this version of slideway reads schema 1", "write schema = 1"});
}

/// A title is one line of pages and summaries, and its line of the resolved scene must be one that is read again.
std::string read_title(Node const& root) {
    constexpr std::size_t most_characters = 1000, longest_line = 4000;
    Node const* const node = root.find("title");
    if (node == nullptr) return {};
    std::string const& title = read_text_value(*node);
    auto const goes_on = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u; };
    auto const characters = title.size() - static_cast<std::size_t>(std::ranges::count_if(title, goes_on));
    if (characters > most_characters || shown(toml_string(title)).size() > longest_line) {
        std::string const reason = characters > most_characters ? fmt::format("{} characters", characters)
                                                                : fmt::format("more than {} bytes as a line of a scene", longest_line);
        refuse(*node, {reason, fmt::format("use at most {} characters, and put notes into comments", most_characters)});
    }
    return title;
}

/// Blames a key's own node, that of a key which sets it too, or the whole scene.
void check_inputs(Reading const& reading) {
    Scene const& scene = reading.scene;
    auto const found = find_defect(scene.inputs, scene.parts);
    if (!found) return;
    Node const* node = nullptr;
    for (Key const* const key : {found->other, found->key}) {
        for (GivenKey const& entry : given_keys(reading)) {
            if (key != nullptr && entry.key->overlaps(*key)) node = entry.node;  // the last one took effect
        }
    }
    std::string const line = fmt::format("{}: {}", node != nullptr ? node->where : reading.root.where, defect(scene.inputs, scene.parts).value_or(""));
    refuse_open(scene, line);
    throw SceneError(line);
}

}  // namespace

Node const* Reading::given_of(std::initializer_list<std::string_view> names) const {
    for (std::string_view const name : names) {
        if (Node const* const node = given(name)) return node;
    }
    return nullptr;
}

bool has_named_tables(std::string_view table) { return has_named_loads(table) || table == body_table || table == link_table; }

void Reading::read_table(std::string_view table) {
    for (Setting const& row : keys) {
        Node const* const node = row.value.read != nullptr && row.table() == table ? given(row.name) : nullptr;
        if (node != nullptr) row.value.read(scene, *node, row);
    }
}

std::string_view Reading::named_now(Node const& node, std::string_view name) {
    std::string_view const now = name_of_now(name);
    if (now != name) warn(fmt::format("{}: {} is the name of an earlier version; write {}", node.where, name, now));
    return now;
}

void refuse_study(Node const& root, Node const* node, std::string_view key, Problem const& problem) {
    if (node != nullptr) refuse(*node, problem);
    throw SceneError(fmt::format("{}: {} is not given ({}); {}", root.find_path("study.kind")->where, key, problem.reason, problem.advice));
}

void refuse_meaningless(std::string_view where, std::string_view name, Mechanism mechanism) {
    throw SceneError(fmt::format("{}: {} has no meaning for kind = \"{}\"; remove it", where, name, kind_of(mechanism)));
}

void refuse_replaced(Node const& node, Key const& key, Parts const& parts) {
    std::string_view const kind = drive_names[static_cast<int>(parts.drive.by)], why = key.group == KeyGroup::drive ? "does not have it" : "says how fast";
    throw SceneError(fmt::format("{}: {} is given (drive.kind \"{}\" {}); remove it, or use another kind", node.where, key.name, kind, why));
}

void refuse_strange(Node const& node, Parts const& parts) {
    refuse(node, {fmt::format("contact.law \"{}\" does not know it", contact_info(parts).name), "remove it"});
}

void refuse_missing(Node const& asking, std::string_view key, std::string_view why, std::string_view advice) {
    throw SceneError(fmt::format("{}: {} is missing ({}); {}", asking.where, key, why, advice));
}

void check_arguments(Node const& table, std::string_view what, std::initializer_list<std::string_view> known) {
    for (Node const& node : table.children) {
        if (std::ranges::count(known, node.key) == 0) refuse(node, {fmt::format("no argument of a {}", what), fmt::format("use {}", fmt::join(known, ", "))});
    }
}

void refuse_unknown(Node const& node, std::string_view what, std::span<std::string_view const> known) {
    std::string_view const near = nearest_name(node.name, known);
    std::string const advice = near.empty()        ? std::string("remove it, or see `slideway list`")
                               : near == node.name ? std::string("write it without quotes")
                                                   : fmt::format("did you mean {}?", near);
    refuse_that(node, fmt::format("is no {} of a scene", what), {"mistyped, it would have no effect", advice});
}

Scene read_scene(std::string const& path, Overrides const& overrides) { return parse_scene(read_scene_text(path), path, overrides); }

Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides, Scene const* former) {
    return parse_scene(text, name, overrides, settings(), key_rules(), former);
}

Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides, Settings rows, KeyRules rules, Scene const* former) {
    Node const root = read_document(text, name, overrides);
    Scene scene;
    scene.path = name;
    Reading reading{root, scene, rows, rules, former};
    read_modules(reading);
    // The program's own rows are known with all numbers; of others they are put together.
    bool const own = rows.data() == settings().data();
    std::vector<Setting> const keys = own ? std::vector<Setting>() : with_physics(rows);
    reading.keys = own ? known_keys() : Settings(keys);
    check_known(reading);
    check_schema(root);
    scene.title = read_title(root);
    read_physics(reading);
    check_inputs(reading);
    read_variations(reading);
    read_study(reading);
    warn_of_idle_sources(reading);
    read_integrator(reading);
    read_recording(reading);
    check_profile(reading, runs_to_end(scene.study) ? scene.integrator.end_time : run_length(scene).longest);
    warn_of_unusual(reading);
    prepare_sampler(scene);
    return scene;
}

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
