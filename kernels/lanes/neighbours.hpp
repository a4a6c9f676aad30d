#pragma once

#include <type_traits>

#include "kernels/lanes/shadows.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Members without others beside them: all that Shadows do for those that have some is nothing here.
template <class Model, class Real> class Alone {
public:
    explicit SLIDEWAY_HD Alone(ShadowPlan const&) {}

    SLIDEWAY_HD Mask<Real> start(Pack<Model, Real>&, Mask<Real>, Faults<Real>&) { return mask_of<Real>(false); }
    template <class Step> SLIDEWAY_HD void attempt(Step&) {}
    SLIDEWAY_HD Real larger_norm_than(Real own) const { return own; }
    SLIDEWAY_HD Mask<Real> finite_beside(Mask<Real> own) const { return own; }
    SLIDEWAY_HD Faults<Real> faults_beside(Faults<Real> const& own) const { return own; }

    SLIDEWAY_HD static double located(double alone) { return alone; }
    SLIDEWAY_HD Real first_event(Pack<Model, Real> const&, Mask<Real>, Real, Real fraction) const { return fraction; }
    SLIDEWAY_HD void go_on(Pack<Model, Real>&, Real, Mask<Real>, Allowance<Real>&) const {}

    SLIDEWAY_HD void advance(Pack<Model, Real>&, Mask<Real>) {}
    template <class Contact, class Memory>
    SLIDEWAY_HD void settle(Pack<Model, Real> const&, Real const*, Real const*, Contact const&, Memory const&, Mask<Real>, bool) {}
    SLIDEWAY_HD void depart(Pack<Model, Real>&, Mask<Real>) {}
    SLIDEWAY_HD void stop(Pack<Model, Real>&, Results<Model>&, Mask<Real>) {}
};

/// What goes along with the members of a model: Shadows where it has them.
template <class Model, class Real> using Neighbours = std::conditional_t<Model::has_shadows, Shadows<Model, Real>, Alone<Model, Real>>;

}  // namespace slideway::inline SLIDEWAY_ISA
