#pragma once

#include <string_view>
#include <utility>

#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <Quantity> struct Named {};
/// Calls the function with Named<q> for each quantity q of the table.
template <class Function> SLIDEWAY_FN void for_each_quantity(Function const& function) {
    [&]<int... i>(std::integer_sequence<int, i...>) {
        (function(Named<static_cast<Quantity>(i)>{}), ...);
    }(std::make_integer_sequence<int, quantity_count>{});
}

/// Where a keeper has its quantities: peaks in one array, integrals in another, the audited ones first.  All of it is for constants: device
/// code has no table.
/// @tparam apices of the mechanism's report: as many columns has a quantity of the apices
template <Keeper keeper, int apices> struct QuantityPlaces {
    static constexpr QuantityInfo const& info(Quantity q) { return quantity_table[static_cast<int>(q)]; }
    static constexpr int columns(Quantity q) {
        auto const* const along = info(q).dimension;
        return along != nullptr && std::string_view(along) == "apex" ? apices : info(q).columns;
    }
    static constexpr bool keeps(Quantity q) { return info(q).keeper == keeper && columns(q) > 0; }
    static constexpr bool is_peak(Quantity q) { return keeps(q) && info(q).statistic == Statistic::peak; }
    static constexpr bool is_audited(Quantity q) { return keeps(q) && info(q).is_audited(); }
    static constexpr bool integrates(Quantity q) { return keeps(q) && info(q).integrates(); }

private:
    static constexpr bool is_plain(Quantity q) { return integrates(q) && !is_audited(q); }
    /// Columns of the quantities before one that are so.
    template <class Is> static constexpr int before(Quantity end, Is const& is_so) {
        int sum = 0;
        for (int i = 0; i < static_cast<int>(end); ++i) {
            auto const q = static_cast<Quantity>(i);
            sum += is_so(q) ? columns(q) : 0;
        }
        return sum;
    }

public:
    static constexpr int peaks = before(Quantity::count, is_peak);
    static constexpr int audit_integrals = before(Quantity::count, is_audited);
    static constexpr int integrals = audit_integrals + before(Quantity::count, is_plain);
    /// Where those of a quantity begin.
    template <Quantity q> static constexpr int peak_of = before(q, is_peak);
    template <Quantity q>
    static constexpr int integral_of =
        is_audited(q) ? before(q, is_audited) : audit_integrals + before(q, is_plain);
};

}  // namespace slideway::inline SLIDEWAY_ISA
