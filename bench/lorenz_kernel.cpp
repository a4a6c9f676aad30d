// Compiled once per instruction set.
#include "bench/lorenz_kernel.hpp"

#include <vector>

#include "kernels/isa_real.hpp"
#include "tests/models/fixed_step.hpp"
#include "tests/models/lorenz.hpp"

namespace slideway::inline SLIDEWAY_ISA {

void integrate_lorenz(LorenzRun const& run) {
    std::vector<Lorenz::Inputs> inputs(run.members);
    for (std::size_t i = 0; i < run.members; ++i) inputs[i].rho = run.rho[i];
    fixed_step<Lorenz, IsaReal>({inputs.data(), run.members, run.step, run.steps, run.states});
}

}  // namespace slideway::inline SLIDEWAY_ISA
