// What a mechanism tells of itself beyond the tables: signals, each a time series, with quantities of them.  Plain data outside the ISA
// namespace: every unit may share it.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>

#include "kernels/observers/quantities.hpp"

namespace slideway {

/// A set of statistics, a bit each.
using Statistics = unsigned;
template <class... Some> constexpr Statistics statistics_of(Some... some) { return (0u | ... | (1u << static_cast<int>(some))); }

/// Those that a signal may have, in the order of its quantities, and what these are called: prefix and signal.
struct SignalStatistic {
    Statistic statistic;
    char const* prefix;
    char const* words;
};
inline constexpr SignalStatistic signal_statistics[] = {
    {Statistic::maximum, "max_", "largest value at the accepted steps"},
    {Statistic::minimum, "min_", "least value at the accepted steps"},
    {Statistic::mean, "mean_", "time mean"},
    {Statistic::root_mean_square, "rms_", "root mean square over time"},
    {Statistic::at_end, "final_", "value at end_time"},
};
inline constexpr Statistics all_signal_statistics =
    statistics_of(Statistic::maximum, Statistic::minimum, Statistic::mean, Statistic::root_mean_square, Statistic::at_end);

/// A number that follows from a mechanism's state: a time series of this name, and the quantities max_…, min_…, mean_…, rms_… and final_….
struct Signal {
    char const* name;     // small letters, digits and '_'
    char const* unit;     // UDUNITS-2 syntax; "1" for a plain number
    char const* meaning;  // "torque of the motor"
    Statistics statistics = all_signal_statistics;  // which of its quantities may be asked for
};

/// A quantity of a signal.
struct SignalQuantity {
    int signal;           // its place among the mechanism's
    Statistic statistic;
    constexpr bool integrates() const { return statistic == Statistic::mean || statistic == Statistic::root_mean_square; }
};

/// Calls the function with each quantity of the signals, in their order.
template <class Function> constexpr void for_each_signal_quantity(std::span<Signal const> signals, Function const& see) {
    for (std::size_t i = 0; i < signals.size(); ++i) {
        for (SignalStatistic const& one : signal_statistics) {
            if ((signals[i].statistics & statistics_of(one.statistic)) != 0) see(SignalQuantity{static_cast<int>(i), one.statistic});
        }
    }
}
constexpr int signal_quantity_count(std::span<Signal const> signals) {
    int count = 0;
    for_each_signal_quantity(signals, [&](SignalQuantity const&) { ++count; });
    return count;
}

/// As many as a Selection has bits for.
inline constexpr int most_signals = selection_bits - series_count, most_signal_quantities = selection_bits - quantity_count;

}  // namespace slideway
