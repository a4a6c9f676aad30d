#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/lane_program.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Integrates a block of members of a model with one pack of lanes.  What a model states is static, but its equations may be members:
/// a model can look them up (kernels/models/mechanism_table.hpp).
///
/// A `Model` states, for `Real` a number or a pack of them:
///  - `Inputs` (plain numbers of one member), `size` (of the state), `parameters(inputs)` and `initial_state(inputs, state)`, in double;
///  - `Parameters<Real>`, `Report<Real>` (what a state tells beside its derivative), `Memory<Real>` (what contacts leave behind) and
///    `Watch<Real>` (what finds their events), which hold Reals only, and `Observer<Real>` (quantities on the way; with `peaks` those are
///    looked for inside of steps), also `Accelerations<Real>` where those may be asked for;
///  - `derivative<Full>(t, state, parameters, memory, rates, report)`, which fills the report if Full and returns `Faults`;
///  - `series`: how many columns a sample may have: the state, and if there are more, those where `state_of_series(series)` says;
///  - `has_contacts`: the report then has a `contact`, the model `switches()` and `watching(locate_modes, neighbours)`, and the watch
///    `begin`, `earliest`, `update` and `keep` (kernels/steppers/contact_watch.hpp), `touch_scale(parameters)` being its length;
///  - `has_impacts`: contacts then are rigid, `located(parameters, end)` is the length of the watch instead, and `settle(…)` says what follows
///    where a step has ended (kernels/rigid); with shadows both it and the derivative are called with a Tangent for `Real` too, and the
///    contact's report has the depths `watched` and their `rate`, and where slips turn round `grip` (kernels/lanes/saltation.hpp);
///    for time stepping (kernels/lanes/moreau_jean_step.hpp) `push(…)`, the impulses of a step, `rate_components` and `put_place_rates(…)`;
///    `sees_contacts`: then `see(t, state, parameters, memory, contact)` fills in what the watch asks for without the forces;
///  - `set_tolerance(rtol)` and `tell_integrands_alone(inside)` if the model has use for them;
///  - `scales(parameters, scale)`: sizes of the state's components that the absolute tolerance is meant against;
///  - `has_linearisation`: then `Linearisation<Real>` and `linearise(…)` serve the stiff method; `bend(…)`, where it is there, tells how
///    what it rests on accelerates;
///  - `has_shadows`: then members have shadows beside them (kernels/lanes/shadows.hpp; kernels/models/shadowed.hpp makes such a model of
///    another), with contacts also `remembered(speed)`, an impact speed as it may be carried on, and `prescribed()` if its drive leaves some of the
///    state without offsets;
///  - `has_crossings`: then `gap(…)`, beside the components of the state, may serve as a section (kernels/lanes/crossing_search.hpp);
///    with `has_impacts` the memory has `books` of the last impact, and `met_bit(…)` names a pair among those that it met
///    (kernels/lanes/impact_rows.hpp);
///  - `has_patterns`: then `contact_pattern(…)`, of a state or with `has_impacts` of a memory, says which lanes have like work to do, and with a
///    linearisation `squared_speed(…)`, `approach_speed(…)` and `energy_scale(…)` what is a creep and what an impact;
///  - `has_own_stepper`: then `with_stepper<Model, Real>(rtol, work)` calls `work` with a null pointer to the stepper that `auto` takes, made like
///    ExplicitStep (tests/models/taylor_step.hpp in the sources);
///  - `events`, if it has any of its own: then `Search<Model, Real>` finds them and resets the state, with `run`, `ended`, `fraction`, `reset` and
///    `piled_up` as that of the sources has them (tests/models/event_search.hpp), and the model has `at_rest(rates)`.
template <class Model, class Real>
SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block, Model const& model) {
    LaneProgram<Model, Real> program(block, model);
    program.run();
}

template <class Model, class Real> SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block) {
    integrate<Model, Real>(block, Model{});
}

}  // namespace slideway::inline SLIDEWAY_ISA
