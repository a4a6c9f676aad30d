#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway {
namespace {

using Kind = Distribution::Kind;

DistributionForm const& read_form(Node const& node) {
    constexpr std::string_view example = "write for example { dist = \"unif\", low = 0, high = 1 }";
    if (!node.is_table()) refuse(node, {"not a distribution", std::string(example)});
    Node const* const dist = node.find("dist");
    if (dist == nullptr) refuse_that(node, "has no dist", {"how the key scatters", std::string(example)});
    std::vector<std::string_view> names;
    for (DistributionForm const& form : distribution_forms()) names.push_back(form.name);
    DistributionForm const& form = distribution_forms()[read_choice(*dist, "distribution", names)];
    for (Node const& child : node.children) {
        bool const known = child.key == "dist" || (child.key == "levels" && form.has_levels()) ||
                           std::ranges::any_of(form.arguments, [&](DistributionArgument const& argument) { return argument.name == child.key; });
        if (!known) refuse(child, {fmt::format("no argument of \"{}\"", form.name), fmt::format("use {}", listed_arguments(form))});
    }
    return form;
}

/// Of a distribution that is unbounded some values may break the key's rule: their members fail alone.
void check_distribution(Node const& node, Key const& key, Distribution const& d) {
    auto const refuse_argument = [&](std::string_view name, Problem const& problem) {
        auto const& arguments = form_of(d.kind).arguments;
        auto const& of = *std::ranges::find(arguments, name, &DistributionArgument::name);
        refuse(*node.find(name), with_unit(d.*of.member, of.plain ? "1" : key.unit), problem);
    };
    auto const shown = [&](double value) { return with_unit(value, key.unit); };
    bool const bounded = d.kind == Kind::uniform || d.kind == Kind::triangular || d.kind == Kind::truncated_normal;
    bool const above_low = d.kind == Kind::lognormal || d.kind == Kind::weibull;
    for (DistributionArgument const& argument : form_of(d.kind).arguments) {
        bool const by_rule = (argument.name == "low" || argument.name == "high") ? bounded : argument.name == "value" || (argument.name == "mean" && !bounded);
        auto const problem = by_rule ? broken_rule(key, d.*argument.member) : std::nullopt;
        if (problem) refuse_argument(argument.name, *problem);
        bool const positive = argument.name == "sd" || argument.name == "scale" || argument.name == "shape";
        if (positive && !(d.*argument.member > 0))
            refuse_argument(argument.name, {fmt::format("a {} is positive", argument.name == "sd" ? "standard deviation" : argument.name), "use a value > 0"});
    }
    if (bounded && !(d.low < d.high)) refuse_argument("high", {fmt::format("not above low, {}", shown(d.low)), "use low < high, or dist = \"const\""});
    if (d.kind == Kind::triangular && !(d.mode >= d.low && d.mode <= d.high))
        refuse_argument("mode", {fmt::format("outside low and high, {} and {}", shown(d.low), shown(d.high)), "use low <= mode <= high"});
    // Beyond some 37 standard deviations the tail's probability is no longer a double.
    constexpr double farthest = 30;
    if (d.kind == Kind::truncated_normal && !(d.low - d.mean <= farthest * d.sd && d.mean - d.high <= farthest * d.sd))
        refuse_argument("mean", {"it lies more than 30 sd outside low and high", "move the mean or the limits"});
    // Values lie above low, which itself may break the rule: a positive key may begin at 0.
    auto const at_low = above_low ? broken_rule(key, std::nextafter(d.low, std::numeric_limits<double>::infinity())) : std::nullopt;
    if (at_low && node.find("low") != nullptr) refuse_argument("low", *at_low);
    if (at_low) refuse_that(node, "has no low", {"its values would begin at 0: " + at_low->reason, "add low = ..., " + at_low->advice});
    if (d.kind == Kind::lognormal && !(d.mean > d.low))
        refuse_argument("mean", {fmt::format("not above low, {}", shown(d.low)), "use mean > low, above which all values lie"});
}

/// How a key scatters; every value that it bounds meets the key's rule.  Leaves `levels` to the design.
Distribution read_distribution(Node const& node, Key const& key) {
    DistributionForm const& form = read_form(node);
    Distribution distribution;
    distribution.kind = form.kind;
    for (DistributionArgument const& argument : form.arguments) {
        Node const* const child = node.find(argument.name);
        if (child == nullptr) {
            if (argument.optional) continue;
            refuse_that(node, fmt::format("has no {}", argument.name),
                        {fmt::format("\"{}\" needs {}", form.name, listed_arguments(form)), fmt::format("add {} = ...", argument.name)});
        }
        if (argument.member == nullptr) distribution.list = read_list(*child, key, 10'000, "[1, 2]");
        else distribution.*argument.member = read_number(*child, argument.plain ? "1" : key.unit);
    }
    if (form.kind != Kind::values) check_distribution(node, key, distribution);
    return distribution;
}

/// "joint.clearance" = {…} and joint.clearance = {…} mean the same: tables of nothing but tables are descended into.
void collect_variations(Node const& table, std::vector<Node const*>& found) {
    for (Node const& node : table.children) {
        bool const group = node.is_table() && !node.children.empty() && std::ranges::all_of(node.children, &Node::is_table);
        if (group) collect_variations(node, found);
        else found.push_back(&node);
    }
}

}  // namespace

std::string key_advice(std::string_view name, Scene const& scene) {
    std::string_view const near = nearest_name(name, numeric_key_names(scene));
    return near.empty() ? std::string("use a dotted key like \"joint.clearance\"") : fmt::format("did you mean \"{}\"?", near);
}

bool varies(Scene const& scene, std::string_view name) {
    return std::ranges::any_of(scene.variations, [&](Variation const& one) { return one.key->name == name; }) ||
           (scene.chaos.parameter != nullptr && scene.chaos.parameter->name == name);
}

bool is_of_start(Key const& key) { return key.name.starts_with("initial.") || key.name == "mechanism.start_angle"; }

void check_varied(Reading const& reading, Node const& node, Key const& key, Problem const& of_option) {
    Scene const& scene = reading.scene;
    for (Variation const& other : scene.variations) {
        if (!other.key->overlaps(key)) continue;
        bool const drawn = other.column == Variation::no_column;
        refuse(node, {drawn ? fmt::format("study.vary.{} varies the same", other.key->name) : fmt::format("the column {} has the same", other.key->name),
                      "remove one of the two"});
    }
    for (GivenKey const& given : given_keys(reading)) {
        if (given.node->order > 0 && given.key->overlaps(key)) refuse(*given.node, of_option);
    }
    if (!counts_for(key, scene.parts.mechanism)) refuse_meaningless(node.where, key.name, scene.parts.mechanism);
    if (is_replaced_by_drive(key, scene.parts)) refuse_replaced(node, key, scene.parts);
    if (!counts_for(key, scene.parts)) refuse_strange(node, scene.parts);
    apply_rules(reading, key, node);
    if (key.member != &Inputs::restitution) return;
    for (std::string_view const replaced : rates_of_damping) {
        if (Node const* const given = reading.given(replaced)) refuse(*given, {"contact.restitution is varied and replaces it", "remove one of the two"});
        if (varies(scene, replaced)) refuse(node, {fmt::format("it replaces {}, which varies too", replaced), "remove one of the two"});
    }
}

std::vector<Node const*> varied_nodes(Node const& root) {
    Node const* const table = root.find_path("study.vary");
    if (table == nullptr) return {};
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.vary] and its keys below"});
    std::vector<Node const*> entries;
    collect_variations(*table, entries);
    return entries;
}

std::string_view varied_name(Node const& node) { return std::string_view(node.name).substr(std::string_view("study.vary.").size()); }

void read_variations(Reading& reading) {
    for (Node const* const node : varied_nodes(reading.root)) {
        Key const* const key = find_key(varied_name(*node), reading.scene);
        if (key == nullptr) refuse_ungiven(node->where, varied_name(*node), reading.scene);
        if (key == nullptr) refuse_that(*node, "cannot vary", {"only numeric keys of the physics can", key_advice(varied_name(*node), reading.scene)});
        Distribution distribution = read_distribution(*node, *key);
        check_varied(reading, *node, *key, {"[study.vary] draws it for every member, so this has no effect",
                                            fmt::format("use --set 'study.vary.\"{}\"={{dist=\"const\", value=...}}'", key->name)});
        require_part(reading.scene.parts, *key);
        reading.scene.variations.push_back({key, std::move(distribution), node->line});
    }
}

}  // namespace slideway
