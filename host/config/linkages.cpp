#include "host/config/linkages.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "host/backend/linkage_numbers.hpp"
#include "host/base/error.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/keys.hpp"
#include "host/config/scene.hpp"
#include "host/config/settings.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

using enum Rule;
constexpr unsigned kind_bit(LinkKind kind) { return 1u << static_cast<int>(kind); }
constexpr unsigned of_slides = kind_bit(LinkKind::prismatic), of_journals = kind_bit(LinkKind::journal), of_blocks = kind_bit(LinkKind::block),
                   of_contacts = of_journals | of_blocks, of_all = kind_bit(LinkKind::revolute) | of_slides | of_contacts;

constexpr PartNumber rows_of_parts[] = {
    {body_table, "mass", "kg", "mass of the body", positive},
    {body_table, "inertia", "kg m2", "inertia of the body about its mass centre", not_negative},
    {body_table, "center_x", "m", "mass centre along the body's own X"},
    {body_table, "center_y", "m", "the same along Y"},
    {body_table, "angle", "rad", "angle against the ground near which it starts; joints decide"},
    {body_table, "speed", "rad/s", "angular velocity near which it starts"},

    {link_table, "first_x", "m", "the joint on its first body, along that one's X", any, of_all},
    {link_table, "first_y", "m", "the same along Y", any, of_all},
    {link_table, "second_x", "m", "the joint on its second body, along that one's X", any, of_all},
    {link_table, "second_y", "m", "the same along Y", any, of_all},
    {link_table, "direction", "rad", "angle of a prismatic joint's line against the first body's X, or of walls against the second body's", any, of_slides | of_blocks},
    {link_table, "turn", "rad", "angle of the second body of a prismatic joint against the first", any, of_slides},
    {link_table, "position", "m", "displacement near which a prismatic joint starts", any, of_slides},
    {link_table, "speed", "m/s", "speed near which a prismatic joint starts", any, of_slides},
    {link_table, "clearance", "m", "bearing's radius less journal's, or a block's clearance on each side", positive, of_contacts},
    {link_table, "radius", "m", "radius of a journal's bearing", positive, of_journals},
    {link_table, "length", "m", "length of a block along its walls", positive, of_blocks},
    {link_table, "height", "m", "height of a block between its walls", positive, of_blocks},
    {link_table, "stiffness", "1", "stiffness K of the contact [N/m^n, n the Hertz exponent]; of a journal else that of spheres", positive, of_contacts},
    {link_table, "offset_x", "m", "where a journal starts in its bearing, along the ground's X", any, of_journals},
    {link_table, "offset_y", "m", "the same along Y, or where a block starts across its walls", any, of_contacts},
    {link_table, "tilt", "rad", "tilt of a block at the start", any, of_blocks},
};

/// How far out a journal or a corner may start, in clearances.
constexpr double deepest_start = 1.05;

/// Those that are known: as many as a process may meet.
struct Registry {
    static constexpr std::size_t most = 4096;
    std::mutex access;
    std::size_t count = 0;
    std::deque<std::unique_ptr<Linkage>> all;
    std::array<std::atomic<Linkage const*>, most> at{};
};
Registry& registry() {
    static auto* const all = new Registry;  // for as long as any thread lives
    return *all;
}

MechanismInfo const& placeholder() {
    static MechanismInfo const info = [] {
        MechanismInfo of{};
        of.name = linkage_kind.data();
        of.meaning = "bodies and joints that the scene describes";
        of.drive = DriveKind::crank;
        of.spatial = false;
        of.may_turn_freely = true;
        return of;
    }();
    return info;
}

}  // namespace

std::span<PartNumber const> part_numbers() { return rows_of_parts; }

std::vector<Setting> linkage_settings() {
    using Type = Setting::Type;
    static std::deque<std::string> const names = [] {
        std::deque<std::string> all;
        for (PartNumber const& number : rows_of_parts) all.push_back(fmt::format("{}.<name>.{}", number.table, number.name));
        return all;
    }();
    std::vector<Setting> rows;
    auto const add = [&](std::string_view table) {
        for (std::size_t i = 0; i < std::size(rows_of_parts); ++i) {
            PartNumber const& number = rows_of_parts[i];
            bool const is_asked = number.rule == positive && number.name != "stiffness";
            if (number.table == table)
                rows.push_back({.name = names[i], .type = Type::number, .unit = number.unit, .meaning = number.meaning,
                                .preset = is_asked || number.name == "stiffness" ? "-" : "0", .range = range_of(number.rule)});
        }
    };
    add(body_table);
    rows.push_back({.name = "link.<name>.kind", .type = Type::choice, .unit = "",
                    .meaning = "pin or slide without clearance, pin or slide with it", .preset = "-", .choices = link_kinds});
    rows.push_back({.name = "link.<name>.first", .type = Type::text, .unit = "",
                    .meaning = "a body, or ground: that of a prismatic joint's line, of journal or block", .preset = "-"});
    rows.push_back({.name = "link.<name>.second", .type = Type::text, .unit = "", .meaning = "the other one: of what slides, of bearing or walls", .preset = "-"});
    add(link_table);
    return rows;
}

Key const* Linkage::find_key(std::string_view name) const {
    auto const found = std::ranges::find(keys, name, &Key::name);
    return found == keys.end() ? nullptr : &*found;
}

std::string Linkage::identity() const {
    std::string text = driven;
    for (SeriesInfo const& one : series) text += fmt::format("\n{} {}", one.name, one.unit);
    for (Row const& row : rows) {
        text += fmt::format("\n{}\n{}", row.name, row.words);
        for (std::size_t const i : row.keys) text += fmt::format("{}\n", keys[i].name);
    }
    return text;
}

Linkage const* linkage_of(Mechanism mechanism) {
    if (!is_linkage(mechanism) || mechanism == any_linkage) return nullptr;
    return registry().at[static_cast<std::size_t>(mechanism) - static_cast<std::size_t>(any_linkage) - 1].load(std::memory_order_acquire);
}

Mechanism known_linkage(std::unique_ptr<Linkage> linkage) {
    Registry& known = registry();
    std::lock_guard const lock(known.access);
    std::string const identity = linkage->identity();
    auto const number = [](std::size_t place) { return static_cast<Mechanism>(static_cast<std::size_t>(any_linkage) + 1 + place); };
    for (std::size_t i = 0; i < known.count; ++i) {
        if (known.all[i]->identity() == identity) return number(i);
    }
    if (known.count == Registry::most) throw SceneError("this process has read thousands of different linkages; start a new one");
    Linkage const* const made = known.all.emplace_back(std::move(linkage)).get();
    known.at[known.count].store(made, std::memory_order_release);
    return number(known.count++);
}

MechanismInfo const& linkage_info(Mechanism mechanism) {
    Linkage const* const known = linkage_of(mechanism);
    return known != nullptr ? known->info : placeholder();
}

bool counts_for_linkages(Key const& key, bool driven) {
    static constexpr double Inputs::*always[] = {&Inputs::gravity, &Inputs::inclination, &Inputs::slider_young_modulus, &Inputs::way_young_modulus,
                                                 &Inputs::slider_poisson_ratio, &Inputs::way_poisson_ratio, &Inputs::hertz_exponent, &Inputs::eta,
                                                 &Inputs::restitution, &Inputs::friction_static, &Inputs::friction_kinetic, &Inputs::friction_stick_speed,
                                                 &Inputs::friction_slip_speed};
    static constexpr double Inputs::*of_drives[] = {&Inputs::crank_speed, &Inputs::start_angle, &Inputs::drive_torque, &Inputs::drive_no_load_speed,
                                                    &Inputs::drive_viscous, &Inputs::drive_inertia, &Inputs::drive_scale};
    auto const in = [&](std::span<double Inputs::*const> members) { return std::ranges::find(members, key.member) != members.end(); };
    return key.twin == nullptr && (in(always) || (driven && in(of_drives)));
}

namespace {

Key const* key_at(Linkage const& linkage, int place) {
    return place < 0 ? nullptr : &*std::ranges::find(linkage.keys, linkage_inputs[place], &Key::member);
}

/// Where a block starts between its walls: corners as deep in them as starts of sliders may be.
std::optional<Defect> defect_of_block(Inputs const& in, LinkageClosure const& of, Linkage const& linkage) {
    auto const value = [&](int place) { return place < 0 ? 0 : in.*linkage_inputs[place]; };
    double const y = value(of.offset[0]), tilt = value(of.offset[1]), clearance = value(of.clearance), length = value(of.length), height = value(of.height);
    double const corner = std::abs(y) + (length * std::abs(std::sin(tilt)) + height * std::cos(tilt)) / 2;
    if (corner <= height / 2 + deepest_start * clearance) return {};
    Key const* const blamed = key_at(linkage, of.offset[tilt != 0 ? 1 : 0]);
    return Defect{blamed, nullptr, blamed->get(in), {fmt::format("a corner of the block starts {:.3g} m inside its walls", corner - height / 2 - clearance),
                                                     "use offset_y and tilt within the clearance"}};
}

}  // namespace

std::optional<Defect> defect_of_linkage(Inputs const& in, Linkage const& linkage) {
    auto const& plan = linkage.plan;
    for (Key const& key : linkage.keys) {
        if (auto problem = broken_rule(key, key.get(in))) return Defect{&key, nullptr, key.get(in), *std::move(problem)};
    }
    for (int k = 0; k < plan.closures; ++k) {
        LinkageClosure const& of = plan.closure[k];
        if (of.kind == ClosureKind::block) {
            if (auto found = defect_of_block(in, of, linkage)) return found;
        }
        if (of.kind != ClosureKind::journal) continue;
        Key const &clearance = *key_at(linkage, of.clearance), &radius = *key_at(linkage, of.radius);
        double const x = of.offset[0] < 0 ? 0 : in.*linkage_inputs[of.offset[0]], y = of.offset[1] < 0 ? 0 : in.*linkage_inputs[of.offset[1]];
        if (!(clearance.get(in) < radius.get(in)))
            return Defect{&clearance, &radius, clearance.get(in), {"no journal is left in the bearing", "use a value below that of radius"}};
        if (std::hypot(x, y) > deepest_start * clearance.get(in))
            return Defect{key_at(linkage, of.offset[0] >= 0 ? of.offset[0] : of.offset[1]), nullptr, x, {fmt::format("the journal starts {:.3g} m inside its bearing", std::hypot(x, y) - clearance.get(in)), "use offset_x and offset_y within the clearance"}};
    }
    using enum AssemblyFault;
    LinkageAssembly const start = assembled(plan, in);
    if (start.fault == none) return std::nullopt;
    // Any key of the joint that is worst says where it is.
    std::string const& joint = linkage.closures[static_cast<std::size_t>(start.worst)];
    auto const row = std::ranges::find(linkage.rows, joint, &Linkage::Row::name);
    Key const* const key = row == linkage.rows.end() || row->keys.empty() ? &linkage.keys.front() : &linkage.keys[row->keys.front()];
    if (is_given(in))
        return Defect{key, nullptr, key->get(in), {fmt::format("in this state {} is open by {:.3g} m and opens at {:.3g} m/s, though it has no clearance", joint, start.distance, start.rate),
                                                   "give places and rates with which the loops close, all their digits"}};
    if (start.fault == redundant)
        return Defect{key, nullptr, key->get(in), {fmt::format("{} holds what other joints hold already, or the linkage starts at a dead centre", joint),
                                                   "remove a joint, or start at another angle"}};
    bool const plays = plan.closure[start.worst].has_clearance();
    return Defect{key, nullptr, key->get(in), {fmt::format("{} stays open by {:.3g} m{}: lengths do not reach, or angles are far off", joint, start.distance, plays ? " beyond its clearance" : ""),
                                               "check the points of the joints, or give the bodies an angle near where they start"}};
}

void refuse_open(Scene const& scene, std::string const& line) {
    Linkage const* const linkage = linkage_of(scene.parts.mechanism);
    if (linkage == nullptr) return;
    LinkageAssembly const start = assembled(linkage->plan, complete_inputs(scene.inputs, linkage->info));
    if (start.fault == AssemblyFault::none) return;
    throw OpenLinkage{line, std::make_shared<Scene const>(scene), start.state, linkage->closures[static_cast<std::size_t>(start.worst)]};
}

}  // namespace slideway
