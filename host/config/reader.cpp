#include "host/config/reader.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/shown.hpp"
#include "host/base/suggest.hpp"
#include "host/config/scene_text.hpp"

namespace slideway {
namespace {

bool contains(std::span<std::string_view const> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check_known(Node const& root) {
    std::vector<std::string_view> tables, keys;
    for (Setting const& key : known_keys()) {
        keys.push_back(key.name);
        // The keys of a table stand together.
        if (!key.table().empty() && (tables.empty() || tables.back() != key.table())) tables.push_back(key.table());
    }
    std::vector<std::string_view> all = keys;
    all.insert(all.end(), tables.begin(), tables.end());
    for (Node const& node : root.children) {
        if (contains(tables, node.key)) {
            if (!node.is_table()) {
                refuse(node, {"it must be a table", fmt::format("write [{}] and its keys below", node.key)});
            }
            for (Node const& child : node.children) {
                if (child.key.find('.') != std::string::npos || !contains(all, child.name)) {
                    refuse_unknown(child, "key", all);
                }
            }
        } else if (node.key.find('.') != std::string::npos || !contains(keys, node.key)) {
            if (node.is_table()) refuse_unknown(node, "table", tables);
            refuse_unknown(node, "key", all);
        }
    }
}

void check_schema(Node const& root) {
    Node const* const schema = root.find("schema");
    if (schema == nullptr) {
        throw SceneError(
            fmt::format("{}: schema is missing (it says which format the scene is written in); "
                        "add the line schema = 1 at the top",
                        root.where));
    }
    if (schema->type != Node::Type::integer || schema->integer != 1) {
        refuse(*schema, {"this version of slideway reads schema 1", "write schema = 1"});
    }
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

/// The node to blame for a key's value: its own, that of a key which sets it too, or the whole scene.
Node const* find_given(std::vector<GivenKey> const& given, Key const* key) {
    Node const* found = nullptr;
    for (GivenKey const& entry : given) {
        if (key != nullptr && entry.key->overlaps(*key)) found = entry.node;  // the last one took effect
    }
    return found;
}

void check_inputs(Node const& root, Scene const& scene) {
    auto const found = find_defect(scene.inputs, scene.parts);
    if (!found) return;
    auto const given = given_keys(root);
    Node const* node = find_given(given, found->key);
    if (node == nullptr) node = find_given(given, found->other);
    throw SceneError(fmt::format("{}: {}", node != nullptr ? node->where : root.where,
                                 defect(scene.inputs, scene.parts).value_or("")));
}

}  // namespace

void read_bound(Node const& root, std::string_view table, Scene& scene, Settings rows) {
    for (Setting const& row : rows) {
        Node const* const node = row.value.read != nullptr && row.table() == table ? root.find_path(row.name) : nullptr;
        if (node != nullptr) row.value.read(scene, *node, row);
    }
}

void refuse_study(Node const& root, Node const* node, std::string_view key, Problem const& problem) {
    if (node != nullptr) refuse(*node, problem);
    Node const& kind = *root.find_path("study.kind");
    throw SceneError(fmt::format("{}: {} is not given ({}); {}", kind.where, key, problem.reason, problem.advice));
}

void refuse_meaningless(std::string_view where, std::string_view name, Mechanism mechanism) {
    throw SceneError(
        fmt::format("{}: {} has no meaning for kind = \"{}\"; remove it", where, name, info(mechanism).name));
}

void refuse_strange(Node const& node, Parts const& parts) {
    refuse(node, {fmt::format("contact.law \"{}\" does not know it", contact_info(parts).name), "remove it"});
}

void refuse_foreign_quantity(Node const& node, std::string_view name, Mechanism mechanism) {
    throw SceneError(
        fmt::format("{}: {} is no quantity of a {}; see `slideway list`", node.where, name, info(mechanism).name));
}

std::optional<Problem> why_unknown(Quantity quantity, Scene const& scene) {
    if (scene.parts.rigid && selects(without_rigid_contact, quantity)) {
        return Problem{"rigid contacts have neither peaks nor a potential", "remove it, or use another contact.law"};
    }
    if (!scene.parts.rigid && selects(of_rigid_contact, quantity)) {
        return Problem{"only impacts of rigid contacts have a bound of their energy", "remove it, or use contact.law = \"rigid\""};
    }
    if (quantity == Quantity::switching_energy && makes_energy(scene.parts) && !scene.integrator.locate_modes) {
        return Problem{"it is known where steps end at the switches, and here they leap over them", "set integrator.locate_modes = true"};
    }
    return {};
}

std::optional<Problem> why_unknown(Series series, Scene const& scene) {
    if (scene.integrator.method != Method::moreau_jean || !selects(series_without_time_stepping, series)) return {};
    return Problem{"moreau_jean knows impulses of whole steps, and no forces of an instant", "remove it, or use method = \"auto\""};
}

void refuse_at_rest(Node const& node, Parts const& parts, std::string_view instead) {
    refuse(node, {fmt::format("{}, so there are no revolutions", why_no_period(parts)), fmt::format("use {} instead", instead)});
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

Scene read_scene(std::string const& path, Overrides const& overrides) {
    return parse_scene(read_scene_text(path), path, overrides);
}

Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides) {
    Node const root = read_document(text, name, overrides);
    Scene scene;
    scene.path = name;
    read_modules(root, scene);
    check_known(root);
    check_schema(root);
    scene.title = read_title(root);
    read_physics(root, scene);
    check_inputs(root, scene);
    read_variations(root, scene);
    read_study(root, scene);
    check_restitution(root, scene);
    tell_of_contacts(root, scene);
    warn_of_idle_sources(root, scene);
    read_integrator(root, scene);
    read_recording(root, scene);
    warn_of_unusual(root, scene);
    prepare_sampler(scene);
    return scene;
}

}  // namespace slideway
