#include "host/config/loads.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <stdexcept>

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

/// Keys of all loads that scenes of this process had.  Places of names that no scene has together may be the same.
struct KnownKeys {
    std::mutex access;
    std::deque<std::string> names;
    std::deque<Key> keys;
    std::atomic<std::size_t> count = 0;  // of keys, for those who wait for nobody
};
KnownKeys& known() {
    static KnownKeys all;
    return all;
}

Key const* known_key(KnownKeys const& all, std::string_view name) {
    auto const found = std::ranges::find(all.keys, name, &Key::name);
    return found == all.keys.end() ? nullptr : &*found;
}

int place_of(Key const& key) { return static_cast<int>(std::ranges::find(load_inputs, key.member) - std::begin(load_inputs)); }

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

std::vector<int> know_load_keys(std::span<std::string const> names, std::span<LoadNumber const* const> of) {
    KnownKeys& all = known();
    std::lock_guard const lock(all.access);
    std::vector<int> uses(most_load_numbers, 0);  // of places, by other names
    for (Key const& key : all.keys) ++uses[static_cast<std::size_t>(place_of(key))];
    std::vector<int> places;
    auto const is_free = [&](int place) { return std::ranges::count(places, place) == 0; };
    // Those that are known keep their places.
    for (std::string const& name : names) {
        Key const* const key = known_key(all, name);
        places.push_back(key == nullptr ? Load::none : place_of(*key));
        if (key != nullptr && std::count(places.begin(), places.end(), places.back()) > 1)
            throw std::length_error("earlier scenes of this process had other loads, whose names take the places of these");
    }
    std::vector<std::size_t> added;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (places[i] != Load::none) continue;
        int best = Load::none;
        for (int place = 0; place < most_load_numbers; ++place) {
            if (is_free(place) && (best == Load::none || uses[static_cast<std::size_t>(place)] < uses[static_cast<std::size_t>(best)])) best = place;
        }
        if (best == Load::none) throw std::length_error("all loads of a scene have sixteen numbers at most");
        places[i] = best;
        added.push_back(i);
    }
    for (std::size_t const i : added) {
        std::string const& name = all.names.emplace_back(names[i]);
        // A scale that nobody gives is 1, everything else 0.
        all.keys.push_back({name, load_inputs[places[i]], of[i]->unit, Rule::any, KeyGroup::load, of[i]->meaning, of[i]->name == "scale" ? 1.0 : 0.0});
    }
    all.count.store(all.keys.size(), std::memory_order_release);
    return places;
}

std::vector<Key const*> known_load_keys() {
    KnownKeys& all = known();
    std::lock_guard const lock(all.access);
    std::vector<Key const*> keys;
    for (Key const& key : all.keys) keys.push_back(&key);
    return keys;
}

std::size_t known_load_key_count() { return known().count.load(std::memory_order_acquire); }

bool is_of(Key const& key, LoadList const& loads) {
    constexpr std::string_view table = "load.";
    for (int i = 0; i < loads.count; ++i) {
        std::string_view const name = loads.loads[i].name, own = key.name;
        if (!own.starts_with(table) || own.substr(table.size()).substr(0, name.size()) != name || own.substr(table.size() + name.size(), 1) != ".") continue;
        Load load = loads.loads[i];
        for (LoadNumber const& number : numbers) {
            if (own.substr(table.size() + name.size() + 1) == number.name && number.place(load) == place_of(key)) return true;
        }
    }
    return false;
}

}  // namespace slideway
