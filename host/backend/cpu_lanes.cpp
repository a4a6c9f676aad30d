// The lanes of one instruction set for the mechanisms of a base: members without shadows, or with them.
#include "host/backend/cpu_lanes.hpp"

#include "kernels/integrate.hpp"
#include "kernels/models/probe.hpp"
#include "kernels/models/planar_lanes.hpp"
#include "kernels/models/shadowed.hpp"
#ifdef SLIDEWAY_HEADER
#include SLIDEWAY_HEADER  // a mechanism of one's own, whose base it may bring
#endif
#ifndef SLIDEWAY_BASE
#define SLIDEWAY_BASE SliderBase
#endif

namespace slideway::inline SLIDEWAY_ISA {

#ifdef SLIDEWAY_MECHANISM
constexpr bool has_exponents = SLIDEWAY_MECHANISM::info.has_exponents;
using UnitSignals = SignalsOf<SLIDEWAY_MECHANISM>;
#else
constexpr bool has_exponents = true;
using UnitSignals = NoSignals;
#endif

#if SLIDEWAY_SHADOWED
template <class Base, class Signals> void run_shadowed_lanes(Block& block, IsaTable<Base, Signals> const& table) {
    if constexpr (has_exponents) {
        using Table = Shadowed<IsaTable<Base, Signals>>;
        integrate<Table, IsaReal>(block, Table{table});
    }
}
template void run_shadowed_lanes(Block&, IsaTable<SLIDEWAY_BASE, UnitSignals> const&);
#else
template <class Base, class Signals> void run_lanes(Block& block, IsaTable<Base, Signals> const& table) {
    integrate<IsaTable<Base, Signals>, IsaReal>(block, table);
}
template <class Base, class Signals> void probe_states(ProbeTable const& states, IsaTable<Base, Signals> const& table) {
    probe<IsaTable<Base, Signals>, IsaReal>(states, table);
}
template void run_lanes(Block&, IsaTable<SLIDEWAY_BASE, UnitSignals> const&);
template void probe_states(ProbeTable const&, IsaTable<SLIDEWAY_BASE, UnitSignals> const&);
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
