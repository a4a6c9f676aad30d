// The relief valve, N = 256, tolerance 1e-9, one core: processor time of the engine in every instruction set and of the peer, all of them
// in every round, and whether the extrema are those of a tight run (tests/golden/relief_valve.csv).
//   bench_relief_valve [ROUNDS]                the table, medians of ROUNDS (9)
//   bench_relief_valve --write-reference FILE  makes the tight run's file (about a minute)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "bench/median.hpp"
#include "bench/relief_valve_golden.hpp"
#include "bench/relief_valve_kernel.hpp"
#include "bench/relief_valve_odeint.hpp"
#include "host/backend/by_isa.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(ValveIntegrator, integrate_valves)

namespace {

using namespace bench;

constexpr std::size_t members = 256;
constexpr double tolerance = 1e-9, agreement = 1e-6;

using Orbits = std::vector<ValveOrbit>;

struct Row {
    std::string name;
    std::function<Orbits()> run;
    Orbits orbits;
    std::vector<double> seconds;
};

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

std::vector<Row> make_rows() {
    std::vector<Row> rows{{"Odeint Cash-Karp 5(4)", odeint_orbits, {}, {}}};
    for (Isa const isa : built_isas()) {
        if (!is_supported(isa)) continue;
        auto* const run = integrate_valves_by_isa(isa);
        rows.push_back(
            {std::string("slideway, ") + std::string(name_of(isa)), [run] { return engine_orbits(run); }, {}, {}});
    }
    return rows;
}

/// Of the processor, not of the clock: other work on the machine counts for little.
void measure(Row& row) {
    auto const start = std::clock();
    row.orbits = row.run();
    row.seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}

/// Ratio of two rows' times, round by round, so that what slows a round slows both.
double median_ratio(Row const& slow, Row const& fast) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < slow.seconds.size(); ++i) ratios.push_back(slow.seconds[i] / fast.seconds[i]);
    return median(ratios);
}

struct Comparison {
    std::size_t periodic = 0, same = 0;
    double worst = 0;  // of those that are the same
};

Comparison compare(Row const& row, std::vector<ValveGolden> const& golden) {
    Comparison c;
    for (std::size_t i = 0; i < members; ++i) {
        if (golden[i].period == 0) continue;
        ++c.periodic;
        double const difference = valve_difference(row.orbits[i], golden[i].orbit(), golden[i].period);
        if (difference <= agreement) {
            ++c.same;
            c.worst = std::max(c.worst, difference);
        } else {
            fmt::print(stderr, "{}: member {}, q = {:.4f}: off by {:.2e}\n", row.name, i, valve_inflow(i, members),
                       difference);
        }
    }
    return c;
}

bool same_bits(Orbits const& a, Orbits const& b) {
    auto const equal = [](ValveEvent const& e, ValveEvent const& f) {
        return std::memcmp(&e.x, &f.x, sizeof e.x) == 0;
    };
    return std::ranges::equal(a, b, [&](ValveOrbit const& o, ValveOrbit const& p) {
        return o.steps == p.steps && std::ranges::equal(o.events, p.events, equal);
    });
}

/// @return whether every periodic orbit of every row is that of the tight run.
bool print_table(std::vector<Row> const& rows, std::vector<ValveGolden> const& golden) {
    auto const& peer = rows[0];
    auto const& scalar = rows[1];
    fmt::print("# Relief valve, {} members, tolerance {}, one core\n\n{}- flags: {}\n", members, tolerance,
               machine_and_build(), flags_of(best_isa()));
    fmt::print("- transient of {} extrema or impacts, {} recorded; medians of {} rounds, ratios round by round\n\n",
               valve_transient_events, valve_recorded_events, peer.seconds.size());
    fmt::print(
        "| | seconds | members/s | over Odeint | over scalar | steps/member | rhs/member | ns/rhs | periodic orbits "
        "within {:.0e} | "
        "worst of them | bits as scalar |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        agreement);
    bool all_same = true;
    for (auto const& row : rows) {
        double steps = 0, rhs = 0;
        for (auto const& orbit : row.orbits)
            steps += static_cast<double>(orbit.steps), rhs += static_cast<double>(orbit.rhs);
        auto const c = compare(row, golden);
        all_same = all_same && c.same == c.periodic;
        double const time = median(row.seconds);
        fmt::print("| {} | {:.3f} | {:.0f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.2f} | {} of {} | {:.1e} | {} |\n",
                   row.name, time, members / time, median_ratio(peer, row), median_ratio(scalar, row), steps / members,
                   rhs / members, time * 1e9 / rhs, c.same, c.periodic, c.worst,
                   &row == &peer                          ? ""
                   : same_bits(row.orbits, scalar.orbits) ? "yes"
                                                          : "no");
    }
    return all_same;
}

int write_reference(char const* path) {
    std::vector<ValveGolden> golden;
    for (std::size_t i = 0; i < members; ++i) {
        golden.push_back(
            valve_golden(reference_valve_orbit(valve_inflow(i, members), 1e-13), valve_inflow(i, members)));
    }
    return write_valve_golden(path, golden) ? 0 : 1;
}

int benchmark(int rounds) {
    auto const golden = read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    if (golden.size() != members) {
        fmt::print(stderr, "{}/golden/relief_valve.csv: {} members ({} are needed)\n", SLIDEWAY_TEST_DATA,
                   golden.size(), members);
        return 1;
    }
    auto rows = make_rows();
    if (rows.size() < 2) {
        fmt::print(stderr, "this machine has no fused multiply-add\n");
        return 1;
    }
    for (int round = 0; round < rounds; ++round) {
        for (auto& row : rows) measure(row);
    }
    return print_table(rows, golden) ? 0 : 1;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--write-reference") == 0) return slideway::write_reference(argv[2]);
    int const rounds = argc > 1 ? std::atoi(argv[1]) : 9;
    if (argc > 2 || rounds < 1) {
        fmt::print(stderr, "usage: bench_relief_valve [ROUNDS] | --write-reference FILE\n");
        return 2;
    }
    return slideway::benchmark(rounds);
}
