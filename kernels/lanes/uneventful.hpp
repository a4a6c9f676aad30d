#pragma once

#include "kernels/lanes/attempt.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A model without events of its own.  One that states `events` brings what finds them (tests/models/event_search.hpp).
template <class Model, class Real> struct Uneventful {
    template <class Stepper>
    SLIDEWAY_HD void run(Pack<Model, Real>&, Stepper&, Attempt<Model, Real> const&, Mask<Real> /*accepted*/, Real& /*t_end*/, Mask<Real>& /*landed*/) {}
    SLIDEWAY_HD void reset(Pack<Model, Real>&, Attempt<Model, Real>&) {}
    SLIDEWAY_HD Mask<Real> piled_up(Pack<Model, Real>&, Real /*step*/) const { return mask_of<Real>(false); }
    SLIDEWAY_HD Mask<Real> complete(Pack<Model, Real>&, Mask<Real> /*accepted*/) const { return mask_of<Real>(false); }
};

template <class Model, class Real> struct SearchFor { using Type = Uneventful<Model, Real>; };
template <HasEvents Model, class Real> struct SearchFor<Model, Real> { using Type = typename Model::template Search<Model, Real>; };
template <class Model, class Real> using SearchOf = typename SearchFor<Model, Real>::Type;

}  // namespace slideway::inline SLIDEWAY_ISA
