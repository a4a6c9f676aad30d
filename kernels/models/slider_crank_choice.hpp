#pragma once

#include "kernels/inputs.hpp"
#include "kernels/models/slider_crank_model.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One of several slider-cranks that leave the same memory and books of energy, chosen when the run begins: the lanes are compiled once
/// for all of them, as with SliderTable, but every call names its function.  The assembler for GPUs so sees what each call
/// needs of the registers; behind a pointer it must save half of them (docs/performance.md).  All threads of a grid choose alike.
template <class First, class... Others> struct SliderCrankChoice : SliderBase, SliderLanes<First::conserving> {
    static_assert(((Others::conserving == First::conserving && Others::has_memory == First::has_memory &&
                    Others::can_hold == First::can_hold) &&
                   ...));
    template <class Real> using Memory = typename First::template Memory<Real>;
    template <class Real> using Watch = typename First::template Watch<Real>;
    template <class Real> using ShadowWatch = typename First::template ShadowWatch<Real>;
    static constexpr bool has_memory = First::has_memory;
    static constexpr bool can_hold = First::can_hold;

    int chosen = 0;  // place in the list, from 0

    template <bool Full, class Real>
    SLIDEWAY_NOINLINE Faults<Real> derivative(Real t, Real const* state, Parameters<Real> const& p,
                                              Memory<Real> const& memory, Real* rates, Report<Real>* report) const {
        return call(
            [&]<class Model>(Model) { return Model::template derivative<Full>(t, state, p, memory, rates, report); });
    }
    template <class Real>
    SLIDEWAY_NOINLINE void linearise(Real t, Real const* state, Parameters<Real> const& p, Memory<Real> const& memory,
                                     SliderLinearisation<Real>& out) const {
        call([&]<class Model>(Model) { return Model::linearise(t, state, p, memory, out), true; });
    }
    template <class Real>
    SLIDEWAY_NOINLINE Real contact_pattern(Real t, Real const* state, Parameters<Real> const& p) const {
        return call([&]<class Model>(Model) { return Model::contact_pattern(t, state, p); });
    }
    template <class Real>
    SLIDEWAY_NOINLINE Real gap(Real t, Real const* state, Parameters<Real> const& p, bool z_faces, int apex) const {
        return call([&]<class Model>(Model) { return Model::gap(t, state, p, z_faces, apex); });
    }
    template <class Real>
    SLIDEWAY_NOINLINE Real approach_speed(Real t, Real const* state, Real step, Real const* end,
                                          Parameters<Real> const& p) const {
        return call([&]<class Model>(Model) { return Model::approach_speed(t, state, step, end, p); });
    }

private:
    /// What the function says of the chosen model; the last one's word where none was chosen.
    template <class Function> SLIDEWAY_FN auto call(Function const& function) const {
        return call_from<0, First, Others...>(function);
    }
    template <int place, class Model, class... Later, class Function>
    SLIDEWAY_FN auto call_from(Function const& function) const {
        if constexpr (sizeof...(Later) == 0) {
            return function(Model{});
        } else {
            return chosen == place ? function(Model{}) : call_from<place + 1, Later...>(function);
        }
    }
};

namespace detail {

template <class... Choices> struct Joined;
template <class... Models> struct Joined<SliderCrankChoice<Models...>> { using Type = SliderCrankChoice<Models...>; };
template <class... First, class... Second, class... Others>
struct Joined<SliderCrankChoice<First...>, SliderCrankChoice<Second...>, Others...>
    : Joined<SliderCrankChoice<First..., Second...>, Others...> {};

template <class Law, class Damping>
using WithAndWithout = SliderCrankChoice<SliderCrankModel<Law, NoFriction, AlignedWay, Damping>,
                                         SliderCrankModel<Law, NoFriction, MisalignedWay, Damping>,
                                         SliderCrankModel<Law, StickSlipFriction, AlignedWay, Damping>,
                                         SliderCrankModel<Law, StickSlipFriction, MisalignedWay, Damping>>;

}  // namespace detail

/// The slider-cranks of a law, with and without friction and a misaligned way: those whose contacts depend on the state alone, and
/// those that remember their impacts.
template <class Law>
using SteadyCranksOf =
    typename detail::Joined<detail::WithAndWithout<Law, PointDamping>, detail::WithAndWithout<Law, RateDamping>>::Type;
template <class Law> using ImpactCranksOf = detail::WithAndWithout<Law, RestitutionDamping>;

/// The one of such a list that a scene's parts ask for; their law and whether they remember impacts are the list's.
template <class Cranks> SLIDEWAY_FN Cranks chosen_of(Parts const& parts) {
    Cranks cranks;
    cranks.chosen =
        (parts.damping == Damping::rate ? 4 : 0) + (parts.friction ? 2 : 0) + (parts.misaligned_way ? 1 : 0);
    return cranks;
}

}  // namespace slideway::inline SLIDEWAY_ISA
