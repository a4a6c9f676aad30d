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
#include "host/backend/by_isa.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(FmaPeakRounds, fma_peak_rounds)
SLIDEWAY_BY_ISA(LorenzIntegrator, integrate_lorenz)

namespace {

constexpr std::size_t members = 1536;  // whole groups of every instruction set
constexpr std::uint64_t steps = 1000;
constexpr double step = 1e-3;
constexpr int rounds = 25;

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
    for (Isa const isa : built_isas()) {
        if (!is_supported(isa)) continue;
        auto* const integrate = integrate_lorenz_by_isa(isa);
        run.states = isa == Isa::scalar ? reference.data() : states.data();
        integrate(run);
        bool const same = std::memcmp(run.states, reference.data(), 3 * members * sizeof(double)) == 0;
        rows.push_back({std::string(name_of(isa)), integrate, fma_peak_rounds_by_isa(isa), same, {}, {}, {}});
    }
    rows.push_back({"Odeint runge_kutta4", odeint_lorenz, fma_peak_rounds_by_isa(Isa::scalar), false, {}, {}, {}});
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
