// The relief valve, 256 members at a tolerance of 1e-9, one core, beside Boost.Odeint's Cash–Karp on the same right-hand side.  A row
// whose periodic orbits are not those of a tight run (tests/golden/relief_valve.csv) has no rate.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/relief_valve_golden.hpp"
#include "bench/relief_valve_kernel.hpp"
#include "bench/relief_valve_odeint.hpp"
#include "bench/throughput/throughput.hpp"
#include "tests/models/by_isa.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(ValveIntegrator, integrate_valves)

namespace bench {
namespace {

constexpr std::size_t members = 256;
constexpr double tolerance = 1e-9, agreement = 1e-6;

using Orbits = std::vector<ValveOrbit>;

Orbits odeint_orbits() {
    Orbits orbits;
    for (std::size_t i = 0; i < members; ++i) orbits.push_back(odeint_valve_orbit(valve_inflow(i, members), tolerance));
    return orbits;
}

/// The engine records x alone, which is 0 at impacts and nowhere else on a periodic orbit.
ValveOrbit orbit_of(MemberRecord const& record, double const* lifts) {
    ValveOrbit orbit;
    orbit.steps = record.steps_accepted;
    orbit.rhs = record.rhs_evaluations;
    for (std::size_t i = 0; i < valve_recorded_events && record.status == Status::finished; ++i) {
        orbit.events.push_back({std::abs(lifts[i]) < 1e-9, lifts[i], 0, 0});
    }
    return orbit;
}

Orbits engine_orbits(ValveIntegrator* integrate) {
    std::vector<double> inflows(members), lifts(members * valve_recorded_events);
    for (std::size_t i = 0; i < members; ++i) inflows[i] = valve_inflow(i, members);
    std::vector<MemberRecord> records(members);
    integrate({inflows.data(), members, tolerance, records.data(), lifts.data()});
    Orbits orbits;
    for (std::size_t i = 0; i < members; ++i) orbits.push_back(orbit_of(records[i], &lifts[i * valve_recorded_events]));
    return orbits;
}

/// Empty where all periodic orbits are those of the tight run.
std::string difference_of(Orbits const& orbits) {
    auto const golden = testing::read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    for (std::size_t i = 0; i < members; ++i) {
        if (golden.at(i).period == 0) continue;
        double const difference = valve_difference(orbits[i], repeated(golden[i]), golden[i].period);
        if (!(difference <= agreement)) return fmt::format("member {}: its orbit is off by {:.2e}", i, difference);
    }
    return {};
}

void time_valves(benchmark::State& state, std::function<Orbits()> const& run) {
    Orbits orbits;
    for (auto _ : state) orbits = run();
    if (auto const difference = difference_of(orbits); !difference.empty()) return state.SkipWithError(difference.c_str());
    double steps = 0, evaluations = 0;
    for (auto const& orbit : orbits) steps += static_cast<double>(orbit.steps), evaluations += static_cast<double>(orbit.rhs);
    count_rate(state, "members/s", members);
    count_rate(state, "events/s", static_cast<double>(members * (valve_transient_events + valve_recorded_events)));
    count_rate(state, "rhs/s", evaluations);
    state.counters["rhs/member"] = evaluations / members;
    state.counters["steps/member"] = steps / members;
}

}  // namespace

void register_relief_valve() {
    for (Isa const isa : runnable_isas()) {
        auto* const integrate = integrate_valves_by_isa(isa);
        benchmark::RegisterBenchmark(("valve/extrema and impacts/" + std::string(name_of(isa))).c_str(), time_valves,
                                     [=] { return engine_orbits(integrate); })->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark("valve/extrema and impacts/odeint", time_valves, odeint_orbits)->Unit(benchmark::kMillisecond);
}

}  // namespace bench
}  // namespace slideway
