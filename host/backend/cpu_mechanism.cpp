// The equations of a mechanism: compiled once per instruction set for all laws, frictions and ways (CMakeLists.txt here).  The header of a
// mechanism of one's own says itself what it has: `#define SLIDEWAY_MECHANISM OwnCrank`, and `#define SLIDEWAY_BASE OwnBase` where it is not SliderBase.
#include "host/backend/cpu_lanes.hpp"
#include "host/backend/kernel_tables.hpp"
#include "kernels/laws/law_table.hpp"
#include "kernels/models/planar_lanes.hpp"
#include SLIDEWAY_HEADER
#ifndef SLIDEWAY_BASE
#define SLIDEWAY_BASE SliderBase
#endif

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Mechanism> concept HasInfo = requires { MechanismInfo{Mechanism::info}; };

template <class Mechanism, class Base> struct Compiled {
    static constexpr auto functions = MechanismFunctions<IsaReal, Base>::template of<Mechanism>();
    static constexpr bool has_exponents = Mechanism::info.has_exponents;

    /// @param kernels of a law that has the damping
    static IsaTable<Base> table_of(Parts const& parts, LawKernels const* kernels) {
        auto const& law = *static_cast<LawTable<IsaReal> const*>(kernels->table);
        return {functions, {law.with[static_cast<int>(parts.damping)], law.switches, parts}};
    }
    static void run(Block& block, Parts const& parts, LawKernels const* law) { run_lanes<Base>(block, table_of(parts, law)); }
    static void run_shadowed(Block& block, Parts const& parts, LawKernels const* law) {
        if constexpr (has_exponents) run_shadowed_lanes<Base>(block, table_of(parts, law));
    }
    static void probe(ProbeTable const& states, Parts const& parts, LawKernels const* law) { probe_states<Base>(states, table_of(parts, law)); }

    static constexpr MechanismKernels kernels{&Mechanism::info, &run, has_exponents ? &run_shadowed : nullptr, &probe};
};

/// What its info lacks is one line of the compiler's, and nothing follows from it.
template <class Mechanism, class Base> consteval MechanismKernels kernels_of() {
    static_assert(HasInfo<Mechanism>, "the mechanism has no `static constexpr MechanismInfo info` (kernels/mechanisms/mechanism_info.hpp)");
    if constexpr (HasInfo<Mechanism>) {
        static_assert(Mechanism::info.name != nullptr && Mechanism::info.meaning != nullptr, "the mechanism's info says no name, or no meaning");
        static_assert(Mechanism::info.states <= most_states, "a mechanism has at most twelve states");
        static_assert(Mechanism::info.own_keys.size() <= 8, "a mechanism has at most eight numbers of its own, mechanism_a to mechanism_h");
        return Compiled<Mechanism, Base>::kernels;
    }
    return {};
}

}  // namespace

extern constinit MechanismKernels const SLIDEWAY_TABLE = kernels_of<SLIDEWAY_MECHANISM, SLIDEWAY_BASE>();

}  // namespace slideway::inline SLIDEWAY_ISA
