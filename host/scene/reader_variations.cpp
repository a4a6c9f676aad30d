#include <fmt/format.h>

#include "host/scene/reader.hpp"
#include "host/scene/scene_text.hpp"
#include "host/scene/suggest.hpp"
#include "host/scene/values.hpp"

namespace slideway {
namespace {

struct Argument {
    std::string_view name;
    double Distribution::*member;
};
struct Form {
    std::string_view name;
    Distribution::Kind kind;
    std::vector<Argument> arguments;
};

std::vector<Form> const& forms() {
    using D = Distribution;
    static std::vector<Form> const all = {
        {"const", D::Kind::constant, {{"value", &D::mean}}},
        {"unif", D::Kind::uniform, {{"low", &D::low}, {"high", &D::high}}},
        {"norm", D::Kind::normal, {{"mean", &D::mean}, {"sd", &D::sd}}},
        {"truncnorm",
         D::Kind::truncated_normal,
         {{"mean", &D::mean}, {"sd", &D::sd}, {"low", &D::low}, {"high", &D::high}}},
    };
    return all;
}

Form const& read_form(Node const& node) {
    constexpr std::string_view example = "{ dist = \"unif\", low = 0, high = 1 }";
    if (!node.is_table()) refuse(node, {"not a distribution", fmt::format("write for example {}", example)});
    Node const* const dist = node.find("dist");
    if (dist == nullptr) {
        throw SceneError(fmt::format("{}: {} has no dist (how the key scatters); write for example {}", node.where,
                                     one_line(node.name), example));
    }
    std::vector<std::string_view> names;
    for (Form const& form : forms()) names.push_back(form.name);
    return forms()[read_choice(*dist, "distribution", names)];
}

std::string listed(Form const& form) {
    std::string text;
    for (Argument const& argument : form.arguments) {
        if (!text.empty()) text += ", ";
        text += argument.name;
    }
    return text;
}

/// Values that the key cannot take must not be drawn; where the support is unbounded, the mean is held to the rule.
void check_support(Node const& node, Form const& form, Key const& key, Distribution const& distribution) {
    auto const refuse_argument = [&](std::string_view name, double value, Problem const& problem) {
        refuse(*node.find(name), with_unit(value, key.unit), problem);
    };
    bool const bounded = form.kind == Distribution::Kind::uniform || form.kind == Distribution::Kind::truncated_normal;
    bool const spread = form.kind == Distribution::Kind::normal || form.kind == Distribution::Kind::truncated_normal;
    for (Argument const& argument : form.arguments) {
        if (argument.name == "sd" || (bounded && argument.name == "mean")) continue;
        double const value = distribution.*argument.member;
        if (auto const problem = broken_rule(key, value)) refuse_argument(argument.name, value, *problem);
    }
    if (spread && !(distribution.sd > 0)) {
        refuse_argument("sd", distribution.sd, {"a standard deviation is positive", "use a value > 0"});
    }
    if (!bounded) return;
    if (!(distribution.low < distribution.high)) {
        refuse_argument("high", distribution.high,
                        {fmt::format("not above low, {}", with_unit(distribution.low, key.unit)),
                         "use low < high, or dist = \"const\""});
    }
    // Beyond some 37 standard deviations the tail's probability is no longer a double.
    constexpr double farthest = 30;
    if (spread && !(distribution.low - distribution.mean <= farthest * distribution.sd &&
                    distribution.mean - distribution.high <= farthest * distribution.sd)) {
        refuse_argument("mean", distribution.mean,
                        {"it lies more than 30 sd outside low and high", "move the mean or the limits"});
    }
}

Variation read_variation(Node const& node, std::string_view name) {
    Key const* const key = find_key(name);
    if (key == nullptr) {
        throw SceneError(fmt::format("{}: {} cannot vary (only numeric keys of the physics can); {}", node.where,
                                     one_line(node.name), key_advice(name)));
    }
    Form const& form = read_form(node);
    Distribution distribution;
    distribution.kind = form.kind;
    for (Node const& child : node.children) {
        bool known = child.key == "dist";
        for (Argument const& argument : form.arguments) known = known || argument.name == child.key;
        if (!known) {
            refuse(child, {fmt::format("no argument of \"{}\"", form.name), fmt::format("use {}", listed(form))});
        }
    }
    for (Argument const& argument : form.arguments) {
        Node const* const child = node.find(argument.name);
        if (child == nullptr) {
            throw SceneError(fmt::format("{}: {} has no {} (\"{}\" needs {}); add {} = ...", node.where,
                                         one_line(node.name), argument.name, form.name, listed(form), argument.name));
        }
        distribution.*argument.member = read_number(*child, key->unit);
    }
    check_support(node, form, *key, distribution);
    return {key, distribution, node.line};
}

struct NamedNode {
    std::string name;  // below study.vary
    Node const* node;
};

/// "joint.clearance" = {…} and joint.clearance = {…} mean the same: tables of nothing but tables are descended into.
void collect_variations(Node const& table, std::string const& prefix, std::vector<NamedNode>& found) {
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

void check_clashes(Node const& root, NamedNode const& entry, Scene const& scene, Variation const& variation) {
    for (Variation const& other : scene.variations) {
        if (other.key->overlaps(*variation.key)) {
            refuse(*entry.node,
                   {fmt::format("study.vary.{} varies the same", other.key->name), "remove one of the two"});
        }
    }
    for (GivenKey const& given : given_keys(root)) {
        if (given.node->order > 0 && given.key->overlaps(*variation.key)) {
            refuse(*given.node,
                   {"[study.vary] draws it for every member, so this has no effect",
                    fmt::format("use --set 'study.vary.\"{}\"={{dist=\"const\", value=...}}'", variation.key->name)});
        }
    }
    check_counts(root, *entry.node, *variation.key, scene);
}

}  // namespace

std::string key_advice(std::string_view name) {
    std::vector<std::string_view> names;
    for (auto const table : {keys(), twin_keys()}) {
        for (Key const& known : table) names.push_back(known.name);
    }
    std::string_view const near = nearest_name(name, names);
    return near.empty() ? std::string("use a dotted key like \"joint.clearance\"")
                        : fmt::format("did you mean \"{}\"?", near);
}

void check_counts(Node const& root, Node const& node, Key const& key, Scene const& scene) {
    std::string_view const name = key.name;
    if (name.starts_with("friction.") && !scene.parts.friction) {
        refuse(node, {"friction is off", "add a [friction] table"});
    }
    bool const rate = name == "contact.eta" || name.starts_with("contact.chi_");
    if (rate && scene.parts.damping == Damping::restitution) {
        refuse(node, {"contact.restitution replaces it", "remove one of the two"});
    }
    if (name != "contact.restitution") return;
    for (std::string_view const replaced : {"contact.eta", "contact.chi_line", "contact.chi_surface"}) {
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

void read_variations(Node const& root, Scene& scene) {
    Node const* const table = root.find_path("study.vary");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.vary] and its keys below"});
    std::vector<NamedNode> entries;
    collect_variations(*table, "", entries);
    for (NamedNode const& entry : entries) {
        Variation const variation = read_variation(*entry.node, entry.name);
        check_clashes(root, entry, scene, variation);
        require_part(scene.parts, *variation.key);
        scene.variations.push_back(variation);
    }
}

}  // namespace slideway
