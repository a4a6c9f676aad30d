// Fixed-step Runge–Kutta 4 on the Lorenz equations, one core: operations per second against the multiply-adds per second that the
// machine reaches.  Both are measured side by side, every instruction set in every round, and medians reported.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "bench/lorenz_kernel.hpp"
#include "host/backend/backend.hpp"

namespace slideway {

namespace scalar {
extern LorenzKernel const lorenz_kernel;
}
namespace sse2 {
extern LorenzKernel const lorenz_kernel;
}
namespace avx2 {
extern LorenzKernel const lorenz_kernel;
}
namespace avx512 {
extern LorenzKernel const lorenz_kernel;
}

namespace {

constexpr std::size_t members = 1536;  // whole groups of every instruction set
constexpr std::uint64_t steps = 1000;
constexpr double step = 1e-3;
constexpr int rounds = 25;

LorenzKernel const& kernel_of(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return scalar::lorenz_kernel;
        case Isa::sse2:
            return sse2::lorenz_kernel;
        case Isa::avx2:
            return avx2::lorenz_kernel;
        case Isa::avx512:
            break;
    }
    return avx512::lorenz_kernel;
}

/// Of the processor, not of the clock: other work on the machine counts for little.
template <class Work> double seconds(Work work) {
    auto const start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Row {
    std::string name;
    LorenzKernel const* kernel;  // null: the peer
    bool same_bits;              // as scalar
    std::vector<double> run, peak, share;
};

void measure(Row& row, LorenzRun const& run, Row const& scalar_row) {
    double const flops = lorenz_step_flops * static_cast<double>(members * steps);
    row.run.push_back(seconds([&] { row.kernel ? row.kernel->integrate(run) : odeint_lorenz(run); }));
    double done = 0;
    auto const& kernel = row.kernel ? *row.kernel : *scalar_row.kernel;
    double const time = seconds([&] { done = kernel.multiply_add(400'000); });
    row.peak.push_back(done / time);
    row.share.push_back(flops / row.run.back() / row.peak.back());
}

int benchmark() {
    std::vector<double> rho(members), states(3 * members), reference(3 * members);
    for (std::size_t i = 0; i < members; ++i) rho[i] = 28.0 * static_cast<double>(i) / members;
    LorenzRun run{rho.data(), members, step, steps, states.data()};

    std::vector<Row> rows;
    for (Isa const isa : all_isas()) {
        if (isa == Isa::sse2 || !is_supported(isa)) continue;
        auto& row = rows.emplace_back(Row{std::string(name_of(isa)), &kernel_of(isa), true, {}, {}, {}});
        run.states = isa == Isa::scalar ? reference.data() : states.data();
        row.kernel->integrate(run);
        row.same_bits = std::memcmp(run.states, reference.data(), 3 * members * sizeof(double)) == 0;
    }
    rows.push_back({"Odeint runge_kutta4", nullptr, false, {}, {}, {}});
    run.states = states.data();
    for (int round = 0; round < rounds; ++round) {
        for (auto& row : rows) measure(row, run, rows.front());
    }

    double const work = static_cast<double>(members * steps), best_scalar = median(rows.front().run);
    fmt::print("{} members, {} steps of {}, {} flops a step, medians of {} rounds\n\n", members, steps, step,
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
