#include "host/config/keys.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "kernels/mechanisms/list.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/outputs.hpp"
#include "host/config/settings.hpp"
#include "host/config/units.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

constexpr Key double_keys[] = {
    {"joint.clearance", &Inputs::clearance_y, "m", Rule::gap, KeyGroup::slider, "clearance per side", 1e-4,
     &Inputs::clearance_z},
    {"contact.young_modulus", &Inputs::slider_young_modulus, "Pa", Rule::positive, KeyGroup::elastic,
     "modulus of both bodies", 2.07e11, &Inputs::way_young_modulus},
};

/// What counts for masses and inertias alone.
constexpr double Inputs::*sources_of_masses[] = {&Inputs::density, &Inputs::crank_section, &Inputs::rod_section, &Inputs::wall,
                                                 &Inputs::slider_depth};

/// Sections that no size of a scene says, where it does not give them (Qian et al. 2020, Table 6).
constexpr struct {
    std::string_view name, size;
} paper_sections[] = {{"mechanism.crank_section", "5 x 2.5 mm"}, {"mechanism.rod_section", "14.2 x 7.1 mm"}};

/// "density" of "material.density"
constexpr std::string_view last_part_of(std::string_view name) { return name.substr(name.find('.') + 1); }

/// Whether words contain a name as a whole.
bool have_name(std::string_view words, std::string_view name) {
    auto const is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (auto at = words.find(name); at != words.npos; at = words.find(name, at + 1)) {
        auto const end = at + name.size();
        if ((at == 0 || !is_of_name(words[at - 1])) && (end == words.size() || !is_of_name(words[end]))) return true;
    }
    return false;
}

/// Of `Rule`: what numbers it allows, and what is said of the others.
constexpr struct {
    Range range;
    char const *reason, *advice;  // {} in a reason stands for what the key means
} rules[] = {
    {{}, "", ""},
    {{.low = 0, .low_included = false}, "the {} must be positive", "use a value > 0"},
    {{.low = 0}, "the {} must be zero or positive", "use a value >= 0"},
    {{.low = -1e-4}, "a preload of more than 0.1 mm is not elastic", "use a value >= -0.1 mm"},
    {{0, 1}, "the {} must be in [0, 1]", "use a value from 0 to 1"},
    {{-1, 0.5, false}, "no isotropic solid has it", "use a value > -1 and <= 0.5"},
    {{1, 3}, "the {} must be in [1, 3]", "use a value from 1 to 3"},
    {{-std::numbers::pi / 2, std::numbers::pi / 2}, "the {} must be in [-90, 90] degrees", "use a value from -90 deg to 90 deg"},
};

static_assert(std::size(double_keys) == twin_count);

std::vector<Key const*> make_every_key() {
    std::vector<Key const*> keys;
    auto const add = [&](std::span<Key const> more) {
        for (Key const& key : more) {
            // Of several that have it, it is the same key (objection_to), but for the default of a former version.
            auto const at = std::ranges::find(keys, key.name, &Key::name);
            if (at == keys.end()) keys.push_back(&key);
            else *at = &key;
        }
    };
    for (Key const& key : input_keys) {
        if (key.member == &Inputs::slider_length) {  // behind the last of mechanisms
            for (MechanismInfo const& mechanism : mechanisms()) add(mechanism.own_keys);
        }
        keys.push_back(&key);
        if (key.member != &Inputs::restitution) continue;  // the last of contacts
        for (LawInfo const& law : laws()) add(law.keys);
    }
    for (Key const& key : double_keys) keys.push_back(&key);
    return keys;
}

/// Whether the law or mechanism of this name that is known has a key.
bool has_key(ModuleKind kind, std::string_view name, std::string_view key) {
    auto const in = [&](std::span<Key const> own) { return std::ranges::find(own, key, &Key::name) != own.end(); };
    if (kind == ModuleKind::law) return std::ranges::any_of(laws(), [&](LawInfo const& law) { return law.name == name && in(law.keys); });
    return std::ranges::any_of(mechanisms(), [&](MechanismInfo const& one) { return one.name == name && in(one.own_keys); });
}

}  // namespace

std::span<Key const* const> every_key() {
    static OfAllKnown<std::vector<Key const*>> all(&make_every_key);
    return all();
}

std::string objection_to(ModuleKind kind, KernelModule const& module) {
    if (kind == ModuleKind::linkage) return "";  // nobody names it
    bool const is_law = kind == ModuleKind::law;
    std::string const name = name_of(kind, module);
    auto const names = is_law ? law_names() : mechanism_names();
    auto const taken = std::ranges::find(names, name);
    bool const of_the_tree = taken != names.end() && (is_law ? module_of(static_cast<Law>(taken - names.begin())) == nullptr
                                                              : module_of(static_cast<Mechanism>(taken - names.begin())) == nullptr);
    if (!is_module_name(name)) return fmt::format("its info has the name \"{}\"; use at most 60 small letters, digits and '_', a letter first", name);
    if (!is_law && module.mechanism->info->on_cards) return "its info says on_cards, but modules have no kernels for cards; leave it out";
    if (of_the_tree || name == rigid_contact.name) return fmt::format("slideway has a {} {} of its own; give it another name", name_of(kind), name);
    std::span<double Inputs::*const> const places = is_law ? std::span(law_inputs) : std::span(mechanism_inputs);
    auto const own = is_law ? module.law->info->keys : module.mechanism->info->own_keys;
    std::string_view const table = is_law ? "contact." : "mechanism.";
    for (Key const& key : own) {
        if (!key.name.starts_with(table) || !is_module_name(last_part_of(key.name)))
            return fmt::format("its key \"{}\" is no \"{}\" with a name of small letters, digits and '_'", key.name, table);
        if (key.group != (is_law ? KeyGroup::law : KeyGroup::mechanism) || std::ranges::find(places, key.member) == places.end() || key.twin != nullptr)
            return fmt::format("its key {} is of another group, or on another input, than those of a {} of one's own", key.name, name_of(kind));
        if (std::ranges::count(own, key.name, &Key::name) > 1 || std::ranges::count(own, key.member, &Key::member) > 1)
            return fmt::format("its key {} stands twice, or another one is on the same input", key.name);
        if (std::ranges::find(settings(), key.name, &Setting::name) != settings().end()) return fmt::format("scenes have a key {} already; give it another name", key.name);
        if (std::isnan(key.preset) && (key.derivation.empty() || !is_law)) return fmt::format("its key {} has no default; give it a number", key.name);
        if (auto const problem = broken_rule(key, key.preset); problem && !std::isnan(key.preset))
            return fmt::format("its key {} has the default {}, which its rule refuses ({})", key.name, key.preset, problem->reason);
        if (!is_plain_si(key.unit)) return fmt::format("its key {} has the unit \"{}\", which is none of SI without a prefix", key.name, key.unit);
        Key const* const known = find_key(key.name);
        if (known == nullptr) continue;
        bool const same = known->member == key.member && known->unit == key.unit && known->rule == key.rule && known->group == key.group;
        // Of one name the newest counts.
        bool const of_others = known->preset != key.preset && !(std::isnan(known->preset) && std::isnan(key.preset)) && !has_key(kind, name, key.name);
        if (!same || of_others)
            return fmt::format("a key {} is known already with another unit, rule, default or input; give it another name (or, where it is an earlier version's, start anew)", key.name);
    }
    return is_law ? std::string() : objection_to_signals(*module.mechanism->info);
}

std::vector<std::string_view> numeric_key_names() {
    std::vector<std::string_view> names;
    for (Key const& key : numeric_keys()) names.push_back(key.name);
    return names;
}

bool counts_for(Key const& key, Mechanism mechanism) {
    MechanismInfo const& of = info(mechanism);
    if (key.group == KeyGroup::load) return true;
    if (is_linkage(mechanism)) return counts_for_linkages(key, of.drive == DriveKind::crank);
    if (key.group == KeyGroup::mechanism) return std::ranges::find(of.own_keys, key.name, &Key::name) != of.own_keys.end();
    bool const of_contacts = key.group == KeyGroup::law || has_group(contact_groups, key.group);
    return has_group(of.keys, key.group) || (of.spatial && of_contacts);
}

namespace {
bool is_of_drive(Key const& key, DrivePlan const& drive) {
    if (key.member == &Inputs::drive_scale) return drive.by == DriveBy::profile;
    bool const of_motor = key.member == &Inputs::drive_torque || key.member == &Inputs::drive_no_load_speed;
    return of_motor ? drive.by == DriveBy::torque : drive.turns_freely();
}
bool sets_motion(Key const& key) {
    return key.member == &Inputs::crank_speed || key.member == &Inputs::carriage_speed || key.member == &Inputs::stroke || key.member == &Inputs::reversal_time;
}
}  // namespace

bool is_replaced_by_drive(Key const& key, Parts const& parts) {
    if (key.group == KeyGroup::drive) return !is_of_drive(key, parts.drive);
    return parts.drive.by == DriveBy::profile && sets_motion(key);
}

bool counts_for(Key const& key, Parts const& parts) {
    if (!counts_for(key, parts.mechanism)) return false;
    if (is_replaced_by_drive(key, parts)) return false;
    // Rigid contacts stick and slip exactly (docs/explanation/model.md 13).
    if (parts.rigid && key.group == KeyGroup::smooth_friction) return false;
    // What gives way under a face.
    if (parts.rigid && (key.member == &Inputs::thickness_y || key.member == &Inputs::thickness_z)) return false;
    if (!info(parts.mechanism).spatial && !parts.rigid) return true;
    LawInfo const& law = contact_info(parts);
    if (key.group == KeyGroup::law) return std::ranges::find(law.keys, key.name, &Key::name) != law.keys.end();
    return !has_group(contact_groups, key.group) || has_group(law.groups, key.group);
}

Key const* find_key(std::string_view dotted_name) {
    auto const all = numeric_keys();
    auto const found = std::ranges::find(all, dotted_name, &Key::name);
    return found == all.end() ? nullptr : &*found;
}

std::string derivation_of(Key const& key, Parts const& parts, Inputs const& inputs) {
    DerivedInput const* const rule = derivation_of(key.member, solid_of(info(parts.mechanism), inputs));
    std::string words(rule != nullptr ? rule->words : key.derivation);
    for (auto const& [name, size] : paper_sections) {
        Key const& section = *find_key(name);
        if (have_name(words, last_part_of(name)) && section.get(inputs) == section.preset) words += fmt::format(" ({}, the paper's)", size);
    }
    return words;
}

std::string derivations_of(Key const& key) {
    std::string text(key.derivation);
    for (DerivedInput const& rule : derived_inputs) {
        if (rule.member == key.member) text += fmt::format("{}{}", text.empty() ? "" : ", or ", rule.words);
    }
    return text;
}

bool is_idle_source(Key const& key, Parts const& parts, Inputs const& inputs) {
    if (std::ranges::find(sources_of_masses, key.member) == std::end(sources_of_masses)) return false;
    return std::ranges::none_of(derived_inputs, [&](DerivedInput const& rule) {
        auto const derived = std::ranges::find(input_keys, rule.member, &Key::member);
        return have_name(rule.words, last_part_of(key.name)) && counts_for(*derived, parts) && std::isnan(derived->get(inputs));
    });
}

bool lays_way(Key const& key) {
    static constexpr double Inputs::*of_faces[] = {&Inputs::clearance_y_plus, &Inputs::clearance_y_minus, &Inputs::clearance_z_plus, &Inputs::clearance_z_minus};
    return key.name.starts_with("way.") || std::ranges::find(of_faces, key.member) != std::end(of_faces);
}

bool is_of_body(Key const& key) { return key.group == KeyGroup::body || key.group == KeyGroup::pin; }

void require_part(Parts& parts, Key const& key) {
    if (lays_way(key)) parts.misaligned_way = true;
    if (is_of_body(key)) parts.offset_slider = true;
    if (key.name.starts_with("friction.")) parts.friction = true;
    if (key.name.starts_with("contact.chi_") && parts.damping == Damping::point) parts.damping = Damping::rate;
    if (key.name == "contact.restitution") parts.damping = Damping::restitution;
}

Inputs with_presets(Inputs inputs, Law law) {
    for (Key const& key : info(law).keys) key.set(inputs, key.preset);
    return inputs;
}

Inputs with_presets(Inputs inputs, Parts const& parts) {
    for (Key const& key : info(parts.mechanism).own_keys) key.set(inputs, key.preset);
    return with_presets(inputs, parts.law);
}

std::string with_unit(double value, std::string_view unit) {
    return unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

Range range_of(Rule rule) { return rules[static_cast<int>(rule)].range; }

std::optional<Problem> broken_rule(Key const& key, double value) {
    if (!std::isfinite(value)) return Problem{"not a finite number", "use a finite number"};
    auto const& [range, reason, advice] = rules[static_cast<int>(key.rule)];
    if (range.contains(value)) return std::nullopt;
    return Problem{fmt::format(fmt::runtime(reason), key.meaning), advice};
}

namespace {

/// What numbers ask of one another, of a member whose own rules they meet.  {crank}, {rod} … stand for the numbers.
/// How far off the way's axis a rod has to reach in a turn [m].
double most_reach(Inputs const& in, Parts const& parts) { return in.crank_length + (parts.offset_slider ? std::hypot(in.pin_y, in.pin_z) : 0); }

/// Rigid contacts, and the corners of a block in the plane: a preload is of faces that give way.
bool needs_gap(Parts const& parts) { return parts.rigid || !info(parts.mechanism).spatial; }
constexpr std::string_view no_gap = "without a gap contacts must give way, as the laws of mechanisms in space do", give_gap = "use a clearance > 0 in the mean of both faces, or in space such a law";

constexpr struct {
    std::string_view key, other;
    bool (*when)(Inputs const&, Parts const&);
    std::string_view why, instead;
} number_rules[] = {
    {"contact.restitution", "contact.law",
     [](Inputs const& in, Parts const& parts) { return parts.damping == Damping::restitution && !parts.rigid && in.restitution == 0; },
     "what gives way gives a part of the speed back; 0 is for rigid contacts", "use a value > 0, or contact.law = rigid"},
    {"joint.clearance_y", "contact.law", [](Inputs const& in, Parts const& parts) { return needs_gap(parts) && !(mean_clearance_y(in) > 0); }, no_gap, give_gap},
    {"joint.clearance_z", "contact.law", [](Inputs const& in, Parts const& parts) { return needs_gap(parts) && !(mean_clearance_z(in) > 0); }, no_gap, give_gap},
    {"mechanism.rod_length", "mechanism.crank_length",
     [](Inputs const& in, Parts const& parts) { return parts.drive.by != DriveBy::speed && in.rod_length <= most_reach(in, parts); },
     "the crank of {crank} m cannot turn fully", "use a rod longer than the crank"},
    {"mechanism.rod_length", "mechanism.crank_length", [](Inputs const& in, Parts const& parts) { return in.crank_speed != 0 && in.rod_length <= most_reach(in, parts); },
     "the crank of {crank} m cannot turn fully", "use a rod longer than the crank, or crank_speed = 0"},
    {"drive.inertia", "drive.kind", [](Inputs const& in, Parts const& parts) { return parts.mechanism == Mechanism::scotch_yoke_motor && in.drive_inertia == 0; },
     "nothing else turns at a dead centre", "use a value > 0"},
    // The planar mechanism starts with the rod's angle, which follows from y.
    {"initial.y", "mechanism.start_angle",
     [](Inputs const& in, Parts const& parts) {
         return !info(parts.mechanism).spatial && counts_for(*find_key("mechanism.rod_length"), parts.mechanism) &&
                !(std::abs(in.y - in.crank_length * std::sin(in.start_angle)) < in.rod_length);
     },
     "the rod of {rod} m does not reach it from a crank at {angle} rad", "use a value near 0"},
    {"friction.slip_speed", "friction.stick_speed", [](Inputs const& in, Parts const&) { return in.friction_slip_speed <= in.friction_stick_speed; },
     "not above friction.stick_speed, {stick} m/s", "use a slip_speed > stick_speed"},
};

/// The key of a number of a load, kept: a defect names it.  One that is broken is rare.
Key const& key_of(Load const& load, LoadNumber const& number, int place) {
    static std::mutex mutex;
    static std::map<std::string, Key> keys;
    std::lock_guard const lock(mutex);
    auto const at = keys.try_emplace(fmt::format("{}.{}", load.name, number.name)).first;
    at->second = number.key(at->first, place);
    return at->second;
}

/// Slope that the profiles up to one give the steepest of its faces, at most.
double steepest_of_faces(Inputs const& in, LoadList const& loads, int last) {
    double steepest = 0;
    for (int face = 0; face < 4; ++face) {
        double sum = 0;
        for (int i = 0; i <= last && (loads.loads[last].faces >> face & 1) != 0; ++i) {
            Load const& load = loads.loads[i];
            if (load.kind != LoadKind::way_profile || (load.faces >> face & 1) == 0) continue;
            sum += load.steepest * (load.scale == Load::none ? 1 : in.*load_inputs[load.scale]);
        }
        if (!(sum <= steepest)) steepest = sum;
    }
    return steepest;
}

/// Numbers of loads are of the scene, and in no table of keys.
std::optional<Defect> defect_of_loads(Inputs const& in, LoadList const& loads) {
    for (int i = 0; i < loads.count; ++i) {
        Load load = loads.loads[i];
        for (LoadNumber const& number : load_numbers()) {
            int const place = number.kind == load.kind ? number.place(load) : Load::none;
            if (place == Load::none) continue;
            double const value = in.*load_inputs[place];
            if (auto problem = broken_rule(number.key({}, place), value)) return Defect{&key_of(load, number, place), nullptr, value, *std::move(problem)};
        }
        if (load.kind == LoadKind::way_profile) {
            double const scale = load.scale == Load::none ? 1 : in.*load_inputs[load.scale], steepest = steepest_of_faces(in, loads, i);
            if (!(steepest <= most_profile_slope))
                return Defect{&key_of(load, *find_load_number(LoadKind::way_profile, "scale"), load.scale), nullptr, scale,
                              {fmt::format("its faces then have a slope of {:.3g}", steepest),
                               fmt::format("contacts are reckoned with slopes up to {}; smooth the table, or check its units", most_profile_slope)}};
        }
        if (load.kind != LoadKind::way_ends || load.from == Load::none || load.to == Load::none || in.*load_inputs[load.from] < in.*load_inputs[load.to]) continue;
        Key const& end = key_of(load, *find_load_number(LoadKind::way_ends, "to"), load.to);
        return Defect{&end, nullptr, end.get(in), {"the way ends where it begins, or before", "use a larger x than that of from"}};
    }
    return std::nullopt;
}

}  // namespace

std::optional<Defect> find_defect(Inputs const& inputs, Parts const& parts) {
    Inputs const in = complete_inputs(inputs, info(parts.mechanism));
    for (Key const& key : keys()) {
        if (!counts_for(key, parts)) continue;
        // A number of a law or mechanism that it takes from others.
        bool const own = key.group == KeyGroup::law || key.group == KeyGroup::mechanism;
        bool const open = own || lays_way(key);
        if (open && std::isnan(key.preset) && std::isnan(key.get(in))) continue;
        auto problem = broken_rule(key, key.get(in));
        if (!problem) continue;
        if (std::isnan(key.get(inputs))) problem->reason += fmt::format(", and follows from {}", derivation_of(key, parts, in));
        return Defect{&key, nullptr, key.get(in), *problem};
    }
    for (auto const& rule : number_rules) {
        Key const& key = *find_key(rule.key);
        if (!rule.when(in, parts) || !counts_for(key, parts.mechanism)) continue;
        std::string why = fmt::format(fmt::runtime(rule.why), fmt::arg("crank", in.crank_length), fmt::arg("rod", in.rod_length),
                                      fmt::arg("angle", in.start_angle), fmt::arg("stick", in.friction_stick_speed));
        return Defect{&key, find_key(rule.other), key.get(in), {std::move(why), std::string(rule.instead)}};
    }
    if (Linkage const* const linkage = linkage_of(parts.mechanism)) {
        if (auto found = defect_of_linkage(in, *linkage)) return found;
    }
    return defect_of_loads(in, parts.loads);
}

std::optional<std::string> defect(Inputs const& inputs, Parts const& parts) {
    auto const found = find_defect(inputs, parts);
    if (!found) return std::nullopt;
    return fmt::format("{} is {} ({}); {}", found->key->name, with_unit(found->value, found->key->unit), found->problem.reason, found->problem.advice);
}

}  // namespace slideway
