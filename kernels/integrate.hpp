#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/lane_program.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Integrates a block of members of a model with one pack of lanes.  kernels/lanes/model.hpp lists what a model states; its contacts further
///  - `Watch<Real>` with `begin`, `earliest`, `update` and `keep` (kernels/steppers/contact_watch.hpp);
///  - with `has_impacts` `settle(…)`; for time stepping (kernels/lanes/moreau_jean_step.hpp) `push(…)`, the impulses of a step, `rate_components` and
///    `put_place_rates(…)`; with `sees_contacts` `see(t, state, parameters, memory, contact)`, which fills in what the watch asks for without the forces;
///    with shadows the contact's report has the depths `watched` and their `rate`, and where slips turn round `grip` (kernels/lanes/saltation.hpp);
///  - with `has_shadows` (kernels/models/shadowed.hpp makes such a model of another) `remembered(speed)`, an impact speed as it may be carried on, and
///    `prescribed()` if its drive leaves some of the state without offsets;
///  - with `has_crossings` `gap(…)`, which beside the components of the state may serve as a section (kernels/lanes/crossing_search.hpp); with
///    `has_impacts` the memory has `books` of the last impact, and `met_bit(…)` names a pair among those that it met (kernels/lanes/impact_rows.hpp).
/// A model may have `set_tolerance(rtol)`, `tell_integrands_alone(inside)`, and with `has_own_stepper` `with_stepper<Model, Real>(rtol, work)`, which calls
/// `work` with a null pointer to the stepper that `auto` takes, made like ExplicitStep (tests/models/taylor_step.hpp in the sources).
template <class Model, class Real>
SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block, Model const& model) {
    LaneProgram<Model, Real> program(block, model);
    program.run();
}

template <class Model, class Real> SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block) {
    integrate<Model, Real>(block, Model{});
}

}  // namespace slideway::inline SLIDEWAY_ISA
