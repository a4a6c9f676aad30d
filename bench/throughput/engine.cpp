// The whole engine as a run uses it, through the driver: scattered starts, ±20 % in clearances, crank speed, friction and damping; no
// quantity asked for.  One thread by its processor time, two by the wall clock, which need two free cores.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/engine_cases.hpp"
#include "bench/throughput/throughput.hpp"

namespace slideway::bench {
namespace {

struct Setting {
    EngineCase const* scene;
    std::size_t members;
    Isa isa;
    int threads;
};

void time_engine(benchmark::State& state, Setting const& setting) {
    auto const members = members_of(*setting.scene, setting.members);
    auto const backend = cpu_backend(setting.isa);
    EngineRun run;
    for (auto _ : state) run = run_engine(*setting.scene, members, *backend, setting.threads);
    auto const& t = run.totals;
    if (t.failed() > 0) return state.SkipWithError("a member did not come to its end");
    count_rate(state, "members/s", static_cast<double>(setting.members));
    count_rate(state, "rhs/s", static_cast<double>(t.rhs_evaluations + t.jacobian_evaluations));
    count_rate(state, "member-steps/s", static_cast<double>(t.steps_accepted + t.steps_rejected));
    state.counters["rhs/member"] = static_cast<double>(t.rhs_evaluations + t.jacobian_evaluations) / static_cast<double>(setting.members);
    state.counters["lanes in use"] = t.lane_utilisation();
}

void register_one(Setting const& setting) {
    auto const name = fmt::format("engine/{}, {} members/{}/threads:{}", setting.scene->name, setting.members, name_of(setting.isa),
                                  setting.threads);
    auto* const made = benchmark::RegisterBenchmark(name.c_str(), time_engine, setting)->Unit(benchmark::kMillisecond);
    if (setting.threads > 1) made->UseRealTime();
}

}  // namespace

void register_engine() {
    for (auto const& scene : engine_cases()) {
        for (Isa const isa : runnable_isas()) {
            for (int const threads : {1, 2}) register_one({&scene, 512, isa, threads});
            // What somebody tries out has few members: lanes that nobody fills cost as much as others.
            register_one({&scene, 32, isa, 1});
        }
    }
}

}  // namespace slideway::bench
