// Compiled once per instruction set.
#include "tests/parity/linearisation_table.hpp"

#include "kernels/conditions.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/law_table.hpp"
#include "kernels/mechanisms/slider_crank.hpp"

namespace slideway::inline SLIDEWAY_ISA {

void linearise_table(Parts const& parts, LawKernels const& kernels, LinearisationRow const* rows, std::size_t count, double* result) {
    using Real = IsaReal;
    constexpr int width = lanes<Real>;
    auto const& law = *static_cast<LawTable<Real> const*>(kernels.table);  // as it ships
    Conditions<LawFunctions<Real>> const block(law.with[static_cast<int>(parts.damping)], law.switches, parts);
    SliderParameters<Real> p;
    ContactMemory<Real> memory;
    start_memory(memory);
    for (auto& face : memory.impact_speed) face.a = face.b = face.c = face.d = Real(0.01);
    SliderLinearisation<Real> at;
    for (std::size_t first = 0; first < count; first += width) {
        Real t, hg, state[state_size], u[state_size];
        for (int i = 0; i < width; ++i) {
            auto const& row = rows[first + static_cast<std::size_t>(i)];
            load_lane(p, i, SliderCrank::parameters(row.inputs));
            double start[state_size];
            SliderCrank::initial_state(row.inputs, start);
            for (int j = 0; j < state_size; ++j) set_lane(state[j], i, start[j]);
            set_lane(t, i, row.time);
            set_lane(hg, i, row.hg);
        }
        SliderCrank::linearise(t, state, p, memory, block, at);
        at.factor(hg);
        at.solve(state, u);
        Real values[linearisation_values];
        Real* next = values;
        for (auto const* matrix : {at.joint.by_place, at.joint.by_rate}) {
            for (int i = 0; i < 5; ++i) {
                for (int j = 0; j < 5; ++j) *next++ = matrix[i][j];
            }
        }
        *next++ = at.touching;
        *next++ = at.rate_squared();
        for (Real const& value : u) *next++ = value;
        *next++ = at.residual(state, u);
        for (int i = 0; i < width; ++i) {
            double* const to = result + (first + static_cast<std::size_t>(i)) * linearisation_values;
            for (int j = 0; j < linearisation_values; ++j) to[j] = lane(values[j], i);
        }
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
