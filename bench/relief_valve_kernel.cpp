// Compiled once per instruction set.
#include "bench/relief_valve_kernel.hpp"

#include <type_traits>
#include <vector>

#include "bench/relief_valve_orbit.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "tests/models/relief_valve.hpp"
#include "tests/models/twin.hpp"

namespace slideway::inline SLIDEWAY_ISA {

void integrate_valves(ValveRun const& run) {
    // Two packs abreast: one alone leaves the core waiting for its own results.
    using Real = std::conditional_t<lanes<IsaReal> == 1, IsaReal, Twin<IsaReal>>;
    using Observer = ReliefValve::Observer<Real>;
    static_assert(Observer::columns == static_cast<int>(bench::valve_recorded_events));

    std::vector<ReliefValve::Inputs> inputs(run.members);
    for (std::size_t i = 0; i < run.members; ++i) inputs[i].inflow = run.inflows[i];
    std::vector<double> final_states(run.members * ReliefValve::size);
    BlockOf<ReliefValve::Inputs> block;
    block.inputs = inputs.data();
    block.members = run.members;
    block.settings.method = Method::dopri5;
    block.settings.rtol = block.settings.atol = run.tolerance;
    block.settings.end_time = 1e5;  // never reached
    block.settings.max_step = 0.5;  // the peer's too
    block.quantities = 1;
    block.records = run.records;
    block.final_states = final_states.data();
    block.quantity_values = run.lifts;
    integrate<ReliefValve, Real>(block);
}

}  // namespace slideway::inline SLIDEWAY_ISA
