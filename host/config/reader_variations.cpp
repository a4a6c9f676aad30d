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
    constexpr std::string_view example = "{ dist = \"unif\", low = 0, high = 1 }";
    if (!node.is_table()) refuse(node, {"not a distribution", fmt::format("write for example {}", example)});
    Node const* const dist = node.find("dist");
    if (dist == nullptr) refuse_that(node, "has no dist", {"how the key scatters", fmt::format("write for example {}", example)});
    std::vector<std::string_view> names;
    for (DistributionForm const& form : distribution_forms()) names.push_back(form.name);
    return distribution_forms()[read_choice(*dist, "distribution", names)];
}

void refuse_unknown_arguments(Node const& node, DistributionForm const& form) {
    for (Node const& child : node.children) {
        bool known = child.key == "dist" || (child.key == "levels" && form.has_levels());
        for (DistributionArgument const& argument : form.arguments) known = known || argument.name == child.key;
        if (!known) {
            refuse(child,
                   {fmt::format("no argument of \"{}\"", form.name), fmt::format("use {}", listed_arguments(form))});
        }
    }
}

/// A distribution and where its arguments stand, for what they must meet.
class Check {
public:
    Check(Node const& node, Key const& key, Distribution const& distribution)
        : node_(node), key_(key), d_(distribution) {}

    void run() const {
        switch (d_.kind) {
            case Kind::constant:
                return rule("value", d_.mean);
            case Kind::uniform:
                return ends();
            case Kind::triangular:
                ends();
                return within_ends("mode", d_.mode);
            case Kind::normal:
                // Without bounds some values may break the rule: their members fail alone.
                rule("mean", d_.mean);
                return positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
            case Kind::truncated_normal:
                rule("low", d_.low);
                rule("high", d_.high);
                positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
                ordered();
                return near_ends();
            case Kind::lognormal:
                lower_end();
                rule("mean", d_.mean);
                positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
                if (!(d_.mean > d_.low)) {
                    refuse_argument("mean", d_.mean, key_.unit,
                                    {fmt::format("not above low, {}", with_unit(d_.low, key_.unit)),
                                     "use mean > low, above which all values lie"});
                }
                return;
            case Kind::weibull:
                lower_end();
                positive("scale", d_.scale, key_.unit, "a scale is positive");
                return positive("shape", d_.shape, "1", "a shape is positive");
            case Kind::values:
                return;  // each was read within the rule
        }
    }

private:
    [[noreturn]] void refuse_argument(std::string_view name, double value, std::string_view unit,
                                      Problem const& problem) const {
        refuse(*node_.find(name), with_unit(value, unit), problem);
    }
    void rule(std::string_view name, double value) const {
        if (auto const problem = broken_rule(key_, value)) refuse_argument(name, value, key_.unit, *problem);
    }
    void positive(std::string_view name, double value, std::string_view unit, std::string const& reason) const {
        if (!(value > 0)) refuse_argument(name, value, unit, {reason, "use a value > 0"});
    }
    void ordered() const {
        if (d_.low < d_.high) return;
        refuse_argument(
            "high", d_.high, key_.unit,
            {fmt::format("not above low, {}", with_unit(d_.low, key_.unit)), "use low < high, or dist = \"const\""});
    }
    void ends() const {
        rule("low", d_.low);
        rule("high", d_.high);
        ordered();
    }
    void within_ends(std::string_view name, double value) const {
        if (value >= d_.low && value <= d_.high) return;
        refuse_argument(name, value, key_.unit,
                        {fmt::format("outside low and high, {} and {}", with_unit(d_.low, key_.unit),
                                     with_unit(d_.high, key_.unit)),
                         fmt::format("use low <= {} <= high", name)});
    }
    void near_ends() const {
        // Beyond some 37 standard deviations the tail's probability is no longer a double.
        constexpr double farthest = 30;
        if (d_.low - d_.mean <= farthest * d_.sd && d_.mean - d_.high <= farthest * d_.sd) return;
        refuse_argument("mean", d_.mean, key_.unit,
                        {"it lies more than 30 sd outside low and high", "move the mean or the limits"});
    }
    /// Values lie above low, which itself may break the rule: a positive key may begin at 0.
    void lower_end() const {
        auto const problem = broken_rule(key_, std::nextafter(d_.low, std::numeric_limits<double>::infinity()));
        if (!problem) return;
        if (node_.find("low") != nullptr) refuse_argument("low", d_.low, key_.unit, *problem);
        refuse_that(node_, "has no low", {"its values would begin at 0: " + problem->reason, "add low = ..., " + problem->advice});
    }

    Node const& node_;
    Key const& key_;
    Distribution const& d_;
};

/// How a key scatters; every value that it bounds meets the key's rule.  Leaves `levels` to the design.
Distribution read_distribution(Node const& node, Key const& key) {
    DistributionForm const& form = read_form(node);
    refuse_unknown_arguments(node, form);
    Distribution distribution;
    distribution.kind = form.kind;
    for (DistributionArgument const& argument : form.arguments) {
        Node const* const child = node.find(argument.name);
        if (child == nullptr) {
            if (argument.optional) continue;
            refuse_that(node, fmt::format("has no {}", argument.name),
                        {fmt::format("\"{}\" needs {}", form.name, listed_arguments(form)), fmt::format("add {} = ...", argument.name)});
        }
        if (argument.member == nullptr) {
            distribution.list = read_list(*child, key, 10'000, "[1, 2]");
        } else {
            distribution.*argument.member = read_number(*child, argument.plain ? "1" : key.unit);
        }
    }
    Check(node, key, distribution).run();
    return distribution;
}

Variation read_variation(Node const& node, std::string_view name) {
    Key const* const key = find_key(name);
    if (key == nullptr) refuse_that(node, "cannot vary", {"only numeric keys of the physics can", key_advice(name)});
    return {key, read_distribution(node, *key), node.line};
}

/// "joint.clearance" = {…} and joint.clearance = {…} mean the same: tables of nothing but tables are descended into.
void collect_variations(Node const& table, std::string const& prefix, std::vector<VariedNode>& found) {
    for (Node const& node : table.children) {
        bool group = node.is_table() && !node.children.empty();
        for (Node const& child : node.children) group = group && child.is_table();
        std::string const name = prefix + node.key;
        if (group) {
            collect_variations(node, name + ".", found);
        } else {
            found.push_back({name, &node});
        }
    }
}

}  // namespace

std::string key_advice(std::string_view name) {
    std::string_view const near = nearest_name(name, numeric_key_names());
    return near.empty() ? std::string("use a dotted key like \"joint.clearance\"")
                        : fmt::format("did you mean \"{}\"?", near);
}

void check_varied(Node const& root, Node const& node, Key const& key, Scene const& scene, Problem const& of_option) {
    for (Variation const& other : scene.variations) {
        if (!other.key->overlaps(key)) continue;
        bool const drawn = other.column == Variation::no_column;
        refuse(node, {drawn ? fmt::format("study.vary.{} varies the same", other.key->name) : fmt::format("the column {} has the same", other.key->name),
                      "remove one of the two"});
    }
    for (GivenKey const& given : given_keys(root)) {
        if (given.node->order > 0 && given.key->overlaps(key)) refuse(*given.node, of_option);
    }
    std::string_view const name = key.name;
    if (!counts_for(key, scene.parts.mechanism)) refuse_meaningless(node.where, name, scene.parts.mechanism);
    if (!counts_for(key, scene.parts)) refuse_strange(node, scene.parts);
    if (name.starts_with("friction.") && !scene.parts.friction) {
        refuse(node, {"friction is off", "add a [friction] table"});
    }
    if (std::ranges::count(rates_of_damping, name) > 0 && scene.parts.damping == Damping::restitution) {
        refuse(node, {"contact.restitution replaces it", "remove one of the two"});
    }
    if (name != "contact.restitution") return;
    for (std::string_view const replaced : rates_of_damping) {
        if (Node const* const given = root.find_path(replaced)) {
            refuse(*given, {"contact.restitution is varied and replaces it", "remove one of the two"});
        }
        for (Variation const& other : scene.variations) {
            if (other.key->name == replaced) {
                refuse(node, {fmt::format("it replaces {}, which varies too", replaced), "remove one of the two"});
            }
        }
    }
}

std::vector<VariedNode> varied_nodes(Node const& root) {
    Node const* const table = root.find_path("study.vary");
    if (table == nullptr) return {};
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.vary] and its keys below"});
    std::vector<VariedNode> entries;
    collect_variations(*table, "", entries);
    return entries;
}

void read_variations(Node const& root, Scene& scene) {
    for (VariedNode const& entry : varied_nodes(root)) {
        Variation const variation = read_variation(*entry.node, entry.name);
        check_varied(root, *entry.node, *variation.key, scene,
                     {"[study.vary] draws it for every member, so this has no effect",
                      fmt::format("use --set 'study.vary.\"{}\"={{dist=\"const\", value=...}}'", variation.key->name)});
        require_part(scene.parts, *variation.key);
        scene.variations.push_back(variation);
    }
}

}  // namespace slideway
