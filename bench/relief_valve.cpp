// The relief valve, N = 256, tolerance 1e-9: seconds on one core, and whether the extrema are those of a tight run.
//   relief_valve                         the peer, against tests/golden/relief_valve.csv
//   relief_valve --write-reference FILE  makes that file (about a minute)
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "bench/relief_valve_golden.hpp"
#include "bench/relief_valve_odeint.hpp"

namespace {

using namespace slideway::bench;

constexpr std::size_t members = 256;
constexpr double tolerance = 1e-9;

struct Timing {
    std::vector<ValveOrbit> orbits;
    double seconds = 0;  // median of the repeats
};

Timing time_odeint(int repeats) {
    Timing t;
    std::vector<double> seconds;
    for (int r = 0; r < repeats; ++r) {
        t.orbits.clear();
        auto const start = std::clock();  // of the processor: other work counts for little
        for (std::size_t i = 0; i < members; ++i) {
            t.orbits.push_back(odeint_valve_orbit(valve_inflow(i, members), tolerance));
        }
        seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
    t.seconds = seconds[static_cast<std::size_t>(repeats) / 2];
    return t;
}

void report(char const* name, Timing const& t, std::vector<ValveGolden> const& golden) {
    std::uint64_t steps = 0, rhs = 0;
    std::size_t periodic = 0, same = 0, resting = 0;
    double worst = 0;
    for (std::size_t i = 0; i < members; ++i) {
        steps += t.orbits[i].steps;
        rhs += t.orbits[i].rhs;
        resting += t.orbits[i].at_rest;
        if (golden[i].period == 0) continue;
        ++periodic;
        double const difference = valve_difference(t.orbits[i], golden[i].orbit(), golden[i].period);
        if (difference <= 1e-6) {
            ++same;
            worst = std::max(worst, difference);
        } else {
            std::printf("  %s: member %zu, q = %.4f: off by %.2e\n", name, i, valve_inflow(i, members), difference);
        }
    }
    std::printf("%-24s %8.3f s %8.1f members/s %12llu steps %13llu rhs  %6.2f ns/rhs  %zu at rest\n", name, t.seconds,
                static_cast<double>(members) / t.seconds, static_cast<unsigned long long>(steps),
                static_cast<unsigned long long>(rhs), t.seconds * 1e9 / static_cast<double>(rhs), resting);
    std::printf("%-24s extrema of %zu of %zu periodic orbits within 1e-6, worst of them %.1e\n", "", same, periodic,
                worst);
}

int write_reference(char const* path) {
    std::vector<ValveGolden> golden;
    for (std::size_t i = 0; i < members; ++i) {
        golden.push_back(
            valve_golden(reference_valve_orbit(valve_inflow(i, members), 1e-13), valve_inflow(i, members)));
    }
    return write_valve_golden(path, golden) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--write-reference") == 0) return write_reference(argv[2]);
    auto const golden = read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    if (golden.size() != members) {
        std::fprintf(stderr, "%s/golden/relief_valve.csv: %zu members (%zu are needed)\n", SLIDEWAY_TEST_DATA,
                     golden.size(), members);
        return 1;
    }
    report("Odeint Cash-Karp 5(4)", time_odeint(5), golden);
}
