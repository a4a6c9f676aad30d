#pragma once

#include <type_traits>

#include "kernels/mechanisms/faults.hpp"
#include "kernels/models/slider_lanes.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A mechanism whose equations are looked up in a table of functions: the lanes are then compiled once for all mechanisms of as many
/// states, laws, frictions, ways and dampings that leave the same memory and books of energy.  A call costs what a call costs; the
/// derivative is a function of its own in any case.
/// @tparam Base SliderBase, for all of ten states, or FreeSliderBase
template <class Real, class Base, template <class> class Memory_, bool conserving>
struct SliderTable : Base, SliderLanes<conserving> {
    template <class Number> using Memory = Memory_<Number>;
    template <class Number> using Watch = typename SliderWatch<Memory<Number>, false>::Type;
    template <class Number> using ShadowWatch = typename SliderWatch<Memory<Number>, !conserving>::Type;
    template <class Number> using Parameters = typename Base::template Parameters<Number>;
    template <class Number> using Linearisation = typename Base::template Linearisation<Number>;
    template <class Number> using Report = typename Base::template Report<Number>;
    static constexpr bool has_memory = std::is_same_v<Memory<Real>, ImpactMemory<Real>>;
    static constexpr bool can_hold = std::is_same_v<Memory<Real>, HeldContacts<Real>>;

    using Derivative = Faults<Real>(Real, Real const*, Parameters<Real> const&, Memory<Real> const&, Real*,
                                    Report<Real>*);

    Parameters<double> (*parameters_of)(Inputs const&);
    Derivative* lean;
    Derivative* full;
    void (*linearisation)(Real, Real const*, Parameters<Real> const&, Memory<Real> const&, SliderLinearisation<Real>&);
    Real (*pattern)(Real, Real const*, Parameters<Real> const&);
    Real (*approach)(Real, Real const*, Real, Real const*, Parameters<Real> const&);
    Real (*apex_gap)(Real, Real const*, Parameters<Real> const&, bool, int);

    /// The table of one `SliderModel`.
    template <class Model> static constexpr SliderTable of() {
        static_assert(Model::size == Base::size);
        SliderTable table{};
        table.parameters_of = &Model::parameters;
        table.lean = &Model::template derivative<false, Real>;
        table.full = &Model::template derivative<true, Real>;
        table.linearisation = &Model::template linearise<Real>;
        table.pattern = &Model::template contact_pattern<Real>;
        table.approach = &Model::template approach_speed<Real>;
        table.apex_gap = &Model::template gap<Real>;
        return table;
    }

    Parameters<double> parameters(Inputs const& inputs) const { return parameters_of(inputs); }
    template <bool Full>
    Faults<Real> derivative(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                            Real* rates, Report<Real>* report) const {
        return (Full ? full : lean)(t, state, p, memory, rates, report);
    }
    void linearise(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                   Linearisation<Real>& out) const {
        linearisation(t, state, p, memory, out);
    }
    Real contact_pattern(Real t, Real const* state, Parameters<Real> const& p) const { return pattern(t, state, p); }
    Real gap(Real t, Real const* state, Parameters<Real> const& p, bool z_faces, int apex) const {
        return apex_gap(t, state, p, z_faces, apex);
    }
    Real approach_speed(Real t, Real const* state, Real step, Real const* end, Parameters<Real> const& p) const {
        return approach(t, state, step, end, p);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
