#include "bench/relief_valve_golden.hpp"

#include <fstream>
#include <iomanip>
#include <sstream>

namespace slideway::bench {

ValveOrbit ValveGolden::orbit() const {
    ValveOrbit orbit;
    for (std::size_t i = 0; period > 0 && i < valve_recorded_events; ++i) orbit.events.push_back(events[i % period]);
    return orbit;
}

ValveGolden valve_golden(ValveOrbit const& orbit, double inflow) {
    ValveGolden golden{inflow, valve_period(orbit, 1e-7), {}};
    golden.events.assign(orbit.events.end() - static_cast<std::ptrdiff_t>(golden.period), orbit.events.end());
    return golden;
}

bool write_valve_golden(std::string const& path, std::vector<ValveGolden> const& golden) {
    std::ofstream out(path);
    out << "member,inflow,period,impact,x,v,p\n" << std::setprecision(17);
    for (std::size_t member = 0; member < golden.size(); ++member) {
        auto const& g = golden[member];
        if (g.period == 0) out << member << ',' << g.inflow << ",0\n";
        for (auto const& e : g.events) {
            out << member << ',' << g.inflow << ',' << g.period << ',' << e.impact << ',' << e.x << ',' << e.v << ','
                << e.p << '\n';
        }
    }
    return static_cast<bool>(out.flush());
}

std::vector<ValveGolden> read_valve_golden(std::string const& path) {
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

}  // namespace slideway::bench
