// Makes tests/golden/relief_valve.csv: the relief valve's orbits in a tight run, in 80-bit numbers and by equations of its own.  A minute.
//   write_valve_golden FILE
#include <fmt/format.h>

#include "bench/relief_valve_golden.hpp"
#include "bench/relief_valve_odeint.hpp"

int main(int argc, char** argv) {
    using namespace slideway::bench;
    if (argc != 2) {
        fmt::print(stderr, "usage: write_valve_golden FILE\n");
        return 2;
    }
    constexpr std::size_t members = 256;
    std::vector<ValveGolden> golden;
    for (std::size_t i = 0; i < members; ++i) {
        double const inflow = valve_inflow(i, members);
        golden.push_back(valve_golden(reference_valve_orbit(inflow, 1e-13), inflow));
    }
    return write_valve_golden(argv[1], golden) ? 0 : 1;
}
