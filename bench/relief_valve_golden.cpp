#include "bench/relief_valve_golden.hpp"

#include <fstream>
#include <iomanip>

namespace slideway::bench {

ValveOrbit repeated(ValveGolden const& golden) {
    ValveOrbit orbit;
    if (golden.period == 0) return orbit;
    for (std::size_t i = 0; i < valve_recorded_events; ++i) orbit.events.push_back(golden.events[i % golden.period]);
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

}  // namespace slideway::bench
