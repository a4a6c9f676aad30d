// The compiled laws of one instruction set.
#pragma once

#include "kernels/isa_real.hpp"
#include "kernels/inputs.hpp"
#include "kernels/laws/law_table.hpp"

namespace slideway::inline SLIDEWAY_ISA {

#define SLIDEWAY_DECLARED(name, Type) extern LawTable<IsaReal> const name##_law;
SLIDEWAY_LAWS(SLIDEWAY_DECLARED)
#undef SLIDEWAY_DECLARED

/// One of them.
inline LawTable<IsaReal> const& law_table(Law law) {
#define SLIDEWAY_ADDRESS(name, Type) &name##_law,
    static constexpr LawTable<IsaReal> const* tables[] = {SLIDEWAY_LAWS(SLIDEWAY_ADDRESS)};
#undef SLIDEWAY_ADDRESS
    return *tables[static_cast<int>(law)];
}

}  // namespace slideway::inline SLIDEWAY_ISA
