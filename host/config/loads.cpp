#include "host/config/loads.hpp"

#include <algorithm>
#include <deque>
#include <numbers>

#include "host/config/settings.hpp"
#include "kernels/inputs.hpp"

namespace slideway {
namespace {

constexpr LoadNumber numbers[] = {
    {.name = "force_x", .unit = "N", .meaning = "force along X", .place = [](Load& l) -> int& { return l.force[0]; }},
    {.name = "force_y", .unit = "N", .meaning = "force along Y", .place = [](Load& l) -> int& { return l.force[1]; }},
    {.name = "force_z", .unit = "N", .meaning = "force along Z", .place = [](Load& l) -> int& { return l.force[2]; }, .planar = false},
    {.name = "torque_x", .unit = "N m", .meaning = "torque about X", .place = [](Load& l) -> int& { return l.torque[0]; }, .planar = false},
    {.name = "torque_y", .unit = "N m", .meaning = "torque about Y", .place = [](Load& l) -> int& { return l.torque[1]; }, .planar = false},
    {.name = "torque_z", .unit = "N m", .meaning = "torque about Z", .place = [](Load& l) -> int& { return l.torque[2]; }},
    {.name = "point_x", .unit = "m", .meaning = "where the force acts, along the slider's X from its centre", .place = [](Load& l) -> int& { return l.point[0]; }},
    {.name = "point_y", .unit = "m", .meaning = "where the force acts, along the slider's Y", .place = [](Load& l) -> int& { return l.point[1]; }},
    {.name = "point_z", .unit = "m", .meaning = "where the force acts, along the slider's Z", .place = [](Load& l) -> int& { return l.point[2]; }, .planar = false},
    {.name = "torque", .unit = "N m", .meaning = "torque on the crank", .place = [](Load& l) -> int& { return l.crank_torque; }, .of_crank = true, .of_slider = false},
    {.name = "scale", .unit = "1", .meaning = "what force and torque are multiplied by", .place = [](Load& l) -> int& { return l.scale; }, .of_crank = true},
};

using Type = Setting::Type;

constexpr Setting other_rows[] = {
    {.name = "load.<name>.on", .type = Type::choice, .unit = "", .meaning = "what the load acts on", .preset = "slider", .choices = load_bodies},
    {.name = "load.<name>.frame", .type = Type::choice, .unit = "",
     .meaning = "whose axes force and torque are along: those of the ground, or the slider's, with which they turn", .preset = "ground", .choices = load_frames},
    {.name = "load.<name>.table", .type = Type::text, .unit = "", .meaning = "file of a table, beside the scene, whose column the load is multiplied by", .preset = "-"},
    {.name = "load.<name>.over", .type = Type::choice, .unit = "", .meaning = "the table's column that the load is read over", .preset = "-", .choices = load_arguments},
    {.name = "load.<name>.column", .type = Type::text, .unit = "", .meaning = "the table's column of values, which in SI units multiply the load", .preset = "-"},
    {.name = "load.<name>.interpolation", .type = Type::choice, .unit = "", .meaning = "how the load runs between the rows of its table", .preset = "spline",
     .choices = interpolation_names},
    {.name = "load.<name>.repeats", .type = Type::truth, .unit = "",
     .meaning = "whether the table begins anew behind its last row; else the load stays as it is there", .preset = "true over crank_angle, else false"},
};

}  // namespace

std::span<LoadNumber const> load_numbers() { return numbers; }

std::span<Setting const> load_settings() {
    static std::deque<std::string> const names = [] {
        std::deque<std::string> all;
        for (LoadNumber const& number : numbers) all.push_back("load.<name>." + std::string(number.name));
        return all;
    }();
    static std::vector<Setting> const rows = [] {
        std::vector<Setting> all(std::begin(other_rows), std::end(other_rows));
        for (std::size_t i = 0; i < std::size(numbers); ++i) {
            Setting const row{.name = names[i], .type = Type::number, .unit = numbers[i].unit, .meaning = numbers[i].meaning,
                              .preset = numbers[i].name == "scale" ? "1" : "0"};
            all.insert(all.begin() + static_cast<std::ptrdiff_t>(2 + i), row);
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
    // A scale that nobody gives is 1, everything else 0.
    keys_.push_back({names_.emplace_back(std::move(name)), load_inputs[place], number.unit, Rule::any, KeyGroup::load, number.meaning,
                     number.name == "scale" ? 1.0 : 0.0});
    return place;
}

Key const* SceneLoads::find_key(std::string_view name) const {
    auto const found = std::ranges::find(keys_, name, &Key::name);
    return found == keys_.end() ? nullptr : &*found;
}

std::string_view jumping_load(SceneLoads const* loads) {
    for (std::size_t i = 0; loads != nullptr && i < loads->rows().size(); ++i) {
        Load const& load = loads->load(i);
        bool const once_a_turn = load.table.repeats && loads->rows()[i].table.span < 3 * std::numbers::pi;
        if (load.over == LoadArgument::time || (load.over == LoadArgument::crank_angle && !once_a_turn)) return loads->rows()[i].name;
    }
    return {};
}

}  // namespace slideway
