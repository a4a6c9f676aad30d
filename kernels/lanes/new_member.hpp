#pragma once

#include <cstddef>

#include "kernels/block.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/observers/sampler.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"
#include "kernels/steppers/step_control.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a member starts from, before its first evaluation.
template <class Model> struct NewMember {
    using Block = BlockOf<typename Model::Inputs>;
    using Record = MemberState<Model, double>;

    SLIDEWAY_HD static void begin(Record& r, Model const& model, Block const& block, std::size_t member) {
        SLIDEWAY_EXPECT(member < block.members);
        auto const& inputs = block.inputs[member];
        r.constants.parameters = model.parameters(inputs);
        model.scales(r.constants.parameters, r.constants.scale);
        auto& c = r.course = {};
        c.member = static_cast<double>(member);
        c.h = 1e-3 * block.settings.max_step;
        c.error_memory = step_control_start;
        model.initial_state(inputs, c.y);
        MemberClock const clock = block.clocks != nullptr ? block.clocks[member] : MemberClock{block.settings.end_time};
        SLIDEWAY_EXPECT(clock.end >= 0 && (block.stops.count == 0 || (clock.first_stop > 0 && clock.period > 0)));
        r.constants.end = clock.end;
        r.constants.first_stop = clock.first_stop;
        r.constants.stop_period = clock.period;
        r.constants.turns = clock.turns;
        r.constants.first_back = clock.first_back;
        r.constants.start_angle = c.y[crank_place<Model, 0>];
        if constexpr (Model::has_shadows) place_shadows(r, block.shadows, member, StateCount<Model>(model));
        if constexpr (HasClocks<Model>) c.clocked = {0.0, c.h, 0.0, 0.0, 0.0};
        // A model without linearisation is left to the explicit pair.
        c.stiff = Model::has_linearisation && block.settings.method == Method::ros34pw2 ? 1 : 0;
        start_memory(r.contacts.memory);
    }

private:
    /// Puts its shadows beside it.
    SLIDEWAY_HD static void place_shadows(Record& r, ShadowPlan const& plan, std::size_t member, int states) {
        for (int s = 0; s < plan.count; ++s) {
            auto const row = member * static_cast<std::size_t>(plan.count) + static_cast<std::size_t>(s);
            double const* const direction = plan.directions + row * static_cast<std::size_t>(states);
            auto& shadow = r.shadows[s];
            for (int i = 0; i < states; ++i) {
                shadow.y[i] = fma(plan.d0 * r.constants.scale[i], direction[i], r.course.y[i]);
            }
            shadow.distance = plan.d0;
            shadow.growth = 0;
            if constexpr (!IsRigid<Model>) start_memory(shadow.contacts.memory);
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
