// The laws of the list in a unit of its own, as the kernels take them: compiled in tables, or one type that knows them all.
#pragma once

#include "kernels/all_laws.hpp"
#include "kernels/conditions.hpp"
#include "kernels/laws/law_table.hpp"
#include "kernels/laws/one_law.hpp"

namespace slideway::testing {
inline namespace SLIDEWAY_ISA {

template <class, class... Laws> struct LawsOfList {
    using Any = AnyLaw<Laws...>;
    static constexpr bool switches[] = {Laws::info.switches...};
};
#define SLIDEWAY_TYPE(name, Type) , Type
using EveryLaw = LawsOfList<void SLIDEWAY_LAWS(SLIDEWAY_TYPE)>;
#undef SLIDEWAY_TYPE

/// The conditions of a block, its law behind pointers as in the program.
template <class Real> Conditions<LawFunctions<Real>> conditions_of(Parts const& parts) {
#define SLIDEWAY_ROW(name, Type) LawTable<Real>::template of<Type>(),
    static constexpr LawTable<Real> tables[] = {SLIDEWAY_LAWS(SLIDEWAY_ROW)};
#undef SLIDEWAY_ROW
    auto const& table = tables[static_cast<int>(parts.law)];
    return {table.with[static_cast<int>(parts.damping)], table.switches, parts};
}

/// The same with the law chosen by its number among all of them, as on a card.
inline Conditions<EveryLaw::Any> chosen_conditions_of(Parts const& parts) {
    return {{parts.law, parts.damping}, EveryLaw::switches[static_cast<int>(parts.law)], parts};
}

}  // namespace SLIDEWAY_ISA
}  // namespace slideway::testing
