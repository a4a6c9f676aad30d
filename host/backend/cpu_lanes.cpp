// The lanes of one instruction set for the mechanisms of a base: members without shadows, or with them.
#include "host/backend/cpu_lanes.hpp"

#include "kernels/integrate.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/planar_lanes.hpp"
#include "kernels/models/shadowed.hpp"
#ifdef SLIDEWAY_HEADER
#include SLIDEWAY_HEADER  // a mechanism of one's own, whose base it may bring
#endif
#ifndef SLIDEWAY_BASE
#define SLIDEWAY_BASE SliderBase
#endif

namespace slideway::inline SLIDEWAY_ISA {

#if SLIDEWAY_SHADOWED
#ifdef SLIDEWAY_MECHANISM
constexpr bool has_exponents = SLIDEWAY_MECHANISM::info.has_exponents;
#else
constexpr bool has_exponents = true;
#endif
template <class Base> void run_shadowed_lanes(Block& block, IsaTable<Base> const& table) {
    if constexpr (has_exponents) {
        using Table = Shadowed<IsaTable<Base>>;
        integrate<Table, IsaReal>(block, Table{table});
    }
}
template void run_shadowed_lanes(Block&, IsaTable<SLIDEWAY_BASE> const&);
#else
template <class Base> void run_lanes(Block& block, IsaTable<Base> const& table) {
    integrate<IsaTable<Base>, IsaReal>(block, table);
}
template <class Base> void probe_states(ProbeTable const& states, IsaTable<Base> const& table) {
    probe<IsaTable<Base>, IsaReal>(states, table);
}
template void run_lanes(Block&, IsaTable<SLIDEWAY_BASE> const&);
template void probe_states(ProbeTable const&, IsaTable<SLIDEWAY_BASE> const&);
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
