// The lanes, compiled once per instruction set, number of states, kind of memory, whether the law keeps energy and whether members have
// shadows, and the mechanisms and laws that share them.  Nothing from the host is included, so that no unit shares code with one of another
// instruction set.
#pragma once

#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/models/slider_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Base, template <class> class Memory, bool conserving>
using IsaTable = SliderTable<IsaReal, Base, Memory, conserving>;

#define SLIDEWAY_plain_LANES_OF(base, memory, conserving, keyword)                \
    keyword template void integrate<IsaTable<base, memory, conserving>, IsaReal>( \
        Block&, IsaTable<base, memory, conserving> const&);                       \
    keyword template void probe<IsaTable<base, memory, conserving>, IsaReal>(     \
        ProbeTable const&, IsaTable<base, memory, conserving> const&);
#define SLIDEWAY_shadowed_LANES_OF(base, memory, conserving, keyword)                       \
    keyword template void integrate<Shadowed<IsaTable<base, memory, conserving>>, IsaReal>( \
        Block&, Shadowed<IsaTable<base, memory, conserving>> const&);
#define SLIDEWAY_LANES_ELSEWHERE(memory, conserving)                                            \
    SLIDEWAY_plain_LANES_OF(SliderBase, memory, conserving, extern) SLIDEWAY_shadowed_LANES_OF( \
        SliderBase, memory, conserving, extern) SLIDEWAY_plain_LANES_OF(FreeSliderBase, memory, conserving, extern)

SLIDEWAY_LANES_ELSEWHERE(NoMemory, true)
SLIDEWAY_LANES_ELSEWHERE(HeldContacts, false)
SLIDEWAY_LANES_ELSEWHERE(ImpactMemory, true)
SLIDEWAY_LANES_ELSEWHERE(ImpactMemory, false)

}  // namespace slideway::inline SLIDEWAY_ISA
