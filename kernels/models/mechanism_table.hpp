#pragma once

#include "kernels/joint/apex.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/told_forces.hpp"
#include "kernels/models/mechanism_model.hpp"
#include "kernels/observers/force_record.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The equations of a mechanism behind pointers.  A call costs what a call costs; the derivative is a function of its own in any case.
/// @tparam Signals OwnSignals, or NoSignals
template <class Real, class Base, class Signals> struct MechanismFunctions {
    using Block = Conditions<LawFunctions<Real>>;
    using Parameters = typename Base::template Parameters<Real>;
    using Memory = typename LanesOf<Base>::template Memory<Real>;
    using Report = typename SignalLanes<Base, Signals>::template Report<Real>;
    using Derivative = Faults<Real>(Real, Real const*, Parameters const&, Memory const&, Block const&, Real*, Report*);

    typename Base::template Parameters<double> (*parameters)(Inputs const&) = nullptr;
    StateFunctions<typename Base::template Parameters<double>> state;
    Derivative* lean[extras_count] = {};  // by what a block has
    Derivative* full[extras_count] = {};
    void (*forces)(Real, Real const*, Real const*, Parameters const&, Block const&, SliderReport<Real> const&, JointForces<Real>&) = nullptr;
    Real (*gap)(Real, Real const*, Parameters const&, Block const&, Apex) = nullptr;
    // Of mechanisms with a linearisation and contact patterns.
    void (*linearise)(Real, Real const*, Parameters const&, Memory const&, Block const&, SliderLinearisation<Real>&) = nullptr;
    Real (*contact_pattern)(Real, Real const*, Parameters const&, Block const&) = nullptr;
    Real (*approach_speed)(Real, Real const*, Real, Real const*, Parameters const&, Block const&) = nullptr;
    Translation<Real> (*way_bend)(Real, Real, Real const*, Parameters const&, DrivePlan const&) = nullptr;

    template <class Mechanism> static constexpr MechanismFunctions of() {
        static_assert(finds_state<Mechanism, Base>(), SLIDEWAY_STATE_NOT_FOUND);
        using Laws = LawFunctions<Real>;
        MechanismFunctions functions;
        functions.parameters = &Mechanism::parameters;
        functions.state = StateFunctions<typename Base::template Parameters<double>>::template of<Mechanism>();
        put_derivatives<Mechanism, Extras::nothing>(functions);
        put_derivatives<Mechanism, Extras::loads>(functions);
        put_derivatives<Mechanism, Extras::profile>(functions);
        if constexpr (LanesOf<Base>::tells_forces) functions.forces = &slideway::tell_forces<Mechanism, Real, Laws, Parameters>;
        functions.gap = &Mechanism::template gap<Real, Laws>;
        if constexpr (LanesOf<Base>::has_linearisation) {
            functions.linearise = &Mechanism::template linearise<Real, Laws>;
            functions.contact_pattern = &Mechanism::template contact_pattern<Real, Laws>;
            functions.approach_speed = &Mechanism::template approach_speed<Real, Laws>;
            functions.way_bend = &Mechanism::template way_bend<Real>;
        }
        return functions;
    }

private:
    template <class Mechanism, Extras has> static constexpr void put_derivatives(MechanismFunctions& functions) {
        using Laws = LawFunctions<Real>;
        auto& lean = functions.lean[static_cast<int>(has)];
        auto& full = functions.full[static_cast<int>(has)];
        if constexpr (Signals::count > 0) {
            lean = &derivative_of<Mechanism, false, Real, Laws, Parameters, Memory, Report>;
            full = &derivative_of<Mechanism, true, Real, Laws, Parameters, Memory, Report>;
        } else if constexpr (requires { &Mechanism::template derivative_with<false, has, Real, Laws>; }) {
            lean = &Mechanism::template derivative_with<false, has, Real, Laws>;
            full = &Mechanism::template derivative_with<true, has, Real, Laws>;
        } else {
            lean = &Mechanism::template derivative<false, Real, Laws>;
            full = &Mechanism::template derivative<true, Real, Laws>;
        }
    }
};

/// The reports of lanes that tell forces, where their base has any.
template <class Base, class Signals, bool tells_forces = LanesOf<Base>::tells_forces> struct ForceLanes : SignalLanes<Base, Signals> {
    template <class Real> using Report = ForceReport<Real, typename SignalLanes<Base, Signals>::template Report<Real>>;
    template <class Real> using Forces = ForceRecord<Real>;
};
template <class Base, class Signals> struct ForceLanes<Base, Signals, false> : SignalLanes<Base, Signals> {};

/// A mechanism whose equations are looked up: the lanes are compiled once for all mechanisms of a base that have no signals of their own.
template <class Real, class Base, class Signals = NoSignals>
struct MechanismTable : Base, ForceLanes<Base, Signals>, ConditionsOfBlock<LawFunctions<Real>> {
    using Functions = MechanismFunctions<Real, Base, Signals>;
    template <class Number> using Parameters = typename Base::template Parameters<Number>;
    template <class Number> using Memory = typename LanesOf<Base>::template Memory<Number>;
    template <class Number> using Report = typename ForceLanes<Base, Signals>::template Report<Number>;

    static constexpr int size = Base::room;
    Functions functions;
    typename Functions::Derivative *lean, *full;

    constexpr MechanismTable(Functions const& of_mechanism, Conditions<LawFunctions<Real>> const& conditions)
        : ConditionsOfBlock<LawFunctions<Real>>{{}, conditions}, functions(of_mechanism),
          lean(functions.lean[static_cast<int>(conditions.extras())]), full(functions.full[static_cast<int>(conditions.extras())]) {}

    int states() const requires(Base::size != size) { return functions.state.count; }
    Parameters<double> parameters(Inputs const& inputs) const { return functions.parameters(inputs); }
    void scales(Parameters<double> const& p, double* scale) const { functions.state.scales(p, scale); }
    void initial_state(Inputs const& inputs, double* state) const { functions.state.start(inputs, state); }
    int state_of_series(int series) const { return functions.state.of_series(series); }
    template <bool Full>
    Faults<Real> derivative(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                            Real* rates, Report<Real>* report) const {
        if constexpr (!Full || !LanesOf<Base>::tells_forces) {
            return (Full ? full : lean)(t, state, p, memory, this->block, rates, report);
        } else {
            auto const faults = full(t, state, p, memory, this->block, rates, report);
            if (this->block.tells_forces && !this->block.powers_alone) functions.forces(t, state, rates, p, this->block, *report, report->forces);
            return faults;
        }
    }
    template <class Linearisation>
    void linearise(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                   Linearisation& out) const {
        functions.linearise(t, state, p, memory, this->block, out);
    }
    Real contact_pattern(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory) const {
        if (this->block.by_clocks) return HeldFace<Real>::pattern(memory);
        return functions.contact_pattern(t, state, p, this->block);
    }
    void bend(Real t, Real step, Real const* state, Parameters<Real> const& p, Real* of_state) const {
        if (!this->block.misaligned_way) return;
        auto const way = functions.way_bend(t, step, state, p, this->block.drive);
        of_state[0] = way.y, of_state[1] = way.z;
    }
    Real gap(Real t, Real const* state, Parameters<Real> const& p, bool z_faces, int apex) const {
        return functions.gap(t, state, p, this->block, {z_faces, apex});
    }
    Real approach_speed(Real t, Real const* state, Real step, Real const* end, Parameters<Real> const& p) const {
        return functions.approach_speed(t, state, step, end, p, this->block);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
