// The lanes of one instruction set, compiled once per base of mechanisms, for members without shadows and with them.  Nothing from the
// host is included, so that no unit shares code with one of another instruction set.
#pragma once

#include "kernels/isa_real.hpp"
#include "kernels/block.hpp"
#include "kernels/models/mechanism_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// @tparam Signals of a mechanism that has its own, and so lanes of its own
template <class Base, class Signals> using IsaTable = MechanismTable<IsaReal, Base, Signals>;

template <class Base, class Signals> void run_lanes(Block& block, IsaTable<Base, Signals> const& table);
template <class Base, class Signals> void run_shadowed_lanes(Block& block, IsaTable<Base, Signals> const& table);
template <class Base, class Signals> void probe_states(ProbeTable const& states, IsaTable<Base, Signals> const& table);

}  // namespace slideway::inline SLIDEWAY_ISA
