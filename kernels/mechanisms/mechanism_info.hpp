// What each mechanism has, in one table: the kernels size their records by it, the host names, checks and stores by it.
// Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <initializer_list>

#include "kernels/inputs.hpp"
#include "kernels/observers/quantities.hpp"

namespace slideway {

inline constexpr int most_states = 12;  // of any mechanism

struct MechanismInfo {
    char const* name;  // mechanism.kind
    char const* meaning;
    int states;                 // how many numbers the state has
    Series state[most_states];  // which ones, in their order
    Selection series;           // what a time series may hold
    Selection always;           // what every time series holds
    Selection quantities;       // what may be asked of a member
    bool spatial;               // eight apices and a law of faces; else corners
};

namespace detail {

constexpr Selection all_of(std::initializer_list<Quantity> list) {
    Selection set = 0;
    for (Quantity const q : list) set |= selection_of(q);
    return set;
}
constexpr Selection all_of(std::initializer_list<Series> list) {
    Selection set = 0;
    for (Series const s : list) set |= selection_of(s);
    return set;
}

inline constexpr Selection crank_quantities =
    all_of({Quantity::peak_crank_torque, Quantity::rms_crank_torque, Quantity::peak_rod_angular_velocity,
            Quantity::rms_rod_angular_velocity});
inline constexpr Selection apex_quantities = all_of({Quantity::peak_apex_force, Quantity::mean_apex_force});
inline constexpr Selection sensor_quantities =
    all_of({Quantity::peak_channel_acceleration, Quantity::acceleration_area});
inline constexpr Selection all_quantities = (Selection{1} << quantity_count) - 1;

inline constexpr Selection crank_series = all_of({Series::crank_torque, Series::rod_angular_velocity});
inline constexpr Selection planar_states =
    all_of({Series::crank_angle, Series::rod_angle, Series::pitch, Series::crank_angular_velocity,
            Series::rod_angular_velocity, Series::wz});
inline constexpr Selection planar_only =
    all_of({Series::crank_angle, Series::crank_angular_velocity, Series::rod_angle});
inline constexpr Selection spatial_series = ((Selection{1} << series_count) - 1) & ~planar_only;
inline constexpr Selection ten_states = (Selection{1} << 10) - 1, twelve_states = (Selection{1} << 12) - 1;

}  // namespace detail

#define SLIDEWAY_TEN_STATES                                                                                         \
    Series::y, Series::z, Series::vy, Series::vz, Series::roll, Series::yaw, Series::pitch, Series::wx, Series::wy, \
        Series::wz

/// In the order of `Mechanism`.
inline constexpr MechanismInfo mechanism_table[] = {
    {"slider_crank",
     "spatial slider-crank at constant crank speed, its slider with clearance on a rectangular way",
     10,
     {SLIDEWAY_TEN_STATES},
     detail::spatial_series,
     detail::ten_states,
     detail::all_quantities,
     true},
    {"carriage",
     "slider moved to and fro along the way at constant speed, as in the paper's experiment",
     10,
     {SLIDEWAY_TEN_STATES},
     detail::spatial_series & ~detail::crank_series,
     detail::ten_states,
     detail::all_quantities & ~detail::crank_quantities,
     true},
    {"free_slider",
     "slider that nothing drives, free along the way too",
     12,
     {SLIDEWAY_TEN_STATES, Series::x, Series::vx},
     detail::spatial_series & ~detail::crank_series,
     detail::twelve_states,
     detail::all_quantities & ~detail::crank_quantities & ~selection_of(Quantity::crank_work),
     true},
    {"planar_slider_crank",
     "block between two walls, with a driven or a free crank, all in one plane",
     6,
     {Series::crank_angle, Series::rod_angle, Series::pitch, Series::crank_angular_velocity,
      Series::rod_angular_velocity, Series::wz},
     detail::planar_states |
         detail::all_of({Series::y, Series::vy, Series::x, Series::vx, Series::normal_force, Series::crank_torque,
                         Series::surfaces, Series::points, Series::ax, Series::ay}),
     detail::planar_states | detail::all_of({Series::y, Series::vy}),
     detail::all_quantities & ~detail::apex_quantities & ~detail::sensor_quantities,
     false},
};

#undef SLIDEWAY_TEN_STATES

constexpr MechanismInfo const& info(Mechanism mechanism) { return mechanism_table[static_cast<int>(mechanism)]; }

/// Whether a drive prescribes a component of the state, so that neighbours cannot differ in it: angle and speed of a driven planar crank.
constexpr bool is_prescribed(Parts const& parts, int component) {
    return parts.mechanism == Mechanism::planar_slider_crank && !parts.free_crank && (component == 0 || component == 3);
}
/// How many components neighbours may differ in.
constexpr int free_states(Parts const& parts) {
    int count = 0;
    for (int i = 0; i < info(parts.mechanism).states; ++i) count += is_prescribed(parts, i) ? 0 : 1;
    return count;
}

}  // namespace slideway
