#pragma once

#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/slider_crank_linearisation.hpp"
#include "kernels/models/slider_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider-crank whose parts are known when the lanes are compiled.
template <class Law, class Friction, class Way, class Damping>
struct SliderCrankModel : SliderModel<SliderCrank<Law, Friction, Way, Damping>> {
    using Mechanism = SliderCrank<Law, Friction, Way, Damping>;

    template <class Real>
    SLIDEWAY_HD static void linearise(Real t, Real const* state, SliderParameters<Real> const& p,
                                      typename Mechanism::template Memory<Real> const& memory,
                                      SliderLinearisation<Real>& out) {
        slideway::linearise<Mechanism>(t, state, p, memory, out);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
