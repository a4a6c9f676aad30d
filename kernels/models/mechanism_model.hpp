#pragma once

#include <type_traits>

#include "kernels/conditions.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/models/slider_lanes.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What lanes ask of the conditions of a block.
template <class Laws> struct ConditionsOfBlock : ModelDefaults {
    Conditions<Laws> block;

    SLIDEWAY_HD bool switches() const { return block.switches; }
    SLIDEWAY_HD bool has_loads() const { return block.loads.count > 0; }
    SLIDEWAY_HD bool has_film() const { return block.film; }
    SLIDEWAY_HD bool remembers() const { return block.remembers; }
    SLIDEWAY_HD void hold_contacts(Watching watching) {
        block.holds_contacts = holds_contacts(watching);
        block.by_clocks = watching == Watching::clocks;
    }
    SLIDEWAY_HD void tell_stages(bool /*inside*/, bool powers_alone) { block.powers_alone = powers_alone; }
    SLIDEWAY_HD void tell_forces(bool wanted) { block.tells_forces = wanted; }
    /// At which events of the contacts steps end.  @param neighbours members have some beside them
    SLIDEWAY_HD Watching watching(bool locate_modes, bool neighbours) const {
        if (block.remembers) return neighbours && block.switches ? Watching::touches_and_parts : Watching::touches;
        if (block.law.ends_steps() || (block.can_locate_modes() && locate_modes)) return Watching::modes;
        return block.continuous ? Watching::gaps : Watching::nothing;
    }
};

/// Whether a mechanism finds the components of its state among the series, where its info says that they are, and has the state of the lanes' base.
template <class Mechanism, class Base> constexpr bool finds_state() {
    if constexpr (std::is_base_of_v<Base, Mechanism> && requires { Mechanism::state_of_series(0); }) {
        auto const& info = Mechanism::info;
        for (int i = 0; i < info.states; ++i) {
            if (Mechanism::state_of_series(static_cast<int>(info.state[i])) != i) return false;
        }
        return info.states == Mechanism::size && Mechanism::size <= Base::room;
    }
    return false;
}

#define SLIDEWAY_STATE_NOT_FOUND \
    "the base's state_of_series(series) does not say of each component of the mechanism's info.state where it is in the base's state"

/// The derivative of a mechanism, with all that the lanes' report tells if Full: also its signals, where a report is more than powers.
template <class Mechanism, bool Full, class Real, class Laws, class Parameters, class Memory, class Report>
SLIDEWAY_FN Faults<Real> derivative_of(Real t, Real const* state, Parameters const& p, Memory const& memory, Conditions<Laws> const& block,
                                       Real* rates, Report* report) {
    auto const faults = Mechanism::template derivative<Full, Real, Laws>(t, state, p, memory, block, rates, report);
    if constexpr (Full && SignalsOf<Mechanism>::count > 0) {
        if (!block.powers_alone) Mechanism::put_signals(t, state, p, *report, report->signal);
    }
    return faults;
}

/// A mechanism as the lanes integrate it, whose equations are known when the lanes are compiled: every call names its function.
/// @tparam Base of the mechanism's row in mechanisms/list.hpp  @tparam Laws OneLaw or AnyLaw
template <class Mechanism, class Base, class Laws> struct MechanismModel : Mechanism, SignalLanes<Base, SignalsOf<Mechanism>>, ConditionsOfBlock<Laws> {
    using Lanes = SignalLanes<Base, SignalsOf<Mechanism>>;
    static_assert(finds_state<Mechanism, Base>(), SLIDEWAY_STATE_NOT_FOUND);
    template <class Real> using Parameters = typename Mechanism::template Parameters<Real>;
    template <class Real> using Memory = typename LanesOf<Base>::template Memory<Real>;
    template <class Real> using Report = typename Lanes::template Report<Real>;

    explicit constexpr MechanismModel(Conditions<Laws> const& conditions) : ConditionsOfBlock<Laws>{{}, conditions} {}

    template <bool Full, class Real>
    SLIDEWAY_FN Faults<Real> derivative(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                                        Real* rates, Report<Real>* report) const {
        return derivative_of<Mechanism, Full>(t, state, p, memory, this->block, rates, report);
    }
    template <class Real, class Linearisation>
    SLIDEWAY_FN void linearise(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                               Linearisation& out) const {
        Mechanism::linearise(t, state, p, memory, this->block, out);
    }
    template <class Real> SLIDEWAY_FN Real contact_pattern(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory) const {
        if (this->block.by_clocks) return HeldFace<Real>::pattern(memory);
        return Mechanism::contact_pattern(t, state, p, this->block);
    }
    /// Acceleration of the equilibrium that steps of the stiff method are to follow, of each component of the state that is a place; 0 of others.
    template <class Real> SLIDEWAY_FN void bend(Real t, Real step, Real const* state, Parameters<Real> const& p, Real* of_state) const {
        if (!this->block.misaligned_way) return;
        auto const way = Mechanism::way_bend(t, step, state, p, this->block.drive);
        of_state[0] = way.y, of_state[1] = way.z;
    }
    template <class Real>
    SLIDEWAY_FN Real gap(Real t, Real const* state, Parameters<Real> const& p, bool z_faces, int apex) const {
        return Mechanism::gap(t, state, p, this->block, {z_faces, apex});
    }
    template <class Real>
    SLIDEWAY_FN Real approach_speed(Real t, Real const* state, Real step, Real const* end, Parameters<Real> const& p) const {
        return Mechanism::approach_speed(t, state, step, end, p, this->block);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
