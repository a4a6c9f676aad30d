// The laws of the list, compiled in a unit of its own.
#pragma once

#include "kernels/all_laws.hpp"
#include "kernels/conditions.hpp"
#include "kernels/laws/law_table.hpp"
#include "kernels/laws/list.hpp"

namespace slideway::testing {
inline namespace SLIDEWAY_ISA {

/// The conditions of a block, its law behind pointers as in the program.
template <class Real> Conditions<LawFunctions<Real>> conditions_of(Parts const& parts) {
#define SLIDEWAY_ROW(name, Type) LawTable<Real>::template of<Type>(),
    static constexpr LawTable<Real> tables[] = {SLIDEWAY_LAWS(SLIDEWAY_ROW)};
#undef SLIDEWAY_ROW
    auto const& table = tables[static_cast<int>(parts.law)];
    return {table.with[static_cast<int>(parts.damping)], table.switches, parts};
}

}  // namespace SLIDEWAY_ISA
}  // namespace slideway::testing
