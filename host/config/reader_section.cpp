#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/suggest.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

constexpr int apices = 8;

void read_phase(Node const& root, Scene& scene) {
    Node const* const node = root.find_path("study.phase");
    if (node != nullptr) scene.chaos.section.level = read_number(*node, "rad");
    if (std::isfinite(drive_period(scene.parts, scene.inputs))) return;
    refuse_study(root, node, "study.phase",
                 {fmt::format("{}, so no crank angle comes round", why_no_period(scene.parts)),
                  scene.study != StudyKind::sweep ? "give study.section"
                  : scene.parts.free_crank        ? "use crank = \"driven\""
                                                  : "give the crank a speed"});
}

/// Names of what a section may be taken of: states, gaps, and at last impacts.
std::vector<std::string> surface_names(MechanismInfo const& mechanism) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(mechanism.states) + 2 * std::size_t{apices} + 1);
    for (int i = 0; i < mechanism.states; ++i) names.emplace_back(state_info(mechanism, i).name);
    for (char const* const face : {"gap_y", "gap_z"}) {
        for (int apex = 1; mechanism.spatial && apex <= apices; ++apex) names.push_back(fmt::format("{}[P{}]", face, apex));
    }
    names.emplace_back(impacts_name);
    return names;
}

/// Of compliant contacts an impact lasts, and a gap at a small level tells its beginning and its end.
void check_impacts(Node const& on, Node const* value, Parts const& parts) {
    if (!parts.rigid) {
        std::string_view const gap = info(parts.mechanism).spatial ? "on = \"gap_y[P1]\" with value = \"1 nm\", " : "";
        refuse(on, {"impacts of compliant contacts last", fmt::format("use {}the quantity contact_onsets, or contact.law = \"rigid\"", gap)});
    }
    if (value != nullptr) refuse(*value, {"an impact has no level", "remove it"});
}

void read_section_table(Node const& table, Scene& scene) {
    SectionSurface& section = scene.chaos.section;
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    constexpr std::string_view example = "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }";
    if (!table.is_table()) refuse(table, {"not a section", fmt::format("write for example {}", example)});
    check_arguments(table, "section", {"on", "value", "direction"});
    Node const* const on = table.find("on");
    if (on == nullptr) refuse_that(table, "has no on", {"what crosses the section", fmt::format("write for example {}", example)});
    std::string const& name = read_text_value(*on);
    auto const known = surface_names(mechanism);
    auto const found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
        std::vector<std::string_view> const names(known.begin(), known.end());
        std::string_view const near = nearest_name(name, names);
        auto const states = std::span(known).first(static_cast<std::size_t>(mechanism.states));
        refuse(*on,
               {mechanism.spatial ? "neither a state nor a gap" : "no state of it",
                near.empty() ? fmt::format("use one of {}{}", fmt::join(states, ", "),
                                           mechanism.spatial ? ", gap_y[P1] to gap_y[P8], gap_z[P1] to gap_z[P8]" : "")
                             : fmt::format("did you mean \"{}\"?", near)});
    }
    int const index = static_cast<int>(found - known.begin());
    using On = SectionSurface::On;
    int const states = mechanism.states;
    Node const* const value = table.find("value");
    if (name == impacts_name) {
        check_impacts(*on, value, scene.parts);
        section.on = On::impacts;
        section.direction = CrossingDirection::both;
    } else {
        section.on = index < states ? On::state : index < states + apices ? On::gap_y : On::gap_z;
        section.index = index < states ? index : (index - states) % apices;
        if (value != nullptr) section.level = read_number(*value, section_unit(section, scene.parts.mechanism));
    }
    if (Node const* const direction = table.find("direction")) {
        section.direction =
            static_cast<CrossingDirection>(read_choice(*direction, "direction", crossing_direction_names));
    }
}

}  // namespace

std::string_view section_unit(SectionSurface const& section, Mechanism mechanism) {
    switch (section.on) {
        case SectionSurface::On::phase:
            return "rad";
        case SectionSurface::On::state: {
            SeriesInfo const& state = state_info(info(mechanism), section.index);
            Key const* const key = find_key(fmt::format("initial.{}", state.name));
            return key != nullptr ? key->unit : state.unit;
        }
        case SectionSurface::On::gap_y:
        case SectionSurface::On::gap_z:
        case SectionSurface::On::impacts:
            break;
    }
    return "m";
}

void read_section(Node const& root, Scene& scene) {
    Node const* const table = root.find_path("study.section");
    Node const* const crossings = root.find_path("study.max_crossings");
    if (table == nullptr) {
        if (crossings != nullptr) {
            refuse(*crossings, {"a crank angle comes once a revolution", "remove it, or give study.section"});
        }
        return read_phase(root, scene);
    }
    read_section_table(*table, scene);
}

}  // namespace slideway
