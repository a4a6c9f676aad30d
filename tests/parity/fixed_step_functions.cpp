// Compiled once per instruction set.
#include "tests/parity/fixed_step_functions.hpp"

#include <vector>

#include "kernels/isa_real.hpp"
#include "tests/models/fixed_step.hpp"
#include "tests/models/lorenz.hpp"
#include "tests/models/relief_valve.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Model> void run(FixedStepCase const& c, std::vector<typename Model::Inputs> const& inputs, int group) {
    FixedStepBlock<Model> const block{inputs.data(), c.members, 1e-3, c.steps, c.states};
    switch (group) {
        case 0:
            return fixed_step<Model, IsaReal>(block);
        case 1:
            return fixed_step<Model, IsaReal, PackGroup{1, 1}>(block);
        case 2:
            return fixed_step<Model, IsaReal, PackGroup{3, 2}>(block);
        case 3:
            return fixed_step<Model, IsaReal, PackGroup{1, 5}>(block);
    }
}

void run_case(FixedStepCase const& c, int group) {
    if (c.valve) {
        std::vector<ReliefValve::Inputs> inputs(c.members);
        for (std::size_t i = 0; i < c.members; ++i) inputs[i].inflow = c.values[i];
        run<ReliefValve>(c, inputs, group);
    } else {
        std::vector<Lorenz::Inputs> inputs(c.members);
        for (std::size_t i = 0; i < c.members; ++i) inputs[i].rho = c.values[i];
        run<Lorenz>(c, inputs, group);
    }
}

void valve_case(ValveCase const& c) {
    for (std::size_t first = 0; first < c.members; first += lanes<IsaReal>) {
        ReliefValve::Parameters<IsaReal> p{IsaReal(0.0)};
        IsaReal s[3] = {IsaReal(0.0), IsaReal(0.0), IsaReal(0.0)}, rates[3], value[2], slope[2];
        auto const each_lane = [&](auto f) {
            for (int i = 0; i < lanes<IsaReal>; ++i) f(i, first + static_cast<std::size_t>(i));
        };
        each_lane([&](int i, std::size_t member) {
            set_lane(p.inflow, i, c.inflows[member]);
            for (std::size_t j = 0; j < 3; ++j) set_lane(s[j], i, c.states[3 * member + j]);
        });
        ReliefValve::Report<IsaReal> report;
        ReliefValve::derivative<false>(IsaReal(0.0), s, p, {}, rates, &report);
        ReliefValve::event_values(IsaReal(0.0), s, rates, p, value, slope);
        auto const rests = ReliefValve::at_rest(rates);
        IsaReal const zero(0.0);
        ReliefValve::reset(ReliefValve::impact, (s[0] <= zero) & (s[1] < zero), s, p);
        each_lane([&](int i, std::size_t member) {
            for (std::size_t j = 0; j < 3; ++j) c.states[3 * member + j] = lane(s[j], i);
            for (std::size_t j = 0; j < 2; ++j) {
                c.events[4 * member + j] = lane(value[j], i);
                c.events[4 * member + 2 + j] = lane(slope[j], i);
            }
            c.at_rest[member] = holds(rests, i) ? 1 : 0;
        });
    }
}

}  // namespace

extern FixedStepKernel const fixed_step_kernel;
FixedStepKernel const fixed_step_kernel{run_case, valve_case};

}  // namespace slideway::inline SLIDEWAY_ISA
