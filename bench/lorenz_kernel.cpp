// Compiled once per instruction set.
#include "bench/lorenz_kernel.hpp"

#include <utility>
#include <vector>

#include "host/backend/isa_real.hpp"
#include "kernels/fixed_step.hpp"
#include "kernels/mechanisms/lorenz.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

void integrate(LorenzRun const& run) {
    std::vector<Lorenz::Inputs> inputs(run.members);
    for (std::size_t i = 0; i < run.members; ++i) inputs[i].rho = run.rho[i];
    fixed_step<Lorenz, Real>({inputs.data(), run.members, run.step, run.steps, run.states});
}

/// Two units of four cycles' latency hold eight chains; twelve are sure to fill them and leave registers for the operands.
template <int... chain> double multiply_add(std::uint64_t rounds, std::integer_sequence<int, chain...>) {
    constexpr int chains = sizeof...(chain);
    double volatile factor = 0.999, addend = 1e-3;  // unknown to the compiler
    Real const a(factor), b(addend);
    Real x[chains] = {Real(0.1 * chain)...};
    for (std::uint64_t i = 0; i < rounds; ++i) ((x[chain] = fma(x[chain], a, b)), ...);
    Real sum(0.0);
    ((sum = sum + x[chain]), ...);
    double const volatile used = lane(sum, 0);
    static_cast<void>(used);
    return 2.0 * static_cast<double>(rounds) * chains * lanes<Real>;
}

double twelve_chains(std::uint64_t rounds) { return multiply_add(rounds, std::make_integer_sequence<int, 12>{}); }

}  // namespace

extern LorenzKernel const lorenz_kernel;
LorenzKernel const lorenz_kernel{integrate, twelve_chains};

}  // namespace slideway::inline SLIDEWAY_ISA
