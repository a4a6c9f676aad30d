#include "host/config/loads.hpp"

#include <algorithm>
#include <deque>
#include <numbers>

#include "host/config/keys.hpp"
#include "host/config/settings.hpp"
#include "kernels/inputs.hpp"

namespace slideway {
namespace {

using enum LoadKind;
using enum Rule;

/// Where a load has the place of a number.
template <auto member> int& of_load(Load& load) { return load.*member; }
template <auto member, int i> int& of_load(Load& load) { return (load.*member)[i]; }

constexpr unsigned anywhere = on_sliders | on_linkage;

constexpr LoadNumber numbers[] = {
    {push, "force_x", "N", "force along X", of_load<&Load::force, 0>},
    {push, "force_y", "N", "force along Y", of_load<&Load::force, 1>},
    {push, "force_z", "N", "force along Z", of_load<&Load::force, 2>, on_spatial_slider},
    {push, "torque_x", "N m", "torque about X", of_load<&Load::torque, 0>, on_spatial_slider},
    {push, "torque_y", "N m", "torque about Y", of_load<&Load::torque, 1>, on_spatial_slider},
    {push, "torque_z", "N m", "torque about Z", of_load<&Load::torque, 2>, on_sliders},
    {push, "point_x", "m", "where the force acts, along X of slider or body", of_load<&Load::point, 0>},
    {push, "point_y", "m", "the same along Y", of_load<&Load::point, 1>},
    {push, "point_z", "m", "the same along Z", of_load<&Load::point, 2>, on_spatial_slider},
    {push, "torque", "N m", "torque on crank or body", of_load<&Load::crank_torque>, on_crank | on_linkage},
    {push, "scale", "1", "factor of force and torque", of_load<&Load::scale>, anywhere | on_crank, any, 1},

    {spring, "anchor_x", "m", "where the spring is held on ground or other body, along X", of_load<&Load::anchor, 0>},
    {spring, "anchor_y", "m", "the same along Y", of_load<&Load::anchor, 1>},
    {spring, "anchor_z", "m", "the same along Z", of_load<&Load::anchor, 2>, on_spatial_slider},
    {spring, "point_x", "m", "where it holds slider or body, along that one's X", of_load<&Load::point, 0>},
    {spring, "point_y", "m", "the same along Y", of_load<&Load::point, 1>},
    {spring, "point_z", "m", "the same along Z", of_load<&Load::point, 2>, on_spatial_slider},
    {spring, "stiffness", "N/m", "stiffness", of_load<&Load::stiffness>, anywhere, not_negative},
    {spring, "damping", "N s/m", "damping", of_load<&Load::damping>, anywhere, not_negative},
    {spring, "rest_length", "m", "length or displacement at which the tension is the preload", of_load<&Load::rest_length>},
    {spring, "preload", "N", "tension at the rest length", of_load<&Load::preload>},
    {spring, "angular_stiffness", "N m/rad", "stiffness against angles", of_load<&Load::angular_stiffness>, on_linkage, not_negative},
    {spring, "angular_damping", "N m s/rad", "damping of that", of_load<&Load::angular_damping>, on_linkage, not_negative},
    {spring, "angle", "rad", "angle at which the torque is the preload", of_load<&Load::angle>, on_linkage},
    {spring, "angular_preload", "N m", "torque at that angle", of_load<&Load::angular_preload>, on_linkage},

    {stop, "position", "m", "x of the slider's point, or displacement, that touches", of_load<&Load::anchor, 0>},
    {stop, "point_x", "m", "the slider's point that touches, along the slider's X", of_load<&Load::point, 0>, on_sliders},
    {stop, "point_y", "m", "the same along Y", of_load<&Load::point, 1>, on_sliders},
    {stop, "point_z", "m", "the same along Z", of_load<&Load::point, 2>, on_spatial_slider},
    {stop, "stiffness", "N/m", "stiffness", of_load<&Load::stiffness>, anywhere, positive},
    {stop, "damping", "N s/m", "damping", of_load<&Load::damping>, anywhere, not_negative},
    {stop, "dissipation", "s/m", "a speed into it multiplies the elastic force by 1 + this times that speed", of_load<&Load::dissipation>,
     anywhere, not_negative},
    {stop, "angle", "rad", "angle that touches", of_load<&Load::angle>, on_linkage},
    {stop, "angular_stiffness", "N m/rad", "stiffness against angles", of_load<&Load::angular_stiffness>, on_linkage, positive},
    {stop, "angular_damping", "N m s/rad", "damping of that", of_load<&Load::angular_damping>, on_linkage, not_negative},
    {stop, "angular_dissipation", "s/rad", "dissipation of that", of_load<&Load::angular_dissipation>, on_linkage, not_negative},

    {ground_motion, "scale_x", "1", "factor of the ground's acceleration along X", of_load<&Load::force, 0>, on_sliders, any, 1},
    {ground_motion, "scale_y", "1", "the same along Y", of_load<&Load::force, 1>, on_sliders, any, 1},
    {ground_motion, "scale_z", "1", "the same along Z", of_load<&Load::force, 2>, on_spatial_slider, any, 1},

    {way_profile, "scale", "1", "factor of the depth", of_load<&Load::scale>, on_spatial_slider, not_negative, 1},

    {way_ends, "from", "m", "x at which the way begins", of_load<&Load::from>, on_spatial_slider},
    {way_ends, "to", "m", "x at which the way ends", of_load<&Load::to>, on_spatial_slider},

    {film, "viscosity", "Pa s", "dynamic viscosity of the lubricant", of_load<&Load::viscosity>, on_spatial_slider, positive},
    {film, "least_gap", "m", "mean gap of a face below which its film becomes no thinner", of_load<&Load::least_gap>, on_spatial_slider, positive},
    {film, "cavitation_pressure", "Pa", "how far the film's pressure falls below the ambient one before it breaks",
     of_load<&Load::cavitation_pressure>, on_spatial_slider, not_negative},
};

using Type = Setting::Type;

constexpr Setting body_of(std::string_view name) { return {.name = name, .type = Type::text, .unit = "", .meaning = "body that it acts on", .preset = "-"}; }
constexpr Setting against_of(std::string_view name) {
    return {.name = name, .type = Type::text, .unit = "", .meaning = "the other body", .preset = "ground"};
}
constexpr Setting link_of(std::string_view name) {
    return {.name = name, .type = Type::text, .unit = "", .meaning = "joint in the place of both", .preset = "-"};
}

// Above the numbers of their tables, and below them.
constexpr Setting rows_above[] = {
    {.name = "load.<name>.on", .type = Type::choice, .unit = "", .meaning = "what the load acts on, or a body", .preset = "slider", .choices = load_bodies},
    against_of("load.<name>.against"),
    {.name = "load.<name>.frame", .type = Type::choice, .unit = "",
     .meaning = "whose axes force and torque are along, and turn with", .preset = "ground", .choices = load_frames},
    body_of("spring.<name>.on"), against_of("spring.<name>.against"), link_of("spring.<name>.link"),
    {.name = "spring.<name>.along", .type = Type::choice, .unit = "",
     .meaning = "from the anchor to the slider's point, or along X alone", .preset = "line",
     .choices = spring_directions},
    {.name = "way_profile.<name>.faces", .type = Type::choice, .unit = "", .meaning = "faces of the way that the profile is of", .preset = "all",
     .choices = profiled_faces},
    body_of("stop.<name>.on"), against_of("stop.<name>.against"), link_of("stop.<name>.link"),
    {.name = "stop.<name>.blocks", .type = Type::choice, .unit = "", .meaning = "which way it cannot go on", .preset = "-", .choices = stop_sides},
};
constexpr Setting rows_below[] = {
    {.name = "load.<name>.table", .type = Type::text, .unit = "",
     .meaning = "table beside the scene, whose column multiplies the load", .preset = "-"},
    {.name = "load.<name>.over", .type = Type::choice, .unit = "", .meaning = "its column that the load is read over", .preset = "-",
     .choices = load_arguments},
    {.name = "load.<name>.column", .type = Type::text, .unit = "", .meaning = "its column of values, in SI units",
     .preset = "-"},
    {.name = "load.<name>.interpolation", .type = Type::choice, .unit = "", .meaning = "how it runs between its rows", .preset = "spline",
     .choices = interpolation_names},
    {.name = "load.<name>.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether it begins anew behind its last row, or stays", .preset = "true over crank_angle, else false"},
    {.name = "way_profile.<name>.table", .type = Type::text, .unit = "",
     .meaning = "table beside the scene: columns x, and how far the face lies back", .preset = "-"},
    {.name = "way_profile.<name>.column", .type = Type::text, .unit = "", .meaning = "its column of depths", .preset = "-"},
    {.name = "way_profile.<name>.interpolation", .type = Type::choice, .unit = "", .meaning = "how it runs between its rows",
     .preset = "spline", .choices = smooth_interpolation_names},
    {.name = "way_profile.<name>.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether it begins anew behind its last row, or stays", .preset = "false"},
    {.name = "ground_motion.table", .type = Type::text, .unit = "",
     .meaning = "table beside the scene: columns time, and some of ax, ay, az", .preset = "-"},
    {.name = "ground_motion.interpolation", .type = Type::choice, .unit = "", .meaning = "how it runs between its rows",
     .preset = "spline", .choices = interpolation_names},
    {.name = "ground_motion.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether it begins anew behind its last row, or stays", .preset = "false"},
};

/// "load.<name>." of its numbers.
std::string prefix_of(std::string_view table) { return std::string(table) + (has_named_loads(table) ? ".<name>." : "."); }

}  // namespace

std::span<LoadNumber const> load_numbers() { return numbers; }

Key LoadNumber::key(std::string_view dotted, int at) const { return {dotted, load_inputs[at], unit, rule, KeyGroup::load, meaning, preset}; }

LoadNumber const* find_load_number(LoadKind kind, std::string_view name) {
    auto const found = std::ranges::find_if(numbers, [&](LoadNumber const& number) { return number.kind == kind && number.name == name; });
    return found == std::end(numbers) ? nullptr : found;
}

std::span<Setting const> load_settings() {
    static std::deque<std::string> names;
    static std::vector<Setting> const rows = [] {
        std::vector<Setting> all;
        for (std::string_view const table : load_tables) {
            auto const add = [&](Setting const& row) {
                if (row.table() == table) all.push_back(row);
            };
            std::ranges::for_each(rows_above, add);
            for (LoadNumber const& number : numbers) {
                if (table_of(number.kind) != table) continue;
                names.push_back(prefix_of(table) + std::string(number.name));
                bool const asked = number.rule == positive || number.name == "position" || (number.kind == stop && number.name == "angle") || number.kind == way_ends;
                all.push_back({.name = names.back(), .type = Type::number, .unit = number.unit, .meaning = number.meaning,
                               .preset = asked ? "-" : number.preset == 1 ? "1" : "0", .range = range_of(number.rule)});
            }
            std::ranges::for_each(rows_below, add);
        }
        return all;
    }();
    return rows;
}

void SceneLoads::add(Row row, Load const& load) {
    rows_.push_back(std::move(row));
    loads_.push_back(load);
    // Of rows that have moved, too.
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        loads_[i].name = rows_[i].name.c_str();
        if (rows_[i].table.function != nullptr) loads_[i].table = rows_[i].table.function->table();
    }
}

int SceneLoads::add_key(std::string name, LoadNumber const& number) {
    auto const place = static_cast<int>(keys_.size());
    keys_.push_back(number.key(names_.emplace_back(std::move(name)), place));
    return place;
}

Key const* SceneLoads::find_key(std::string_view name) const {
    auto const found = std::ranges::find(keys_, name, &Key::name);
    return found == keys_.end() ? nullptr : &*found;
}

bool jumps_at_columns(LoadArgument over, LoadTable const& table) {
    bool const once_a_turn = table.function->table().repeats && table.span < 3 * std::numbers::pi;
    return over == LoadArgument::time || (over == LoadArgument::crank_angle && !once_a_turn);
}

std::string_view jumping_load(SceneLoads const* loads) {
    for (std::size_t i = 0; loads != nullptr && i < loads->rows().size(); ++i) {
        Load const& load = loads->load(i);
        if (load.over != LoadArgument::nothing && jumps_at_columns(load.over, loads->rows()[i].table)) return loads->rows()[i].name;
    }
    return {};
}

}  // namespace slideway
