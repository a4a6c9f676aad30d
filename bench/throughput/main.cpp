// What this program does in a second: functions, laws, right-hand sides, whole runs, studies, and two models of the field beside
// Boost.Odeint, in every instruction set of this build that this machine runs.
//
//   bench_throughput [--benchmark_filter=REGEX] [--benchmark_out=FILE.json] [--benchmark_repetitions=N] …
//
// Options are Google Benchmark's (--help).  Ratios hold where the rows took turns: --benchmark_enable_random_interleaving=true with
// several repetitions, and medians.  bench/compare.py compares two builds, scripts/bench.sh makes table and picture.
#include "bench/throughput/throughput.hpp"

#include "host/store/run_identity.hpp"

namespace slideway::bench {

std::vector<Isa> runnable_isas() {
    std::vector<Isa> isas;
    for (Isa const isa : built_isas()) {
        if (is_supported(isa)) isas.push_back(isa);
    }
    return isas;
}

void count_rate(benchmark::State& state, std::string const& name, double per_iteration) {
    state.counters[name] = benchmark::Counter(per_iteration, benchmark::Counter::kIsIterationInvariantRate);
}

namespace {

/// What a committed figure must say about where it was measured.
void add_context() {
    auto const& build = build_info();
    benchmark::AddCustomContext("cpu", machine_name());
    benchmark::AddCustomContext("compiler", build.compiler);
    benchmark::AddCustomContext("commit", build.commit);
    for (Isa const isa : runnable_isas()) {
        benchmark::AddCustomContext("flags, " + std::string(name_of(isa)), flags_of(isa));
    }
}

}  // namespace
}  // namespace slideway::bench

int main(int argc, char** argv) {
    using namespace slideway::bench;
    register_peak();
    register_functions();
    register_linkages();
    register_laws();
    register_right_hand_sides();
    register_engine();
    register_lorenz();
    register_relief_valve();
    register_study();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    add_context();
    // 0 where the filter leaves nothing: a script that mistyped it must not take silence for speed.
    bool const any = benchmark::RunSpecifiedBenchmarks() > 0;
    benchmark::Shutdown();
    return any ? 0 : 1;
}
