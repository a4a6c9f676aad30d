// Fixed-step Runge–Kutta 4 on the Lorenz equations, one core, beside Boost.Odeint's; the share of the machine's multiply-adds is
// flop/s over that of peak/multiply_add.
#include <string>
#include <vector>

#include "bench/lorenz_kernel.hpp"
#include "bench/throughput/throughput.hpp"
#include "tests/models/by_isa.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(LorenzIntegrator, integrate_lorenz)

namespace bench {
namespace {

constexpr std::size_t members = 1536;  // whole groups of every instruction set
constexpr std::uint64_t steps = 200;
constexpr double step = 1e-3;

void integrate(LorenzIntegrator* integrator, std::vector<double>& states) {
    std::vector<double> rho(members);
    for (std::size_t i = 0; i < members; ++i) rho[i] = 28.0 * static_cast<double>(i) / members;
    integrator({rho.data(), members, step, steps, states.data()});
}

void time_lorenz(benchmark::State& state, LorenzIntegrator* integrator, bool is_ours) {
    std::vector<double> states(3 * members), scalar(3 * members);
    for (auto _ : state) {
        integrate(integrator, states);
        benchmark::ClobberMemory();
    }
    if (is_ours) {
        integrate(integrate_lorenz_by_isa(runnable_isas().front()), scalar);
        if (states != scalar) return state.SkipWithError("the states are not those of the first instruction set");
    }
    double const member_steps = static_cast<double>(members * steps);
    count_rate(state, "member-steps/s", member_steps);
    count_rate(state, "flop/s", lorenz_step_flops * member_steps);
}

}  // namespace

void register_lorenz() {
    for (Isa const isa : runnable_isas()) {
        auto const name = "lorenz/rk4/" + std::string(name_of(isa));
        benchmark::RegisterBenchmark(name.c_str(), time_lorenz, integrate_lorenz_by_isa(isa), true);
    }
    benchmark::RegisterBenchmark("lorenz/rk4/odeint", time_lorenz, &odeint_lorenz, false);
}

}  // namespace bench
}  // namespace slideway
