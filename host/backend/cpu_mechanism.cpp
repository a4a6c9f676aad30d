// The equations of a mechanism: compiled once per instruction set for all laws, frictions and ways (CMakeLists.txt here).  The header of a
// mechanism of one's own says itself what it has: `#define SLIDEWAY_MECHANISM OwnCrank`, and `#define SLIDEWAY_BASE OwnBase` where it is not SliderBase.
#include "host/backend/cpu_lanes.hpp"
#include "host/backend/kernel_tables.hpp"
#ifdef SLIDEWAY_JOINT_IS_SHARED
#include "host/backend/shared_joint.hpp"
#endif
#include "kernels/laws/law_table.hpp"
#include "kernels/models/planar_lanes.hpp"
#include SLIDEWAY_HEADER
#ifndef SLIDEWAY_BASE
#define SLIDEWAY_BASE SliderBase
#endif

namespace slideway::inline SLIDEWAY_ISA {
#ifdef SLIDEWAY_JOINT_IS_SHARED
SLIDEWAY_JOINT_TEMPLATES(extern)
#endif
namespace {

template <class Mechanism> concept HasInfo = requires { MechanismInfo{Mechanism::info}; };

template <class Mechanism, class Base>
concept TellsSignals = requires(IsaReal t, IsaReal const* state, typename Base::template Parameters<IsaReal> const& p,
                                typename Base::template Report<IsaReal> const& report, IsaReal* values) {
    Mechanism::put_signals(t, state, p, report, values);
};

template <class Base> concept HasLanes = requires { sizeof(LanesOf<Base>); };
template <class Mechanism> concept HasParameters = requires { &Mechanism::parameters; };
template <class Mechanism> concept HasDerivative = requires { &Mechanism::template derivative<false, IsaReal, LawFunctions<IsaReal>>; };
template <class Mechanism> concept HasGap = requires { &Mechanism::template gap<IsaReal, LawFunctions<IsaReal>>; };

template <class Mechanism, class Base> struct Compiled {
    using Signals = SignalsOf<Mechanism>;
    static constexpr auto functions = MechanismFunctions<IsaReal, Base, Signals>::template of<Mechanism>();
    static constexpr bool has_exponents = Mechanism::info.has_exponents;

    /// @param kernels of a law that has the damping
    static IsaTable<Base, Signals> table_of(Parts const& parts, LawKernels const* kernels) {
        auto const& law = *static_cast<LawTable<IsaReal> const*>(kernels->table);
        return {functions, {law.with[static_cast<int>(parts.damping)], law.switches, parts}};
    }
    static void run(Block& block, Parts const& parts, LawKernels const* law) { run_lanes<Base, Signals>(block, table_of(parts, law)); }
    static void run_shadowed(Block& block, Parts const& parts, LawKernels const* law) {
        if constexpr (has_exponents) run_shadowed_lanes<Base, Signals>(block, table_of(parts, law));
    }
    static void probe(ProbeTable const& states, Parts const& parts, LawKernels const* law) { probe_states<Base, Signals>(states, table_of(parts, law)); }

    static constexpr MechanismKernels kernels{&Mechanism::info, &run, has_exponents ? &run_shadowed : nullptr, &probe};
};

/// What its info lacks is one line of the compiler's, and nothing follows from it.
template <class Mechanism, class Base> consteval MechanismKernels kernels_of() {
    static_assert(HasInfo<Mechanism>, "the mechanism has no `static constexpr MechanismInfo info` (kernels/mechanisms/mechanism_info.hpp)");
    if constexpr (HasInfo<Mechanism>) {
        static_assert(Mechanism::info.name != nullptr && Mechanism::info.meaning != nullptr, "the mechanism's info says no name, or no meaning");
        static_assert(Mechanism::info.states <= most_states, "a mechanism has at most twelve states");
        static_assert(Mechanism::info.own_keys.size() <= most_own_numbers, "a mechanism has at most sixteen numbers of its own, mechanism_a to mechanism_p");
        constexpr auto& info = Mechanism::info;
        static_assert(info.signals.size() <= most_signals, "a mechanism has too many signals: a set of series has no bit for them");
        static_assert(signal_quantity_count(info.signals) <= most_signal_quantities,
                      "the signals have too many quantities; say which statistics each has: statistics_of(Statistic::maximum, …)");
        constexpr bool tells = info.signals.empty() || TellsSignals<Mechanism, Base>;
        static_assert(tells, "the mechanism's info has signals, and there is no put_signals(t, state, parameters, report, values) that tells them");
        constexpr bool has_lanes = HasLanes<Base>;
        static_assert(has_lanes, "nothing says how lanes treat SLIDEWAY_BASE: `template <> struct LanesOf<Base> : SpatialLanes<Base> {};`");
        static_assert(HasParameters<Mechanism>, "the mechanism has no `parameters(inputs)`");
        static_assert(HasDerivative<Mechanism>, "the mechanism has no `derivative<Full, Real, Law>(t, state, parameters, memory, conditions, rates, report)`: is it a SpatialSlider<Guide>?");
        static_assert(HasGap<Mechanism>, "the mechanism has no `gap<Real, Law>(t, state, parameters, conditions, apex)`: is it a SpatialSlider<Guide>?");
        if constexpr (tells && has_lanes && HasParameters<Mechanism> && HasDerivative<Mechanism> && HasGap<Mechanism>) return Compiled<Mechanism, Base>::kernels;
    }
    return {};
}

}  // namespace

extern constinit MechanismKernels const SLIDEWAY_TABLE = kernels_of<SLIDEWAY_MECHANISM, SLIDEWAY_BASE>();

}  // namespace slideway::inline SLIDEWAY_ISA
