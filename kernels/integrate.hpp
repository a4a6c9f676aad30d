#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/lane_program.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What whoever makes a block keeps: where results go that it asks for, and numbers that steps can be made of.
template <class Model> SLIDEWAY_HD void expect_whole(BlockOf<typename Model::Inputs> const& block) {
    if (block.members == 0) return;
    auto const& s = block.settings;
    auto const& stops = block.stops;
    auto const& shadows = block.shadows;
    auto const& crossings = block.crossings;
    SLIDEWAY_EXPECT(block.inputs != nullptr && block.records != nullptr && block.final_states != nullptr);
    SLIDEWAY_EXPECT(s.rtol > 0 && s.atol > 0 && s.stiff_tolerance > 0 && s.max_step > 0 && s.stiff_max_step > 0);
    SLIDEWAY_EXPECT((s.method != Method::rk4 && s.method != Method::moreau_jean) || s.fixed_step > 0);
    SLIDEWAY_EXPECT(block.quantities == 0 || block.quantity_values != nullptr);
    SLIDEWAY_EXPECT(block.samples == 0 || (block.sample_times != nullptr && (block.series == 0 || block.series_values != nullptr)));
    SLIDEWAY_EXPECT(stops.count == 0 || (block.clocks != nullptr && stops.section_every > 0 && stops.growth_every > 0));
    SLIDEWAY_EXPECT(stops.growth_lead <= stops.transient);
    SLIDEWAY_EXPECT(!block.by_turns || (HasCrankState<Model> && block.clocks != nullptr && (block.samples == 0 || block.sample_clock != nullptr)));
    SLIDEWAY_EXPECT(shadows.count == 0 || (Model::has_shadows && shadows.count <= most_shadows && shadows.d0 > 0 && shadows.directions != nullptr));
    SLIDEWAY_EXPECT(crossings.room == 0 || (Model::has_crossings && !Model::has_shadows && stops.count == 0 && block.section_values != nullptr));
    SLIDEWAY_EXPECT(crossings.index >= 0 && crossings.index < (crossings.on == CrossingPlan::On::state ? Model::size : 8));
}

/// Integrates a block of members of a model with one pack of lanes.  kernels/lanes/model.hpp lists what a model states; its contacts further
///  - `Watch<Real>` with `begin`, `earliest`, `update` and `keep` (kernels/steppers/contact_watch.hpp);
///  - with `is_rigid` `settle(…)`; for time stepping (kernels/lanes/moreau_jean_step.hpp) `push(…)`, the impulses of a step, `rate_components` and
///    `put_place_rates(…)`; with `sees_contacts` `see(t, state, parameters, memory, contact)`, which fills in what the watch asks for without the forces;
///    with shadows the contact's report has the depths `watched` and their `rate`, and where slips turn round `grip` (kernels/lanes/saltation.hpp);
///  - with `has_shadows` (kernels/models/shadowed.hpp makes such a model of another) `remembered(speed)`, an impact speed as it may be carried on;
///  - with `has_crossings` `gap(…)`, which beside the components of the state may serve as a section (kernels/lanes/crossing_search.hpp); with
///    `is_rigid` the memory has `books` of the last impact, and `met_bit(…)` names a pair among those that it met (kernels/lanes/impact_rows.hpp).
/// A model may hide what ModelDefaults answers, and has with `has_own_stepper` `with_stepper<Model, Real>(rtol, work)`, which calls
/// `work` with a null pointer to the stepper that `auto` takes, made like ExplicitStep (tests/models/taylor_step.hpp in the sources).
template <class Model, class Real>
SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block, Model const& model) {
    expect_whole<Model>(block);
    LaneProgram<Model, Real> program(block, model);
    program.run();
}

template <class Model, class Real> SLIDEWAY_HD void integrate(BlockOf<typename Model::Inputs>& block) {
    integrate<Model, Real>(block, Model{});
}

}  // namespace slideway::inline SLIDEWAY_ISA
