// Laws and mechanisms of one's own: their modules are opened before anything else is read, for the keys that they bring.
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/backend.hpp"
#include "host/backend/own_modules.hpp"
#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// What a node names, if it is there.  What is no text is refused later, where all is.
template <class Choice, class Find>
void read_named(Node const* node, ModuleKind kind, std::span<std::string_view const> known, Find find, std::string_view what, Scene& scene, Choice& to) {
    if (node == nullptr || node->type != Node::Type::text || (kind == ModuleKind::law && node->text == rigid_contact.name)) return;
    try {
        if (auto const found = find(node->text, scene.modules)) {
            to = *found;
            return;
        }
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
void open_for_keys(Node const& root, std::string_view table, ModuleKind kind, Scene const& scene) {
    Node const* const given = root.find(table);
    if (given == nullptr || !given->is_table()) return;
    auto const is_known = [](Node const& node) {
        return find_key(node.name) != nullptr || std::ranges::find(settings(), node.name, &Setting::name) != settings().end();
    };
    if (std::ranges::all_of(given->children, is_known)) return;
    open_modules(kind, scene.modules, [](std::string const&) {});  // of one that is refused the key stays unknown
}

}  // namespace

void read_modules(Node const& root, Scene& scene) {
    if (Node const* const search = root.find_path("modules.search")) {
        if (search->type != Node::Type::array) refuse(*search, {"it must be a list of folders", "write for example [\".\"]"});
        for (Node const& folder : search->children) {
            if (folder.type != Node::Type::text || folder.text.empty()) refuse(folder, {"not a folder", "write for example [\".\"]"});
            auto const path = std::filesystem::absolute(std::filesystem::path(scene.path).parent_path() / folder.text);
            scene.modules.push_back(path.lexically_normal().string());
        }
    }
    read_named(root.find_path("mechanism.kind"), ModuleKind::mechanism, mechanism_names(), find_mechanism, "mechanism", scene, scene.parts.mechanism);
    read_named(root.find_path("contact.law"), ModuleKind::law, contact_law_names(), find_law, "contact law", scene, scene.parts.law);
    open_for_keys(root, "contact", ModuleKind::law, scene);
    open_for_keys(root, "mechanism", ModuleKind::mechanism, scene);
}

}  // namespace slideway
