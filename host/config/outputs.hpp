// What may be asked of the members of a mechanism: the quantities and series of the tables, and behind them those of its signals.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/observers/quantities.hpp"

namespace slideway {

/// A quantity, where a member's row of all quantities has it, and what the kernels are asked for to have it there.
struct OutputQuantity : QuantityInfo {
    std::size_t place;
    Selection kept_with;
};

/// Entry i of a list is bit i of a Selection.
struct Outputs {
    std::vector<OutputQuantity> quantities;
    std::vector<SeriesInfo> series;
    Selection has_quantities = 0, has_series = 0;  // those that the mechanism has
    std::size_t columns = 0;                       // of a member's row of all quantities
    std::deque<std::string> texts = {};            // names and words of what no table has
};

Outputs const& outputs_of(Mechanism mechanism);
/// What kernels are asked for to have all of a set.
Selection kept_for(Outputs const& outputs, Selection quantities);
/// Quantities of the joints with clearance of a linkage: peak_force_<joint>, mean_force_<joint>.
std::string name_of_joint_quantity(Quantity of_apices, std::string_view joint);
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

// What earlier versions called quantities: scenes may, and results of the formats of then do.

struct FormerName {
    std::string_view then, now;
};
/// No key, series, signal or column of a result has a name of then.
inline constexpr FormerName former_names[] = {{"crank_work", "drive_work"}};  // in results of formats 1 and 2

/// A name of then as it is now; any other as it is.
constexpr std::string_view name_of_now(std::string_view name) {
    auto const* const found = std::ranges::find(former_names, name, &FormerName::then);
    return found == std::end(former_names) ? name : found->now;
}

/// A text with the names in it as they are now: "yield of crank_work [1]".
inline std::string words_of_now(std::string_view text) {
    constexpr std::string_view of_names = "abcdefghijklmnopqrstuvwxyz0123456789_";
    std::string words;
    while (!text.empty()) {
        auto const length = std::min(text.find_first_not_of(of_names), text.size());
        words += name_of_now(text.substr(0, length));
        text.remove_prefix(length);
        auto const between = std::min(text.find_first_of(of_names), text.size());
        words += text.substr(0, between);
        text.remove_prefix(between);
    }
    return words;
}

}  // namespace slideway
