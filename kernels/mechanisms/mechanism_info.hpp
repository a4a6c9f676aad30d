// What a mechanism is, for those who choose, check, store and describe it.  Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "kernels/inputs.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/signals.hpp"

namespace slideway {

inline constexpr int most_states = 2 * most_linkage_coordinates;  // of any mechanism

/// How the motion that drives a mechanism repeats itself.
enum class DriveKind {
    none,      // nothing drives it
    crank,     // it turns at crank_speed, unless the crank is free
    carriage,  // to and fro: it reverses for a small part of its period
};

/// Stands in the mechanism's own header, as `Mechanism::info`.
struct MechanismInfo {
    char const* name;  // mechanism.kind
    char const* meaning;
    int states;                 // how many numbers the state has
    Series state[most_states];  // which ones, in their order
    Selection series;           // what a time series may hold
    Selection always;           // what every time series holds
    Selection quantities;       // what may be asked of a member
    KeyGroups keys;             // groups of keys that count for it; of contacts those of its law, if it is spatial
    DriveKind drive;
    bool spatial;               // eight apices and a law of faces; else corners
    unsigned prescribed = 0;    // components of the state that its drive prescribes, a bit each: neighbours cannot differ in them
    bool may_turn_freely = false;  // angle and speed of its crank are in the state: no drive need hold its speed, or prescribe anything
    char const* driven_form = nullptr;  // mechanism.kind of the same mechanism without them; nullptr where they are part of every state, or of none
    bool has_exponents = true;  // members may have neighbours beside them
    bool on_cards = false;      // there are kernels for cards
    std::span<SeriesInfo const> own_series = {};  // of a linkage: what the bits of its series are, in the place of series_table
    std::span<QuantityInfo const> own_quantities = {};  // of a linkage: the work of its loads, behind those of quantity_table
    std::span<Key const> own_keys = {};  // of numbers of its own, on Inputs::mechanism_a … mechanism_p
    std::span<Signal const> signals = {};  // that its `put_signals(t, state, parameters, report, values)` tells, in their order
};

namespace selections {

constexpr Selection of(std::initializer_list<Quantity> list) {
    Selection set = 0;
    for (Quantity const q : list) set |= selection_of(q);
    return set;
}
constexpr Selection of(std::initializer_list<Series> list) {
    Selection set = 0;
    for (Series const s : list) set |= selection_of(s);
    return set;
}

inline constexpr Selection crank_quantities =
    of({Quantity::peak_crank_torque, Quantity::rms_crank_torque, Quantity::peak_rod_angular_velocity,
        Quantity::rms_rod_angular_velocity});
inline constexpr Selection force_quantities = quantities_where([](QuantityInfo const& info) { return info.keeper == Keeper::forces; });
inline constexpr Selection pin_quantities = of({Quantity::peak_rod_force, Quantity::peak_crank_pin_force});
inline constexpr Selection apex_quantities = of({Quantity::peak_apex_force, Quantity::mean_apex_force});
inline constexpr Selection sensor_quantities = of({Quantity::peak_channel_acceleration, Quantity::acceleration_area});
inline constexpr Selection all_quantities = (Selection{1} << quantity_count) - 1;

inline constexpr Selection pin_series = of({Series::rod_force_x, Series::rod_force_y, Series::rod_force_z, Series::crank_pin_force_x,
                                            Series::crank_pin_force_y, Series::crank_pin_force_z});
inline constexpr Selection crank_series = of({Series::crank_torque, Series::rod_angular_velocity}) | pin_series;
inline constexpr Selection planar_only = of({Series::crank_angle, Series::crank_angular_velocity, Series::rod_angle});
inline constexpr Selection spatial_series = ((Selection{1} << series_count) - 1) & ~planar_only;
inline constexpr Selection ten_states = (Selection{1} << 10) - 1, twelve_states = (Selection{1} << 12) - 1;

}  // namespace selections

/// What is alike in all mechanisms with a slider of eight apices: the ten numbers of its state first.
constexpr MechanismInfo spatial_slider_info() {
    return {.name = "",
            .meaning = "",
            .states = 10,
            .state = {Series::y, Series::z, Series::vy, Series::vz, Series::roll, Series::yaw, Series::pitch, Series::wx,
                      Series::wy, Series::wz},
            .series = selections::spatial_series & ~selections::crank_series,
            .always = selections::ten_states,
            .quantities = selections::all_quantities & ~selections::crank_quantities & ~selections::pin_quantities,
            .keys = groups_of(KeyGroup::slider, KeyGroup::smooth_friction, KeyGroup::spatial),
            .drive = DriveKind::none,
            .spatial = true};
}

}  // namespace slideway
