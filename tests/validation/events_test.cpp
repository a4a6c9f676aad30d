// The relief valve through the lanes against periodic orbits of an independent program (80-bit numbers, Fehlberg 8(7) at 1e-13).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/models/models.hpp"
#include "tests/support/valve_golden.hpp"

namespace slideway::events_test {
namespace {

/// Largest difference of a record of lifts from the repeated period, begun where it fits best: a transient of other length shifts it.
double difference(double const* recorded, std::vector<testing::ValveEvent> const& period) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t shift = 0; shift < period.size(); ++shift) {
        double largest = 0;
        for (std::size_t i = 0; i < testing::recorded_valve_events; ++i) {
            double const off = std::abs(recorded[i] - period[(i + shift) % period.size()].x);
            largest = off <= largest ? largest : off;  // NaN too
        }
        least = std::min(least, largest);
    }
    return least;
}

TEST(ReliefValveLanes, HaveTheExtremaOfEveryPeriodicOrbit) {
    auto const orbits = testing::read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    ASSERT_EQ(orbits.size(), 256u);
    std::vector<testing::ValveInputs> members;
    for (auto const& orbit : orbits) members.push_back({orbit.inflow});
    IntegratorSettings settings;
    settings.method = Method::dopri5;
    settings.rtol = settings.atol = 1e-9;
    settings.end_time = 1e5;
    settings.max_step = 1;
    auto const r = testing::run(best_isa(), settings, members);
    std::size_t periodic = 0;
    double worst = 0;
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        EXPECT_EQ(r.records[i].status, Status::finished) << "q = " << orbits[i].inflow;
        EXPECT_LT(r.records[i].time, settings.end_time) << "ends with its last event, q = " << orbits[i].inflow;
        if (orbits[i].events.empty()) continue;
        ++periodic;
        double const off = difference(&r.quantities[i * testing::recorded_valve_events], orbits[i].events);
        EXPECT_LE(off, 1e-6) << "member " << i << ", q = " << orbits[i].inflow;
        worst = std::max(worst, off);
    }
    EXPECT_GT(periodic, 200u);
    RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace slideway::events_test
