// The lanes, compiled once per instruction set and kind of memory, and the laws that share them.  Nothing from the host is included,
// so that no unit shares code with one of another instruction set.
#pragma once

#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/slider_crank_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <template <class> class Memory> using IsaTable = SliderCrankTable<IsaReal, Memory>;

#define SLIDEWAY_LANES_OF(memory, keyword)                                                       \
    keyword template void integrate<IsaTable<memory>, IsaReal>(Block&, IsaTable<memory> const&); \
    keyword template void probe<IsaTable<memory>, IsaReal>(ProbeTable const&, IsaTable<memory> const&);

SLIDEWAY_LANES_OF(NoMemory, extern)
SLIDEWAY_LANES_OF(HeldContacts, extern)
SLIDEWAY_LANES_OF(ImpactMemory, extern)

}  // namespace slideway::inline SLIDEWAY_ISA
