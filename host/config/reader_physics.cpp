#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/backend.hpp"
#include "host/backend/own_modules.hpp"
#include "host/base/text.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// What a node names, if it is there.  What is no text is refused later, where all is.  @param choose whether there is one of this name, which it takes
template <class Choose>
void read_named(Node const* node, ModuleKind kind, std::span<std::string_view const> known, Choose choose, std::string_view what, Scene const& scene) {
    if (node == nullptr || node->type != Node::Type::text) return;
    try {
        if (choose(node->text)) return;
    } catch (DeviceError const& error) {
        throw SceneError(fmt::format("{}: {}", node->where, error.what()));
    }
    std::vector<std::string_view> names(known.begin(), known.end());
    auto const own = own_module_names(kind, scene.modules);
    names.insert(names.end(), own.begin(), own.end());
    std::string advice = choice_advice(node->text, names);
    // A name that is like none is of a module that is not there, or of another version of slideway.
    if (is_module_name(node->text) && nearest_name(node->text, names).empty()) {
        advice += ", or compile your header that has it (slideway compile)";
        if (!scene.modules.empty()) advice += fmt::format("; no module of this version has it in {}", fmt::join(scene.modules, ", "));
    }
    refuse(*node, {fmt::format("there is no such {}", what), advice});
}

/// Where --set names another law than the file, the file may have keys of its own one: that is opened too, whichever it is.
void open_for_keys(Reading const& reading, std::string_view table, ModuleKind kind) {
    Node const* const given = reading.root.find(table);
    if (given == nullptr || !given->is_table()) return;
    auto const is_known = [&](Node const& node) {
        return find_key(node.name) != nullptr || std::ranges::find(reading.keys, node.name, &Setting::name) != reading.keys.end();
    };
    if (std::ranges::all_of(given->children, is_known)) return;
    open_modules(kind, reading.scene.modules, [](std::string const&) {});  // of one that is refused the key stays unknown
}

void check_rivals(std::vector<GivenKey> const& given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
        for (std::size_t j = i + 1; j < given.size(); ++j) {
            // An option may refine what the file says in general: the later one takes effect.
            bool const both_in_file = given[i].node->order == 0 && given[j].node->order == 0;
            if (!both_in_file || !given[i].key->overlaps(*given[j].key)) continue;
            refuse(*given[j].node, {fmt::format("{} in line {} sets it too", given[i].key->name, given[i].node->line), "remove one of the two"});
        }
    }
}

/// Which mechanism, and that nothing is given that does not count for it.
void read_mechanism(Reading& reading) {
    Parts& parts = reading.scene.parts;
    if (Node const* const kind = reading.given("mechanism.kind")) read_text_value(*kind);
    Node const* const law = reading.given("contact.law");
    for (auto const& [key, node] : given_keys(reading)) {
        if (!counts_for(*key, parts.mechanism)) refuse_meaningless(node->where, node->name, parts.mechanism);
    }
    apply_rules(reading, Known::mechanism);
    reading.read_table("mechanism");
    if (law != nullptr) read_text_value(*law);
    else if (info(parts.mechanism).spatial) parts.law = default_law;
}

/// Every number that is given, each with the law that the scene has.
void read_numbers(Reading& reading) {
    Scene& scene = reading.scene;
    Node const* const law = reading.given("contact.law");
    auto const given = given_keys(reading);
    for (auto const& [key, node] : given) {
        if (counts_for(*key, scene.parts)) {
            key->set(scene.inputs, read_number(*node, *key));
            continue;
        }
        if (is_replaced_by_drive(*key, scene.parts)) refuse_replaced(*node, *key, scene.parts);
        // An option may choose another law than the file, which has the keys of its own.
        bool const of_another = law != nullptr && law->order > 0 && node->order == 0;
        if (!of_another) refuse_strange(*node, scene.parts);
        reading.warn(fmt::format("{}: {} has no effect, for contact.law \"{}\" does not know it", node->where, node->name, contact_info(scene.parts).name));
    }
    check_rivals(given);
}

}  // namespace

std::vector<GivenKey> given_keys(Reading const& reading) {
    std::vector<GivenKey> given;
    auto const add = [&](Node const& table, auto const& add_below) -> void {
        for (Node const& node : table.children) {
            if (Key const* const key = find_key(node.name, reading.scene)) given.push_back({key, &node});
            else if (has_named_tables(table.key)) add_below(node, add_below);
        }
    };
    for (Node const& table : reading.root.children) add(table, add);
    std::ranges::stable_sort(given, {}, [](GivenKey const& one) { return one.node->order; });
    return given;
}

void read_modules(Reading& reading) {
    Scene& scene = reading.scene;
    if (Node const* const search = reading.given("modules.search")) {
        if (search->type != Node::Type::array) refuse(*search, {"it must be a list of folders", "write for example [\".\"]"});
        for (Node const& folder : search->children) {
            if (folder.type != Node::Type::text || folder.text.empty()) refuse(folder, {"not a folder", "write for example [\".\"]"});
            auto const path = std::filesystem::absolute(std::filesystem::path(scene.path).parent_path() / folder.text);
            scene.modules.push_back(path.lexically_normal().string());
        }
    }
    auto const choose_mechanism = [&](std::string_view name) {
        auto const found = find_mechanism(name, scene.modules);
        return scene.parts.mechanism = found.value_or(scene.parts.mechanism), found.has_value();
    };
    auto const choose_law = [&](std::string_view name) { return choose_contact(scene.parts, name, scene.modules); };
    read_named(reading.given("mechanism.kind"), ModuleKind::mechanism, mechanism_kinds(), choose_mechanism, "mechanism", scene);
    read_named(reading.given("contact.law"), ModuleKind::law, contact_law_names(), choose_law, "contact law", scene);
    open_for_keys(reading, "contact", ModuleKind::law);
    open_for_keys(reading, "mechanism", ModuleKind::mechanism);
}

void read_physics(Reading& reading) {
    choose_drive(reading);
    read_mechanism(reading);
    read_drive(reading);
    read_linkage(reading);
    read_loads(reading);
    Scene& scene = reading.scene;
    Parts& parts = scene.parts;
    scene.inputs = with_presets(scene.inputs, parts);
    read_numbers(reading);
    finish_drive(scene);
    Node const* const restitution = reading.given("contact.restitution");
    if (needs_restitution(parts) || (restitution != nullptr && counts_for(*find_key("contact.restitution"), parts))) {
        parts.damping = Damping::restitution;
    } else if (scene.inputs.chi_line != 0 || scene.inputs.chi_surface != 0) {
        parts.damping = Damping::rate;
    }
    apply_rules(reading, Known::contacts);
    parts.misaligned_way = reading.given("way") != nullptr || std::ranges::any_of(given_keys(reading), [](GivenKey const& given) { return lays_way(*given.key); });
    parts.offset_slider = std::ranges::any_of(input_keys, [&](Key const& key) { return is_of_body(key) && key.get(scene.inputs) != 0; });
    parts.friction = reading.given("friction") != nullptr;
    reading.read_table("friction");
}

void warn_of_idle_sources(Reading& reading) {
    auto const warn = [&](Key const& key) {
        if (!is_idle_source(key, reading.scene.parts, given_or_varied(reading.scene))) return;
        reading.warn(fmt::format("{} has no effect, for all masses and inertias that would follow from it are given", key.name));
    };
    for (auto const& [key, node] : given_keys(reading)) warn(*key);
    for (Variation const& variation : reading.scene.variations) warn(*variation.key);
    if (reading.scene.chaos.parameter != nullptr) warn(*reading.scene.chaos.parameter);
}

}  // namespace slideway
