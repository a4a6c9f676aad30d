// What may be asked of the members of a mechanism: the quantities and series of the tables, and behind them those of its signals.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/observers/quantities.hpp"

namespace slideway {

/// A quantity, and where a member's row of all quantities has it.
struct OutputQuantity : QuantityInfo { std::size_t place; };

/// Entry i of a list is bit i of a Selection.
struct Outputs {
    std::vector<OutputQuantity> quantities;
    std::vector<SeriesInfo> series;
    Selection has_quantities = 0, has_series = 0;  // those that the mechanism has
    std::size_t columns = 0;                       // of a member's row of all quantities
    std::deque<std::string> texts = {};            // names and words of what no table has
};

Outputs const& outputs_of(Mechanism mechanism);
/// Why scenes and results cannot name the signals of a mechanism that a module brings; "" where they can.
std::string objection_to_signals(MechanismInfo const& mechanism);

/// The entries that a set selects, in their order.
template <class Entries> auto selected(Entries const& entries, Selection set) {
    std::vector<typename Entries::value_type> list;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if ((set >> i & 1u) != 0) list.push_back(entries[i]);
    }
    return list;
}

}  // namespace slideway
