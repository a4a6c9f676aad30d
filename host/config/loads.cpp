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

constexpr LoadNumber numbers[] = {
    {push, "force_x", "N", "force along X", of_load<&Load::force, 0>},
    {push, "force_y", "N", "force along Y", of_load<&Load::force, 1>},
    {push, "force_z", "N", "force along Z", of_load<&Load::force, 2>, any, 0, false},
    {push, "torque_x", "N m", "torque about X", of_load<&Load::torque, 0>, any, 0, false},
    {push, "torque_y", "N m", "torque about Y", of_load<&Load::torque, 1>, any, 0, false},
    {push, "torque_z", "N m", "torque about Z", of_load<&Load::torque, 2>},
    {push, "point_x", "m", "where the force acts, along the slider's X from its centre", of_load<&Load::point, 0>},
    {push, "point_y", "m", "where the force acts, along the slider's Y", of_load<&Load::point, 1>},
    {push, "point_z", "m", "where the force acts, along the slider's Z", of_load<&Load::point, 2>, any, 0, false},
    {push, "torque", "N m", "torque on the crank", of_load<&Load::crank_torque>, any, 0, true, true, false},
    {push, "scale", "1", "what force and torque are multiplied by", of_load<&Load::scale>, any, 1, true, true},

    {spring, "anchor_x", "m", "where the spring is held on the ground, along X", of_load<&Load::anchor, 0>},
    {spring, "anchor_y", "m", "where the spring is held on the ground, along Y", of_load<&Load::anchor, 1>},
    {spring, "anchor_z", "m", "where the spring is held on the ground, along Z", of_load<&Load::anchor, 2>, any, 0, false},
    {spring, "point_x", "m", "where the slider holds the spring, along the slider's X from its centre", of_load<&Load::point, 0>},
    {spring, "point_y", "m", "where the slider holds the spring, along the slider's Y", of_load<&Load::point, 1>},
    {spring, "point_z", "m", "where the slider holds the spring, along the slider's Z", of_load<&Load::point, 2>, any, 0, false},
    {spring, "stiffness", "N/m", "stiffness of the spring", of_load<&Load::stiffness>, not_negative},
    {spring, "damping", "N s/m", "damping of the spring", of_load<&Load::damping>, not_negative},
    {spring, "rest_length", "m", "length at which the tension is the preload", of_load<&Load::rest_length>},
    {spring, "preload", "N", "tension at the rest length", of_load<&Load::preload>},

    {stop, "position", "m", "x at which the slider's point touches the stop", of_load<&Load::anchor, 0>},
    {stop, "point_x", "m", "the slider's point that touches, along the slider's X from its centre", of_load<&Load::point, 0>},
    {stop, "point_y", "m", "the slider's point that touches, along the slider's Y", of_load<&Load::point, 1>},
    {stop, "point_z", "m", "the slider's point that touches, along the slider's Z", of_load<&Load::point, 2>, any, 0, false},
    {stop, "stiffness", "N/m", "stiffness of the stop", of_load<&Load::stiffness>, positive},
    {stop, "damping", "N s/m", "damping of the stop", of_load<&Load::damping>, not_negative},
    {stop, "dissipation", "s/m", "a speed into the stop multiplies the force of its stiffness by 1 + this times the speed", of_load<&Load::dissipation>, not_negative},

    {ground_motion, "scale_x", "1", "what the ground's acceleration along X is multiplied by", of_load<&Load::force, 0>, any, 1},
    {ground_motion, "scale_y", "1", "what the ground's acceleration along Y is multiplied by", of_load<&Load::force, 1>, any, 1},
    {ground_motion, "scale_z", "1", "what the ground's acceleration along Z is multiplied by", of_load<&Load::force, 2>, any, 1, false},

    {way_profile, "scale", "1", "what the depth of the table is multiplied by", of_load<&Load::scale>, not_negative, 1, false},

    {way_ends, "from", "m", "x at which the way begins", of_load<&Load::from>, any, 0, false},
    {way_ends, "to", "m", "x at which the way ends", of_load<&Load::to>, any, 0, false},

    {film, "viscosity", "Pa s", "dynamic viscosity of the lubricant between slider and way", of_load<&Load::viscosity>, positive, 0, false},
    {film, "least_gap", "m", "mean gap of a face below which its film becomes no thinner: roughness", of_load<&Load::least_gap>, positive, 0, false},
    {film, "cavitation_pressure", "Pa", "how far the film's pressure falls below the ambient one before it breaks; 0: it never pulls",
     of_load<&Load::cavitation_pressure>, not_negative, 0, false},
};

using Type = Setting::Type;

// Above the numbers of their tables, and below them.
constexpr Setting rows_above[] = {
    {.name = "load.<name>.on", .type = Type::choice, .unit = "", .meaning = "what the load acts on", .preset = "slider", .choices = load_bodies},
    {.name = "load.<name>.frame", .type = Type::choice, .unit = "",
     .meaning = "whose axes force and torque are along: those of the ground, or the slider's, with which they turn", .preset = "ground", .choices = load_frames},
    {.name = "spring.<name>.along", .type = Type::choice, .unit = "",
     .meaning = "line: from the anchor to the slider's point; x: along X alone, its length being x of the point less anchor_x", .preset = "line",
     .choices = spring_directions},
    {.name = "way_profile.<name>.faces", .type = Type::choice, .unit = "", .meaning = "faces of the way that the profile is of", .preset = "all",
     .choices = profiled_faces},
    {.name = "stop.<name>.blocks", .type = Type::choice, .unit = "", .meaning = "which way the slider cannot go on", .preset = "-", .choices = stop_sides},
};
constexpr Setting rows_below[] = {
    {.name = "load.<name>.table", .type = Type::text, .unit = "",
     .meaning = "file of a table, beside the scene, whose column the load is multiplied by", .preset = "-"},
    {.name = "load.<name>.over", .type = Type::choice, .unit = "", .meaning = "the table's column that the load is read over", .preset = "-",
     .choices = load_arguments},
    {.name = "load.<name>.column", .type = Type::text, .unit = "", .meaning = "the table's column of values, which in SI units multiply the load",
     .preset = "-"},
    {.name = "load.<name>.interpolation", .type = Type::choice, .unit = "", .meaning = "how the load runs between the rows of its table", .preset = "spline",
     .choices = interpolation_names},
    {.name = "load.<name>.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether the table begins anew behind its last row; else the load stays as it is there", .preset = "true over crank_angle, else false"},
    {.name = "way_profile.<name>.table", .type = Type::text, .unit = "",
     .meaning = "file of a table, beside the scene: a column x, and one that says how far the face lies back there", .preset = "-"},
    {.name = "way_profile.<name>.column", .type = Type::text, .unit = "", .meaning = "the table's column of depths", .preset = "-"},
    {.name = "way_profile.<name>.interpolation", .type = Type::choice, .unit = "", .meaning = "how the face runs between the rows of the table",
     .preset = "spline", .choices = smooth_interpolation_names},
    {.name = "way_profile.<name>.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether the table begins anew behind its last row; else the face stays as it is there", .preset = "false"},
    {.name = "ground_motion.table", .type = Type::text, .unit = "",
     .meaning = "file of a table, beside the scene: columns time and one or more of ax, ay, az, the ground's acceleration", .preset = "-"},
    {.name = "ground_motion.interpolation", .type = Type::choice, .unit = "", .meaning = "how the acceleration runs between the rows of the table",
     .preset = "spline", .choices = interpolation_names},
    {.name = "ground_motion.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether the table begins anew behind its last row; else the acceleration stays as it is there", .preset = "false"},
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
                bool const asked = number.rule == positive || number.name == "position" || number.kind == way_ends;
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
