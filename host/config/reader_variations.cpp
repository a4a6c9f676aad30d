#include <algorithm>

#include <fmt/format.h>

#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"
#include "host/config/scene_text.hpp"
#include "host/config/values.hpp"

namespace slideway {
namespace {

Variation read_variation(Node const& node, std::string_view name) {
    Key const* const key = find_key(name);
    if (key == nullptr) {
        throw SceneError(fmt::format("{}: {} cannot vary (only numeric keys of the physics can); {}", node.where,
                                     one_line(node.name), key_advice(name)));
    }
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
        refuse(node, {drawn ? fmt::format("study.vary.{} varies the same", other.key->name) : fmt::format("column {} has the same", other.column + 1),
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
