// Compiled under a name of its own (CMakeLists.txt here): it shares no code with the kernels.
#include "host/config/descriptors.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "host/backend/linkage_numbers.hpp"
#include "host/config/linkages.hpp"
#include "kernels/all_laws.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

constexpr LawInfo law_infos[] = {
#define SLIDEWAY_INFO(name, Type) Type::info,
    SLIDEWAY_LAWS(SLIDEWAY_INFO)
#undef SLIDEWAY_INFO
};

constexpr MechanismInfo mechanism_infos[] = {
#define SLIDEWAY_INFO(name, Type, Base) Type::info,
    SLIDEWAY_MECHANISMS(SLIDEWAY_INFO)
#undef SLIDEWAY_INFO
};

// Names stand twice, in the lists and in the headers.
#define SLIDEWAY_CHECK(row, Type)                                                                  \
    static_assert(Type::info.name == #row, "the info of law " #row " bears another name"); \
    static_assert(Type::info.keys.size() <= most_own_numbers, "law " #row " has more than sixteen numbers of its own");
SLIDEWAY_LAWS(SLIDEWAY_CHECK)
#undef SLIDEWAY_CHECK
#define SLIDEWAY_CHECK(row, Type, Base)                                                                             \
    static_assert(std::string_view(Type::info.name) == #row, "the info of mechanism " #row " bears another name"); \
    static_assert(Type::info.states == Type::size && Type::size <= most_states,                                     \
                  "the state of mechanism " #row " has another size");                                                \
    static_assert(Type::info.signals.empty(), "mechanism " #row " has signals, and the lanes of its base are of those that have none");              \
    static_assert(has_start_inputs(Type::info),                                                                     \
                  "a component of the state of mechanism " #row " starts from no input: it lacks a row in start_inputs (kernels/members/start.hpp)");
SLIDEWAY_MECHANISMS(SLIDEWAY_CHECK)
#undef SLIDEWAY_CHECK

/// Those of the tree, and behind them those of modules.
template <class Info, std::size_t tree> std::vector<Info> with_modules(Info const (&infos)[tree], ModuleKind kind, Info const& (*info_of)(KernelModule const&)) {
    std::vector<Info> all(std::begin(infos), std::end(infos));
    for (std::size_t i = 0; i < own_module_count(kind); ++i) all.push_back(info_of(*own_module(kind, i).described));
    return all;
}

MechanismInfo const& mechanism_info(KernelModule const& module) { return *module.mechanism->info; }
LawInfo const& law_info(KernelModule const& module) { return *module.law->info; }

template <class Infos> std::vector<std::string_view> names_of(Infos const& infos) {
    std::vector<std::string_view> names;
    for (auto const& info : infos) names.emplace_back(info.name);
    return names;
}

/// The place of a name among those of the tree, or behind them that of its module.
template <class Choice, class Info, std::size_t tree>
std::optional<Choice> find(Info const (&infos)[tree], ModuleKind kind, std::string_view name, std::span<std::string const> search) {
    auto const found = std::ranges::find_if(infos, [&](Info const& info) { return info.name == name; });
    if (found != std::end(infos)) return static_cast<Choice>(found - std::begin(infos));
    auto const place = find_own_module(kind, name, search, &objection_to);
    return place ? std::optional(static_cast<Choice>(tree + *place)) : std::nullopt;
}

template <class Info, std::size_t tree> OwnModule const* module_behind(Info const (&)[tree], ModuleKind kind, int place) {
    return place < static_cast<int>(tree) ? nullptr : &own_module(kind, static_cast<std::size_t>(place) - tree);
}

}  // namespace

std::size_t known_count() { return own_module_count(ModuleKind::law) + own_module_count(ModuleKind::mechanism); }

std::span<MechanismInfo const> mechanisms() {
    static OfAllKnown<std::vector<MechanismInfo>> all([] { return with_modules(mechanism_infos, ModuleKind::mechanism, &mechanism_info); });
    return all();
}
std::span<LawInfo const> contact_laws() {
    static OfAllKnown<std::vector<LawInfo>> all([] {
        auto known = with_modules(law_infos, ModuleKind::law, &law_info);
        known.push_back(rigid_contact);
        return known;
    });
    return all();
}
std::span<LawInfo const> laws() { return contact_laws().first(contact_laws().size() - 1); }

std::span<std::string_view const> mechanism_names() {
    static OfAllKnown<std::vector<std::string_view>> names([] { return names_of(mechanisms()); });
    return names();
}
std::span<std::string_view const> mechanism_kinds() {
    static OfAllKnown<std::vector<std::string_view>> names([] {
        std::vector<std::string_view> kinds;
        for (MechanismInfo const& one : mechanisms()) {
            if (one.driven_form == nullptr) kinds.emplace_back(one.name);
        }
        kinds.push_back(linkage_kind);
        return kinds;
    });
    return names();
}
std::span<std::string_view const> contact_law_names() {
    static OfAllKnown<std::vector<std::string_view>> names([] { return names_of(contact_laws()); });
    return names();
}
std::span<std::string_view const> law_names() { return contact_law_names().first(contact_law_names().size() - 1); }

std::optional<Law> find_law(std::string_view name, std::span<std::string const> search) { return find<Law>(law_infos, ModuleKind::law, name, search); }
std::optional<Mechanism> find_mechanism(std::string_view name, std::span<std::string const> search) {
    if (name == linkage_kind) return any_linkage;
    // Of forms whose crank turns freely a scene names the driven one, and its drive.
    if (std::ranges::any_of(mechanism_infos, [&](MechanismInfo const& info) { return info.name == name && info.driven_form != nullptr; })) return std::nullopt;
    return find<Mechanism>(mechanism_infos, ModuleKind::mechanism, name, search);
}
OwnModule const* module_of(Law law) { return module_behind(law_infos, ModuleKind::law, static_cast<int>(law)); }
OwnModule const* module_of(Mechanism mechanism) { return is_linkage(mechanism) ? nullptr : module_behind(mechanism_infos, ModuleKind::mechanism, static_cast<int>(mechanism)); }
OwnModule const* contact_module(Parts const& parts) { return parts.rigid ? nullptr : module_of(parts.law); }

void open_modules(ModuleKind kind, std::span<std::string const> search, std::function<void(std::string const& why)> const& refused) {
    for (std::string const& name : own_module_names(kind, search)) {
        try {
            if (kind == ModuleKind::law) {
                find_law(name, search);
            } else {
                find_mechanism(name, search);
            }
        } catch (DeviceError const& error) {
            refused(error.what());
        }
    }
}

std::string modules_text(Parts const& parts) {
    std::string text;
    auto const add = [&](char const* kind, OwnModule const* own) {
        if (own != nullptr) text += std::string(text.empty() ? "" : "; ") + kind + own->name + ": source " + own->source + ", " + own->described->compiler;
    };
    add("law ", contact_module(parts));
    add("mechanism ", module_of(parts.mechanism));
    return text;
}

MechanismInfo const& info(Mechanism mechanism) { return is_linkage(mechanism) ? linkage_info(mechanism) : mechanisms()[static_cast<std::size_t>(mechanism)]; }
MemberSize size_of(Mechanism mechanism, Inputs const& in) {
    if (Linkage const* const linkage = linkage_of(mechanism)) {
        LinkageSize const size = size_of(linkage->plan, in);
        return {size.least_play, size.most_play, size.reach, size.reach, size.mass};
    }
    double const y = play_y(in);
    if (!info(mechanism).spatial) return {y, y, in.slider_length, std::max(in.slider_length, in.rod_length), in.slider_mass};
    return {std::min(y, play_z(in)), std::max(y, play_z(in)), in.slider_length, 0.5 * in.slider_length, in.slider_mass};
}
StateNumbers start_of(Mechanism mechanism, Inputs const& in) {
    Linkage const* const linkage = linkage_of(mechanism);
    return linkage != nullptr ? start_of(linkage->plan, in) : start_of(info(mechanism), in);
}
LawInfo const& info(Law law) { return laws()[static_cast<std::size_t>(law)]; }
LawInfo const& contact_info(Parts const& parts) { return parts.rigid ? rigid_contact : info(parts.law); }

bool may_be_rigid(Mechanism mechanism) { return static_cast<std::size_t>(mechanism) < std::size(mechanism_infos); }

std::string_view kind_of(Mechanism mechanism) {
    MechanismInfo const& of = info(mechanism);
    return of.driven_form != nullptr ? of.driven_form : of.name;
}

std::optional<Mechanism> turning_form(Mechanism mechanism) {
    if (info(mechanism).may_turn_freely) return mechanism;
    auto const found = std::ranges::find_if(mechanism_infos, [&](MechanismInfo const& one) { return one.driven_form != nullptr && kind_of(mechanism) == one.driven_form; });
    return found == std::end(mechanism_infos) ? std::nullopt : std::optional(static_cast<Mechanism>(found - std::begin(mechanism_infos)));
}

bool choose_contact(Parts& parts, std::string_view name, std::span<std::string const> search) {
    parts.rigid = name == rigid_contact.name;
    auto const found = parts.rigid ? std::optional(parts.law) : find_law(name, search);
    if (found) parts.law = *found;
    return found.has_value();
}

bool has_faces(Parts const& parts) { return info(parts.mechanism).spatial && !parts.rigid; }
bool has_switches(Parts const& parts) { return makes_energy(parts) && parts.damping != Damping::restitution; }
bool ends_at_changes(Parts const& parts) {
    return (contact_info(parts).continuous || contact_info(parts).ends_steps) && parts.damping != Damping::restitution;
}
bool needs_restitution(Parts const& parts) { return parts.rigid || (has_faces(parts) && info(parts.law).needs_restitution); }
bool makes_energy(Parts const& parts) { return info(parts.mechanism).spatial && contact_info(parts).switches; }

bool is_prescribed(Parts const& parts, int component) {
    return !parts.drive.turns_freely() && (info(parts.mechanism).prescribed >> component & 1u) != 0;
}

int free_states(Parts const& parts) {
    int count = 0;
    for (int i = 0; i < info(parts.mechanism).states; ++i) count += is_prescribed(parts, i) ? 0 : 1;
    return count;
}

std::vector<std::string> labels_of(std::string_view dimension) {
    if (dimension == "apex") return {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"};
    if (dimension == "mode_class") return {std::begin(mode_class_names), std::end(mode_class_names)};
    if (dimension == "axis") return {"roll", "yaw", "pitch"};
    if (dimension == "direction") return {"x", "y", "z"};
    if (dimension == "channel") return {"top", "front"};
    if (dimension == "face_speed") {
        std::vector<std::string> labels;
        for (char const* const face : face_names) {
            for (double const speed : impact_speed_bins) labels.push_back(fmt::format("{}_{}", face, speed));
        }
        return labels;
    }
    if (dimension == "face") return {std::begin(face_names), std::end(face_names)};
    return {};
}

}  // namespace slideway
