#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

constexpr int apices = 8;

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

/// Place of what crosses the section among `surface_names`.
int read_surface(Node const& on, MechanismInfo const& mechanism) {
    std::string const& name = read_text_value(on);
    auto const known = surface_names(mechanism);
    auto const found = std::ranges::find(known, name);
    if (found != known.end()) return static_cast<int>(found - known.begin());
    std::string_view const near = nearest_name(name, std::vector<std::string_view>(known.begin(), known.end()));
    auto const states = std::span(known).first(static_cast<std::size_t>(mechanism.states));
    std::string_view const gaps = mechanism.spatial ? ", gap_y[P1] to gap_y[P8], gap_z[P1] to gap_z[P8]" : "";
    refuse(on, {mechanism.spatial ? "neither a state nor a gap" : "no state of it",
                near.empty() ? fmt::format("use one of {}{}", fmt::join(states, ", "), gaps)
                             : fmt::format("did you mean \"{}\"?", near)});
}

}  // namespace

std::string_view section_unit(SectionSurface const& section, Mechanism mechanism) {
    if (section.is_phase()) return "rad";
    if (section.on != SectionSurface::On::state) return "m";
    SeriesInfo const& state = state_info(info(mechanism), section.index);
    Key const* const key = find_key(fmt::format("initial.{}", state.name));
    return key != nullptr ? key->unit : state.unit;
}

void read_section(Node const& table, Scene& scene) {
    using On = SectionSurface::On;
    SectionSurface& section = scene.chaos.section;
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    std::string const example = "write for example { on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }";
    if (!table.is_table()) refuse(table, {"not a section", example});
    check_arguments(table, "section", {"on", "value", "direction"});
    Node const *const on = table.find("on"), *const value = table.find("value"), *const direction = table.find("direction");
    if (on == nullptr) refuse_that(table, "has no on", {"what crosses the section", example});
    int const index = read_surface(*on, mechanism), states = mechanism.states;
    if (on->text == impacts_name) {
        check_impacts(*on, value, scene.parts);
        section.on = On::impacts;
        section.direction = CrossingDirection::both;
    } else {
        section.on = index < states ? On::state : index < states + apices ? On::gap_y : On::gap_z;
        section.index = index < states ? index : (index - states) % apices;
        if (value != nullptr) section.level = read_number(*value, section_unit(section, scene.parts.mechanism));
    }
    // A crank may turn either way.
    if (section.on == On::state && mechanism.state[section.index] == Series::crank_angle) section.direction = CrossingDirection::both;
    if (direction != nullptr) section.direction = static_cast<CrossingDirection>(read_choice(*direction, "direction", crossing_direction_names));
}

}  // namespace slideway
