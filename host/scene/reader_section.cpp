#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/scene/reader.hpp"
#include "host/scene/suggest.hpp"
#include "host/scene/values.hpp"

namespace slideway {
namespace {

constexpr std::uint64_t most_crossings = 1'000'000;
constexpr int apices = 8;

void read_phase(Node const& root, Scene& scene) {
    Node const* const node = root.find_path("study.phase");
    if (node != nullptr) scene.chaos.section.level = read_number(*node, "rad");
    if (scene.inputs.crank_speed != 0) return;
    refuse_study(root, node, "study.phase",
                 {"mechanism.crank_speed is 0, so no crank angle comes round",
                  scene.study == StudyKind::sweep ? "give the crank a speed" : "give study.section"});
}

/// Names of what a section may be taken of: states, then gaps.
std::vector<std::string> surface_names() {
    std::vector<std::string> names;
    for (int i = 0; i < state_series; ++i) names.emplace_back(series_table[i].name);
    for (char const* const face : {"gap_y", "gap_z"}) {
        for (int apex = 1; apex <= apices; ++apex) names.push_back(fmt::format("{}[P{}]", face, apex));
    }
    return names;
}

void read_section_table(Node const& table, SectionSurface& section) {
    constexpr std::string_view example = "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }";
    if (!table.is_table()) refuse(table, {"not a section", fmt::format("write for example {}", example)});
    for (Node const& node : table.children) {
        if (node.key != "on" && node.key != "value" && node.key != "direction") {
            refuse(node, {"no argument of a section", "use on, value, direction"});
        }
    }
    Node const* const on = table.find("on");
    if (on == nullptr) {
        throw SceneError(fmt::format("{}: study.section has no on (what crosses the section); write for example {}",
                                     table.where, example));
    }
    std::string const& name = read_text_value(*on);
    auto const known = surface_names();
    auto const found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
        std::vector<std::string_view> const names(known.begin(), known.end());
        std::string_view const near = nearest_name(name, names);
        refuse(*on, {"neither a state nor a gap",
                     near.empty() ? std::string("use one of y, z, vy, vz, roll, yaw, pitch, wx, wy, wz, gap_y[P1] to "
                                                "gap_y[P8], gap_z[P1] to gap_z[P8]")
                                  : fmt::format("did you mean \"{}\"?", near)});
    }
    int const index = static_cast<int>(found - known.begin());
    using On = SectionSurface::On;
    bool const state = index < state_series;
    section.on = state ? On::state : index < state_series + apices ? On::gap_y : On::gap_z;
    section.index = state ? index : (index - state_series) % apices;
    if (Node const* const value = table.find("value")) {
        section.level = read_number(*value, section_unit(section));
    }
    if (Node const* const direction = table.find("direction")) {
        section.direction =
            static_cast<CrossingDirection>(read_choice(*direction, "direction", crossing_direction_names));
    }
}

}  // namespace

std::string_view section_unit(SectionSurface const& section) {
    switch (section.on) {
        case SectionSurface::On::phase:
            return "rad";
        case SectionSurface::On::state:
            return find_key(fmt::format("initial.{}", series_table[section.index].name))->unit;
        default:
            return "m";
    }
}

void read_section(Node const& root, Scene& scene) {
    refuse_both(root, "study.phase", "study.section");
    Node const* const table = root.find_path("study.section");
    Node const* const crossings = root.find_path("study.max_crossings");
    if (table == nullptr) {
        if (crossings != nullptr) {
            refuse(*crossings, {"a crank angle comes once a revolution", "remove it, or give study.section"});
        }
        return read_phase(root, scene);
    }
    read_section_table(*table, scene.chaos.section);
    if (crossings != nullptr) {
        scene.chaos.max_crossings = read_count(*crossings, "number of crossings", 1, most_crossings);
    }
}

}  // namespace slideway
