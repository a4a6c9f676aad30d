// The lanes, compiled once per instruction set, kind of memory and whether the law keeps energy, and the laws that share them.  Nothing from the host is included,
// so that no unit shares code with one of another instruction set.
#pragma once

#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/slider_crank_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <template <class> class Memory, bool conserving>
using IsaTable = SliderCrankTable<IsaReal, Memory, conserving>;

#define SLIDEWAY_LANES_OF(memory, conserving, keyword)                                                           \
    keyword template void integrate<IsaTable<memory, conserving>, IsaReal>(Block&,                               \
                                                                           IsaTable<memory, conserving> const&); \
    keyword template void probe<IsaTable<memory, conserving>, IsaReal>(ProbeTable const&,                        \
                                                                       IsaTable<memory, conserving> const&);

SLIDEWAY_LANES_OF(NoMemory, true, extern)
SLIDEWAY_LANES_OF(HeldContacts, false, extern)
SLIDEWAY_LANES_OF(ImpactMemory, true, extern)
SLIDEWAY_LANES_OF(ImpactMemory, false, extern)

}  // namespace slideway::inline SLIDEWAY_ISA
