// Periodic orbits of the relief valve as tests/golden/relief_valve.csv has them, of an independent program.
#pragma once

#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace slideway::testing {

struct ValveEvent {
    bool impact = false;  // else an extremum of x
    double x = 0;         // lift, 0 at impacts
    double v = 0;         // speed, before the impact
    double p = 0;         // pressure
};

struct ValveGolden {
    double inflow = 0;
    std::size_t period = 0;          // 0: the recorded events do not repeat
    std::vector<ValveEvent> events;  // [period]
};

/// Columns member,inflow,period,impact,x,v,p; a member without a period has one row that ends after its 0.
/// @return empty if the file cannot be read.
inline std::vector<ValveGolden> read_valve_golden(std::string const& path) {
    std::ifstream in(path);
    std::vector<ValveGolden> golden;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream row(line);
        char comma = 0;
        std::size_t member = 0, period = 0;
        double inflow = 0;
        row >> member >> comma >> inflow >> comma >> period;
        if (member == golden.size()) golden.push_back({inflow, period, {}});
        ValveEvent e;
        if (row >> comma >> e.impact >> comma >> e.x >> comma >> e.v >> comma >> e.p) golden.back().events.push_back(e);
    }
    return golden;
}

}  // namespace slideway::testing
