// The lanes of one instruction set, compiled once per base of mechanisms, for members without shadows and with them.  Nothing from the
// host is included, so that no unit shares code with one of another instruction set.
#pragma once

#include "kernels/isa_real.hpp"
#include "kernels/block.hpp"
#include "kernels/models/mechanism_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Base> using IsaTable = MechanismTable<IsaReal, Base>;

template <class Base> void run_lanes(Block& block, IsaTable<Base> const& table);
template <class Base> void run_shadowed_lanes(Block& block, IsaTable<Base> const& table);
template <class Base> void probe_states(ProbeTable const& states, IsaTable<Base> const& table);

}  // namespace slideway::inline SLIDEWAY_ISA
