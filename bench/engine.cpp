// Members per second of the whole engine on one core, per instruction set and law.
// The ensemble is fixed: 256 starts of the 0.1 mm mechanism over 0.02 s, which holds two to four impacts each.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

void engine(benchmark::State& state, Isa isa, Parts parts, Selection quantities) {
    auto const members = testing::scattered_starts(256);
    testing::RunOptions options;
    options.parts = parts;
    options.quantities = quantities;
    options.settings.end_time = 0.02;
    std::uint64_t evaluations = 0, attempts = 0;
    double executed = 0, useful = 0;
    for (auto _ : state) {
        auto const r = testing::run(isa, options, members);
        benchmark::DoNotOptimize(r.states.data());
        evaluations = attempts = 0;
        for (auto const& record : r.records) {
            evaluations += record.rhs_evaluations;
            attempts += record.steps_accepted + record.steps_rejected;
        }
        executed = static_cast<double>(r.lane_steps_executed);
        useful = static_cast<double>(r.lane_steps_useful);
    }
    auto const rate = [](double n) { return benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate); };
    state.counters["members/s"] = rate(static_cast<double>(members.size()));
    state.counters["rhs/s"] = rate(static_cast<double>(evaluations));
    state.counters["member-steps/s"] = rate(static_cast<double>(attempts));
    state.counters["utilisation"] = executed > 0 ? useful / executed : 0;
}

int register_all() {
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        for (Law const law : {Law::paper, Law::conservative}) {
            for (bool const audit : {false, true}) {
                std::string const name = std::string("engine/") + std::string(name_of(isa)) +
                                         (law == Law::paper ? "/paper" : "/conservative") + (audit ? "/audit" : "");
                Selection const quantities = audit ? Selection(1) << static_cast<int>(Quantity::energy_residual) : 0;
                benchmark::RegisterBenchmark(name.c_str(), engine, isa, Parts{law, Damping::point, true, false},
                                             quantities)
                    ->Unit(benchmark::kMillisecond);
            }
        }
    }
    return 0;
}

int const registered = register_all();

}  // namespace
}  // namespace slideway

BENCHMARK_MAIN();
