// Fixed-step Runge–Kutta 4 on the Lorenz equations, one core: operations per second against the multiply-adds per second that the
// machine reaches.  Both are measured side by side, every instruction set in every round, and medians reported.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "bench/fma_peak.hpp"
#include "bench/lorenz_kernel.hpp"
#include "bench/machine.hpp"
#include "bench/median.hpp"
#include "host/backend/backend.hpp"

namespace slideway {

namespace scalar {
FmaPeakRounds fma_peak_rounds;
LorenzIntegrator integrate_lorenz;
}  // namespace scalar
namespace avx2 {
FmaPeakRounds fma_peak_rounds;
LorenzIntegrator integrate_lorenz;
}  // namespace avx2
namespace avx512 {
FmaPeakRounds fma_peak_rounds;
LorenzIntegrator integrate_lorenz;
}  // namespace avx512

namespace {

constexpr std::size_t members = 1536;  // whole groups of every instruction set
constexpr std::uint64_t steps = 1000;
constexpr double step = 1e-3;
constexpr int rounds = 25;

struct Kernel {
    Isa isa;
    LorenzIntegrator* integrate;
    FmaPeakRounds* multiply_add;
};

constexpr Kernel kernels[] = {
    {Isa::scalar, scalar::integrate_lorenz, scalar::fma_peak_rounds},
    {Isa::avx2, avx2::integrate_lorenz, avx2::fma_peak_rounds},
    {Isa::avx512, avx512::integrate_lorenz, avx512::fma_peak_rounds},
};

/// Of the processor, not of the clock: other work on the machine counts for little.
template <class Work> double seconds(Work work) {
    auto const start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Row {
    std::string name;
    LorenzIntegrator* integrate;
    FmaPeakRounds* multiply_add;
    bool same_bits;  // as scalar
    std::vector<double> run, peak, share;
};

void measure(Row& row, LorenzRun const& run) {
    double const flops = lorenz_step_flops * static_cast<double>(members * steps);
    row.run.push_back(seconds([&] { row.integrate(run); }));
    std::uint64_t done = 0;
    double const time = seconds([&] { done = row.multiply_add(400'000); });
    row.peak.push_back(static_cast<double>(done) / time);
    row.share.push_back(flops / row.run.back() / row.peak.back());
}

int benchmark() {
    std::vector<double> rho(members), states(3 * members), reference(3 * members);
    for (std::size_t i = 0; i < members; ++i) rho[i] = 28.0 * static_cast<double>(i) / members;
    LorenzRun run{rho.data(), members, step, steps, states.data()};

    std::vector<Row> rows;
    for (auto const& kernel : kernels) {
        if (!is_supported(kernel.isa)) continue;
        run.states = kernel.isa == Isa::scalar ? reference.data() : states.data();
        kernel.integrate(run);
        bool const same = std::memcmp(run.states, reference.data(), 3 * members * sizeof(double)) == 0;
        rows.push_back({std::string(name_of(kernel.isa)), kernel.integrate, kernel.multiply_add, same, {}, {}, {}});
    }
    rows.push_back({"Odeint runge_kutta4", odeint_lorenz, scalar::fma_peak_rounds, false, {}, {}, {}});
    run.states = states.data();
    for (int round = 0; round < rounds; ++round) {
        for (auto& row : rows) measure(row, run);
    }

    double const work = static_cast<double>(members * steps), best_scalar = median(rows.front().run);
    fmt::print("# Lorenz, fixed-step Runge-Kutta 4, one core\n\n{}- flags: {}\n", machine_and_build(),
               flags_of(best_isa()));
    fmt::print("- {} members, {} steps of {}, {} flops a step, medians of {} rounds\n\n", members, steps, step,
               lorenz_step_flops, rounds);
    fmt::print("| | ns per member-step | GF/s | FMA peak, GF/s | of the peak | over scalar | bits as scalar |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
    for (auto const& row : rows) {
        double const time = median(row.run);
        fmt::print("| {} | {:.3f} | {:.1f} | {:.1f} | {:.1f} % | {:.2f} | {} |\n", row.name, time * 1e9 / work,
                   lorenz_step_flops * work / time * 1e-9, median(row.peak) * 1e-9, 100 * median(row.share),
                   best_scalar / time, row.same_bits ? "yes" : "no");
    }
    return 0;
}

}  // namespace
}  // namespace slideway

int main() { return slideway::benchmark(); }
