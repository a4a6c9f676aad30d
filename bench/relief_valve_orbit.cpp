#include "bench/relief_valve_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slideway::bench {

double valve_inflow(std::size_t member, std::size_t members) {
    return 0.2 + 9.8 * static_cast<double>(member) / static_cast<double>(members - 1);
}

std::size_t valve_period(ValveOrbit const& orbit, double tolerance) {
    auto const& events = orbit.events;
    for (std::size_t period = 1; period <= events.size() / 2; ++period) {
        std::size_t i = 0;
        while (i + period < events.size() && events[i].impact == events[i + period].impact &&
               std::abs(events[i].x - events[i + period].x) <= tolerance) {
            ++i;
        }
        if (i + period == events.size()) return period;
    }
    return 0;
}

double valve_difference(ValveOrbit const& a, ValveOrbit const& b, std::size_t period) {
    double const infinity = std::numeric_limits<double>::infinity();
    if (period == 0 || a.events.size() < 2 * period || b.events.size() < 2 * period) return infinity;
    double least = infinity;
    for (std::size_t shift = 0; shift < period; ++shift) {
        double largest = 0;
        for (std::size_t i = 0; i < a.events.size() && i + shift < b.events.size(); ++i) {
            auto const &own = a.events[i], &other = b.events[i + shift];
            largest = std::max(largest, own.impact == other.impact ? std::abs(own.x - other.x) : infinity);
        }
        least = std::min(least, largest);
    }
    return least;
}

}  // namespace slideway::bench
