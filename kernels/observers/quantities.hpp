// What can be asked of a run, in one table: the lane program fills the columns, the host names and stores them.
#pragma once

#include <cstdint>

namespace slideway {

enum class Quantity : int {
    peak_normal_force,
    mean_normal_force,
    peak_apex_force,
    mean_apex_force,
    mode_time,
    contact_onsets,
    energy_residual,
    energy_change,
    crank_work,
    friction_loss,
    damping_loss,
    peak_crank_torque,
    rms_crank_torque,
    peak_position_error,
    rms_position_error,
    peak_rod_angular_velocity,
    rms_rod_angular_velocity,
    peak_tilt,
    peak_acceleration,
    rms_acceleration,
    peak_channel_acceleration,
    acceleration_area,
    count
};

/// One value (or `columns` values along `dimension`) per member at the end of its run.
struct QuantityInfo {
    char const* name;
    char const* unit;
    int columns;
    char const* dimension;  // nullptr for a scalar; else apex, mode_class, axis, direction or channel
    char const* long_name;
};

inline constexpr QuantityInfo quantity_table[] = {
    {"peak_normal_force", "N", 1, nullptr, "largest sum of the normal forces at the accepted steps"},
    {"mean_normal_force", "N", 1, nullptr, "time mean of the sum of the normal forces"},
    {"peak_apex_force", "N", 8, "apex", "largest normal force of the apex, both of its faces summed"},
    {"mean_apex_force", "N", 8, "apex", "time mean of the normal force of the apex, both of its faces summed"},
    {"mode_time", "s", 4, "mode_class", "time spent in the mode class"},
    {"contact_onsets", "1", 1, nullptr, "changes from free flight to contact"},
    {"energy_residual", "J", 1, nullptr, "energy residual E(t)-E(0)-W+D_f+D_d: energy that the contact law made"},
    {"energy_change", "J", 1, nullptr, "mechanical energy E(t)-E(0)"},
    {"crank_work", "J", 1, nullptr, "work W of the drive: of the crank, or of what moves the carriage"},
    {"friction_loss", "J", 1, nullptr, "friction loss D_f"},
    {"damping_loss", "J", 1, nullptr, "contact damping loss D_d"},
    {"peak_crank_torque", "N m", 1, nullptr, "largest magnitude of the drive torque, crank weight included"},
    {"rms_crank_torque", "N m", 1, nullptr, "root mean square of the drive torque, crank weight included"},
    {"peak_position_error", "m", 1, nullptr, "largest distance of the slider's centre from the ideal mechanism's"},
    {"rms_position_error", "m", 1, nullptr, "root mean square distance from the ideal mechanism's slider"},
    {"peak_rod_angular_velocity", "rad s-1", 1, nullptr, "largest magnitude of the rod's angular velocity"},
    {"rms_rod_angular_velocity", "rad s-1", 1, nullptr, "root mean square of the rod's angular velocity"},
    {"peak_tilt", "rad", 3, "axis", "largest magnitude of roll, yaw and pitch"},
    {"peak_acceleration", "m s-2", 3, "direction", "largest magnitude of the acceleration of the slider's centre"},
    {"rms_acceleration", "m s-2", 3, "direction", "root mean square of the acceleration of the slider's centre"},
    {"peak_channel_acceleration", "m s-2", 2, "channel", "largest magnitude of a sensor's acceleration"},
    {"acceleration_area", "m s-1", 2, "channel", "integral over time of the magnitude of a sensor's acceleration"},
};
inline constexpr int quantity_count = static_cast<int>(Quantity::count);
static_assert(sizeof(quantity_table) / sizeof(quantity_table[0]) == quantity_count);

/// Mode classes of `mode_time`: the hardest contact of the configuration decides.
inline constexpr char const* mode_class_names[] = {"free", "point", "line", "surface"};

/// Values at the sample times.  Which of them are a mechanism's state: mechanisms/mechanism_info.hpp.
enum class Series : int {
    y,
    z,
    vy,
    vz,
    roll,
    yaw,
    pitch,
    wx,
    wy,
    wz,
    x,
    vx,
    normal_force,
    crank_torque,
    rod_angular_velocity,
    surfaces,
    lines,
    points,
    ax,
    ay,
    az,
    acceleration_top,
    acceleration_front,
    crank_angle,
    crank_angular_velocity,
    rod_angle,
    count
};

struct SeriesInfo {
    char const* name;
    char const* unit;
    char const* long_name;
};

inline constexpr SeriesInfo series_table[] = {
    {"y", "m", "vertical position of the slider's centre"},
    {"z", "m", "lateral position of the slider's centre"},
    {"vy", "m s-1", "vertical velocity of the slider's centre"},
    {"vz", "m s-1", "lateral velocity of the slider's centre"},
    {"roll", "rad", "roll of the slider about X"},
    {"yaw", "rad", "yaw of the slider about Y"},
    {"pitch", "rad", "pitch of the slider about Z"},
    {"wx", "rad s-1", "angular velocity of the slider about its X axis"},
    {"wy", "rad s-1", "angular velocity of the slider about its Y axis"},
    {"wz", "rad s-1", "angular velocity of the slider about its Z axis"},
    {"x", "m", "position of the slider's centre along the slide way"},
    {"vx", "m s-1", "velocity of the slider's centre along the slide way"},
    {"normal_force", "N", "sum of the normal forces"},
    {"crank_torque", "N m", "drive torque, crank weight included"},
    {"rod_angular_velocity", "rad s-1", "rod's angular velocity about Z"},
    {"surfaces", "1", "surface contacts"},
    {"lines", "1", "line contacts"},
    {"points", "1", "point contacts"},
    {"ax", "m s-2", "acceleration of the slider's centre along X"},
    {"ay", "m s-2", "acceleration of the slider's centre along Y"},
    {"az", "m s-2", "acceleration of the slider's centre along Z"},
    {"acceleration_top", "m s-2", "acceleration along the slider's Y axis of a sensor 10 mm above the way's top face"},
    {"acceleration_front", "m s-2", "acceleration along the slider's Z axis of a sensor 10 mm before its front face"},
    {"crank_angle", "rad", "angle of the crank"},
    {"crank_angular_velocity", "rad s-1", "angular velocity of the crank"},
    {"rod_angle", "rad", "angle of the rod"},
};
inline constexpr int series_count = static_cast<int>(Series::count);
static_assert(sizeof(series_table) / sizeof(series_table[0]) == series_count);

/// A set of quantities or series: bit i for entry i of the table.
using Selection = std::uint32_t;
constexpr bool selects(Selection set, Quantity q) { return (set >> static_cast<int>(q)) & 1u; }
constexpr Selection selection_of(Quantity q) { return Selection{1} << static_cast<int>(q); }
constexpr Selection selection_of(Series s) { return Selection{1} << static_cast<int>(s); }
constexpr bool selects(Selection set, Series s) { return (set >> static_cast<int>(s)) & 1u; }

/// First column of a quantity in a member's row of all quantities, which is `quantity_columns` wide.
constexpr int quantity_column(Quantity q) {
    int column = 0;
    for (int i = 0; i < static_cast<int>(q); ++i) column += quantity_table[i].columns;
    return column;
}
inline constexpr int quantity_columns = quantity_column(Quantity::count);

}  // namespace slideway
