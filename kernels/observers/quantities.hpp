// What can be asked of a run, in one table: the lane program fills the columns, the host names and stores them.
#pragma once

#include <cstdint>
#include <iterator>

namespace slideway {

/// What a quantity is of the value that `SliderObserver::value` gives it, or of a mechanism's own signal (signals.hpp).
enum class Statistic {
    peak,              // largest magnitude at the accepted steps
    maximum, minimum,  // at the accepted steps; of signals
    at_end,            // the value there; of signals
    mean,              // over time
    root_mean_square,  // over time
    integral,          // over time
    audited_integral,  // likewise, and its error meets the tolerance as the states' do: the energy audit's
    of_audit,          // follows from the energy audit; no value of its own
    counted,           // by code of its own at the accepted steps
};

/// Who keeps a quantity: SliderObserver; AccelerationRecord or ForceRecord, which members that ask for none of its quantities do not carry along; or
/// SignalObserver, of a mechanism's own signals.
enum class Keeper { mechanism, accelerations, forces, signals };

/// Histogram of the speeds at which faces are met: each of the four has so many bins, from these speeds [m/s] on.
inline constexpr double impact_speed_bins[] = {0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1};
inline constexpr int impact_speed_count = static_cast<int>(std::size(impact_speed_bins)), face_speed_count = 4 * impact_speed_count;

// row(name, statistic, keeper, unit, columns, dimension, long name): one value (or `columns` values along `dimension`) per member at the
// end of its run.
// clang-format off
#define SLIDEWAY_QUANTITIES(row) \
    row(peak_normal_force, peak, mechanism, "N", 1, nullptr, "largest sum of the normal forces at the accepted steps") \
    row(mean_normal_force, mean, mechanism, "N", 1, nullptr, "time mean of the sum of the normal forces") \
    row(peak_apex_force, peak, mechanism, "N", 8, "apex", "largest normal force of the apex, both of its faces summed") \
    row(mean_apex_force, mean, mechanism, "N", 8, "apex", "time mean of the normal force of the apex, both of its faces summed") \
    row(mode_time, counted, mechanism, "s", 4, "mode_class", "time spent in the mode class") \
    row(contact_onsets, counted, mechanism, "1", 1, nullptr, "changes from free flight to contact") \
    row(capped_impacts, counted, mechanism, "1", 1, nullptr, "rigid impacts whose restitution was lowered, as with friction it would have made energy") \
    row(energy_residual, of_audit, mechanism, "J", 1, nullptr, "energy residual E(t)-E(0)-W-W_l-W_g+D_f+D_d+D_s+D_o: energy that the contact law made") \
    row(switching_energy, counted, mechanism, "J", 1, nullptr, "sum of the jumps of the contact potential where modes switch, at located switches") \
    row(energy_change, counted, mechanism, "J", 1, nullptr, "mechanical energy E(t)-E(0)") \
    row(drive_work, audited_integral, mechanism, "J", 1, nullptr, "work W of the drive: of the crank, or of what moves the carriage") \
    row(friction_loss, audited_integral, mechanism, "J", 1, nullptr, "friction loss D_f") \
    row(damping_loss, audited_integral, mechanism, "J", 1, nullptr, "contact damping loss D_d") \
    row(load_work, audited_integral, mechanism, "J", 1, nullptr, "work of the loads on slider and crank") \
    row(ground_work, audited_integral, mechanism, "J", 1, nullptr, "work of the ground's motion") \
    row(spring_loss, audited_integral, mechanism, "J", 1, nullptr, "loss in the dampers of springs and stops") \
    row(film_loss, audited_integral, mechanism, "J", 1, nullptr, "loss in the oil film") \
    row(peak_crank_torque, peak, mechanism, "N m", 1, nullptr, "largest magnitude of the drive torque, crank weight included") \
    row(rms_crank_torque, root_mean_square, mechanism, "N m", 1, nullptr, "root mean square of the drive torque, crank weight included") \
    row(peak_position_error, peak, mechanism, "m", 1, nullptr, "largest distance of the slider's centre from the ideal mechanism's") \
    row(rms_position_error, root_mean_square, mechanism, "m", 1, nullptr, "root mean square distance from the ideal mechanism's slider") \
    row(peak_rod_angular_velocity, peak, mechanism, "rad s-1", 1, nullptr, "largest magnitude of the rod's angular velocity") \
    row(rms_rod_angular_velocity, root_mean_square, mechanism, "rad s-1", 1, nullptr, "root mean square of the rod's angular velocity") \
    row(peak_tilt, peak, mechanism, "rad", 3, "axis", "largest magnitude of roll, yaw and pitch") \
    row(peak_acceleration, peak, accelerations, "m s-2", 3, "direction", "largest magnitude of the acceleration of the slider's centre") \
    row(rms_acceleration, root_mean_square, accelerations, "m s-2", 3, "direction", "root mean square of the acceleration of the slider's centre") \
    row(peak_channel_acceleration, peak, accelerations, "m s-2", 2, "channel", "largest magnitude of a sensor's acceleration") \
    row(acceleration_area, integral, accelerations, "m s-1", 2, "channel", "integral over time of the magnitude of a sensor's acceleration") \
    row(peak_face_force, peak, forces, "N", 4, "face", "largest normal force at the way's face") \
    row(peak_pressure, peak, forces, "Pa", 4, "face", "largest normal force at the way's face over the area of that") \
    row(peak_pv, peak, forces, "W m-2", 4, "face", "largest product of pressure and sliding speed, its mean over the way's face") \
    row(mean_pv, mean, forces, "W m-2", 4, "face", "time mean of the product of pressure and sliding speed, its mean over the way's face") \
    row(face_onsets, counted, forces, "1", 4, "face", "times that contact with the way's face began") \
    row(peak_friction_force, peak, forces, "N", 1, nullptr, "largest magnitude of the friction on the slider") \
    row(peak_rod_force, peak, forces, "N", 1, nullptr, "largest magnitude of the rod's force on the slider") \
    row(peak_crank_pin_force, peak, forces, "N", 1, nullptr, "largest magnitude of the crank pin's force on the rod") \
    row(impact_speeds, counted, forces, "1", face_speed_count, "face_speed", "onsets of contact with the face by speed, from the label's [m/s] on")
// clang-format on

enum class Quantity : int {
#define SLIDEWAY_NAME(name, statistic, keeper, unit, columns, dimension, long_name) name,
    SLIDEWAY_QUANTITIES(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
    count
};

struct QuantityInfo {
    char const* name;
    Statistic statistic;
    Keeper keeper;
    char const* unit;
    int columns;
    char const* dimension;  // nullptr for a scalar; else apex, mode_class, axis, direction, channel, face or face_speed
    char const* long_name;

    /// Whether it is the integral of a value over the stages of the steps, or made of one.
    constexpr bool integrates() const {
        return statistic == Statistic::mean || statistic == Statistic::root_mean_square ||
               statistic == Statistic::integral || is_audited();
    }
    constexpr bool is_audited() const { return statistic == Statistic::audited_integral; }
    /// Whether it brings the energy audit along.
    constexpr bool audits() const { return is_audited() || statistic == Statistic::of_audit; }
};

inline constexpr QuantityInfo quantity_table[] = {
#define SLIDEWAY_ROW(name, statistic, keeper, unit, columns, dimension, long_name) \
    {#name, Statistic::statistic, Keeper::keeper, unit, columns, dimension, long_name},
    SLIDEWAY_QUANTITIES(SLIDEWAY_ROW)
#undef SLIDEWAY_ROW
};
inline constexpr int quantity_count = static_cast<int>(Quantity::count);

/// Mode classes of `mode_time`: the hardest contact of the configuration decides.
inline constexpr char const* mode_class_names[] = {"free", "point", "line", "surface"};
/// Faces of the way, in the order of the reports.
inline constexpr char const* face_names[] = {"y_plus", "y_minus", "z_plus", "z_minus"};

// Values at the sample times: row(name, unit, long name).  Which of them are a mechanism's state: mechanisms/mechanism_info.hpp; the others
// are in its report (`series_value`).
// clang-format off
#define SLIDEWAY_SERIES_OF_FACES(row, name, unit, words) \
    row(name##_y_plus, unit, words " at the way's face Y+") row(name##_y_minus, unit, words " at the way's face Y-") \
    row(name##_z_plus, unit, words " at the way's face Z+") row(name##_z_minus, unit, words " at the way's face Z-")
#define SLIDEWAY_SERIES_OF_AXES(row, name, words) \
    row(name##_x, "N", words " X") row(name##_y, "N", words " Y") row(name##_z, "N", words " Z")
#define SLIDEWAY_SERIES(row) \
    row(y, "m", "vertical position of the slider's centre") \
    row(z, "m", "lateral position of the slider's centre") \
    row(vy, "m s-1", "vertical velocity of the slider's centre") \
    row(vz, "m s-1", "lateral velocity of the slider's centre") \
    row(roll, "rad", "roll of the slider about X") \
    row(yaw, "rad", "yaw of the slider about Y") \
    row(pitch, "rad", "pitch of the slider about Z") \
    row(wx, "rad s-1", "angular velocity of the slider about its X axis") \
    row(wy, "rad s-1", "angular velocity of the slider about its Y axis") \
    row(wz, "rad s-1", "angular velocity of the slider about its Z axis") \
    row(x, "m", "position of the slider's centre along the slide way") \
    row(vx, "m s-1", "velocity of the slider's centre along the slide way") \
    row(normal_force, "N", "sum of the normal forces") \
    row(crank_torque, "N m", "drive torque, crank weight included") \
    row(rod_angular_velocity, "rad s-1", "rod's angular velocity about Z") \
    row(surfaces, "1", "surface contacts") \
    row(lines, "1", "line contacts") \
    row(points, "1", "point contacts") \
    row(ax, "m s-2", "acceleration of the slider's centre along X") \
    row(ay, "m s-2", "acceleration of the slider's centre along Y") \
    row(az, "m s-2", "acceleration of the slider's centre along Z") \
    row(acceleration_top, "m s-2", "acceleration along the slider's Y axis of a sensor 10 mm above the way's top face") \
    row(acceleration_front, "m s-2", "acceleration along the slider's Z axis of a sensor 10 mm before its front face") \
    row(crank_angle, "rad", "angle of the crank") \
    row(crank_angular_velocity, "rad s-1", "angular velocity of the crank") \
    row(rod_angle, "rad", "angle of the rod") \
    SLIDEWAY_SERIES_OF_FACES(row, face_force, "N", "normal force") \
    SLIDEWAY_SERIES_OF_FACES(row, face_along, "m", "where the normal force acts along the way, from the slider's centre, 0 without contact,") \
    SLIDEWAY_SERIES_OF_FACES(row, face_across, "m", "where the normal force acts across the way, from its axis, 0 without contact,") \
    SLIDEWAY_SERIES_OF_FACES(row, face_pv, "W m-2", "mean product of pressure and sliding speed") \
    SLIDEWAY_SERIES_OF_AXES(row, friction_force, "friction on the slider along the way's") \
    SLIDEWAY_SERIES_OF_AXES(row, contact_force, "force of the way on the slider, friction included, along") \
    SLIDEWAY_SERIES_OF_AXES(row, rod_force, "force of the rod on the slider along") \
    SLIDEWAY_SERIES_OF_AXES(row, crank_pin_force, "force of the crank pin on the rod along")
// clang-format on

enum class Series : int {
#define SLIDEWAY_NAME(name, unit, long_name) name,
    SLIDEWAY_SERIES(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
    count
};

struct SeriesInfo {
    char const* name;
    char const* unit;
    char const* long_name;
};

inline constexpr SeriesInfo series_table[] = {
#define SLIDEWAY_ROW(name, unit, long_name) {#name, unit, long_name},
    SLIDEWAY_SERIES(SLIDEWAY_ROW)
#undef SLIDEWAY_ROW
};
inline constexpr int series_count = static_cast<int>(Series::count);
/// From here on series are of forces, which reports tell where they are asked for (JointForces).
inline constexpr int first_force_series = static_cast<int>(Series::face_force_y_plus);

/// A set of quantities or series: bit i for entry i of the table, then those of the mechanism's own signals.
using Selection = std::uint64_t;
inline constexpr int selection_bits = 64;
constexpr bool selects(Selection set, Quantity q) { return (set >> static_cast<int>(q)) & 1u; }
constexpr Selection selection_of(Quantity q) { return Selection{1} << static_cast<int>(q); }
constexpr Selection selection_of(Series s) { return Selection{1} << static_cast<int>(s); }
constexpr bool selects(Selection set, Series s) { return (set >> static_cast<int>(s)) & 1u; }
inline constexpr Selection force_series = (Selection{1} << series_count) - (Selection{1} << first_force_series);

/// The quantities whose row in the table is as the function asks.
template <class Function> constexpr Selection quantities_where(Function const& is_so) {
    Selection set = 0;
    for (int i = 0; i < quantity_count; ++i) {
        if (is_so(quantity_table[i])) set |= selection_of(static_cast<Quantity>(i));
    }
    return set;
}

/// First column of a quantity in a member's row of all quantities, which is `quantity_columns` wide.
constexpr int quantity_column(Quantity q) {
    int column = 0;
    for (int i = 0; i < static_cast<int>(q); ++i) column += quantity_table[i].columns;
    return column;
}
inline constexpr int quantity_columns = quantity_column(Quantity::count);

}  // namespace slideway
