// The model's derivative and reset against periodic orbits of an independent program (80-bit numbers, Fehlberg 8(7) at 1e-13,
// equations of its own): from every event of an orbit the model must reach the next.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernels/steppers/pair_numbers.hpp"
#include "kernels/steppers/runge_kutta4.hpp"
#include "tests/models/relief_valve.hpp"
#include "tests/support/valve_golden.hpp"

namespace slideway::relief_valve_test {
namespace {

using State = std::array<double, 3>;

using testing::ValveEvent;

State state_at(ValveEvent const& e) { return {e.x, e.v, e.p}; }

std::vector<testing::ValveGolden> periodic_orbits() {
    auto orbits = testing::read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    std::erase_if(orbits, [](auto const& orbit) { return orbit.events.empty(); });
    return orbits;
}

class Valve {
public:
    explicit Valve(double inflow) : p_(ReliefValve::parameters({.inflow = inflow})) {}

    /// The next impact or extremum, by small equal steps and bisection of the last.
    ValveEvent next(ValveEvent const& from) const {
        State y = state_at(from);
        if (from.impact) ReliefValve::reset(ReliefValve::impact, true, y.data(), p_);
        double const direction = y[1] != 0 ? y[1] : rates(y)[1];
        auto const beyond = [&](State const& s) { return s[1] * direction < 0 || (direction < 0 && s[0] < 0); };
        double h = 2e-4;
        State end = step(y, h);
        for (int i = 0; i < 1'000'000 && !beyond(end); ++i) y = end, end = step(y, h);
        double low = 0, high = h;
        for (int i = 0; i < 60; ++i) (beyond(step(y, (low + high) / 2)) ? high : low) = (low + high) / 2;
        end = step(y, high);
        bool const impact = direction < 0 && end[0] < 1e-9 && end[1] < 0;
        return {impact, end[0], end[1], end[2]};
    }

private:
    State rates(State const& y) const {
        State dy;
        ReliefValve::Report<double> report;
        ReliefValve::derivative<false>(0.0, y.data(), p_, {}, dy.data(), &report);
        return dy;
    }

    State step(State const& y, double h) const {
        double k[5][3];
        State at = y;
        auto const slope = [&](int s) {
            auto const dy = rates(at);
            for (int i = 0; i < 3; ++i) k[s][i] = dy[static_cast<std::size_t>(i)];
        };
        slope(0);
        for (int s = 1; s < 5; ++s) {
            pair_numbers<RungeKutta4>().stage_state(s, y.data(), k, h, at.data());
            if (s < 4) slope(s);
        }
        return at;
    }

    ReliefValve::Parameters<double> p_;
};

TEST(ReliefValveOrbits, FollowAnIndependentProgramFromEventToEvent) {
    auto const orbits = periodic_orbits();
    ASSERT_GT(orbits.size(), 200u);
    std::size_t impacts = 0, extrema = 0;
    for (auto const& orbit : orbits) {
        if (orbit.events.size() == 1) continue;  // an equilibrium
        Valve const valve(orbit.inflow);
        for (std::size_t i = 0; i < orbit.events.size(); ++i) {
            auto const& want = orbit.events[(i + 1) % orbit.events.size()];
            auto const got = valve.next(orbit.events[i]);
            ASSERT_EQ(got.impact, want.impact) << "q = " << orbit.inflow << ", event " << i;
            for (std::size_t j = 0; j < 3; ++j) {
                EXPECT_NEAR(state_at(got)[j], state_at(want)[j], 1e-6)
                    << "q = " << orbit.inflow << ", event " << i << ", " << j;
            }
            ++(want.impact ? impacts : extrema);
        }
    }
    EXPECT_GT(impacts, 150u);
    EXPECT_GT(extrema, 250u);
}

TEST(ReliefValveOrbits, EndAtRestWhereTheInflowIsLarge) {
    for (auto const& orbit : periodic_orbits()) {
        if (orbit.inflow < 8.7) continue;
        // The equilibrium: x √(x + 10) = q.
        double const x = orbit.events.front().x;
        EXPECT_EQ(orbit.events.size(), 1u) << orbit.inflow;
        EXPECT_NEAR(x * std::sqrt(x + 10), orbit.inflow, 1e-6);
    }
}

}  // namespace
}  // namespace slideway::relief_valve_test
