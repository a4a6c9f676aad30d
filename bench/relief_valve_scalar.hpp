// One orbit of the relief valve by a Boost.Odeint error stepper, one member at a time, events located to the last bits: what a
// careful user of a scalar library writes.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <cmath>

#include "bench/relief_valve_orbit.hpp"

namespace slideway::bench {

/// @tparam Equations rates(state, derivative), reset(state) after an impact, at_rest(derivative), for states of `Number`.
template <class Stepper, class Equations> class ScalarValve {
public:
    using State = typename Stepper::state_type;
    using Number = typename Stepper::value_type;

    ScalarValve(Equations const& equations, Number tolerance)
        : equations_(equations),
          controlled_(boost::numeric::odeint::make_controlled(tolerance, tolerance, Stepper())) {}

    /// The events of the orbit from `start`, after the transient ones; fewer if it comes neither to them nor, at a coarse tolerance,
    /// to rest.
    ValveOrbit run(State const& start) {
        y_ = start;
        auto const rates = rates_counter();
        rates(y_, dy_, Number(0));
        Number step(1e-3);
        for (std::size_t seen = 0;
             seen < valve_transient_events + valve_recorded_events && orbit_.steps < most_steps;) {
            Number time(0);
            while (controlled_.try_step(rates, y_, dy_, time, end_, step) != boost::numeric::odeint::success) {}
            step = std::min(step, Number(0.5));
            ++orbit_.steps;
            rates(end_, end_dy_, Number(0));
            ValveEvent event;
            bool const found = locate_first(time, event);
            y_ = end_;
            if (found) {
                if (event.impact) {
                    equations_.reset(y_);
                } else {
                    y_[1] = 0;
                }
                rates(y_, dy_, Number(0));
                if (seen++ >= valve_transient_events) orbit_.events.push_back(event);
            } else {
                dy_ = end_dy_;
                if (equations_.at_rest(dy_)) return rest();
            }
        }
        return orbit_;
    }

private:
    static constexpr std::uint64_t most_steps = 2'000'000;

    auto rates_counter() {
        return [this](State const& y, State& dy, Number) {
            ++orbit_.rhs;
            equations_.rates(y, dy);
        };
    }

    /// First event of the step from y_ to end_, if there is one; end_ is then its state.
    bool locate_first(Number length, ValveEvent& event) {
        // An extremum leaves v = 0, and the acceleration tells which way it goes.
        Number const direction = y_[1] != 0 ? y_[1] : dy_[1];
        bool const turns = direction * end_[1] < 0;
        if (!turns && !(end_[0] < 0)) return false;
        if (turns) length = locate(1, length);
        // On its way down the disc may meet the seat before it turns.
        event.impact = direction < 0 && end_[0] < 0;
        if (event.impact) {
            locate(0, length);
            end_[0] = 0;
        }
        event.x = static_cast<double>(end_[0]);
        event.v = event.impact ? static_cast<double>(end_[1]) : 0.0;
        event.p = static_cast<double>(end_[2]);
        return true;
    }

    /// Zero of a component between y_ (t = 0) and end_ (t = length), where its sign differs: Newton's method on single steps from
    /// y_, kept within the bracket.  @return its time; end_ is the state there.
    Number locate(int component, Number length) {
        auto const rates = rates_counter();
        rates(end_, end_dy_, Number(0));
        bool const above = end_[component] > 0;
        Number low(0), high = length, time = cubic_zero(component, length);
        for (int i = 0; i < 60; ++i) {
            stepper_.do_step(rates, y_, dy_, Number(0), end_, time);
            if ((end_[component] > 0) == above) {
                high = time;
            } else {
                low = time;
            }
            rates(end_, end_dy_, Number(0));
            Number next = time - end_[component] / end_dy_[component];
            if (!(next >= low && next <= high)) next = (low + high) / 2;
            Number const change = std::abs(next - time);
            time = next;
            // Newton's error after this correction is of the order of its square.
            if (change <= Number(1e-8) * time) break;
        }
        stepper_.do_step(rates, y_, dy_, Number(0), end_, time);
        return time;
    }

    /// Zero of the cubic through values and slopes at both ends, to a thousandth of the step.
    Number cubic_zero(int component, Number length) const {
        Number const a = y_[component], change = end_[component] - a;
        Number const start = length * dy_[component] - change, stop = change - length * end_dy_[component];
        bool const above = end_[component] > 0;
        Number low(0), high(1);
        for (int i = 0; i < 10; ++i) {
            Number const at = (low + high) / 2, rest = 1 - at;
            Number const value = a + at * (change + rest * (rest * start + at * stop));
            ((value > 0) == above ? high : low) = at;
        }
        return length * (low + high) / 2;
    }

    ValveOrbit rest() {
        orbit_.at_rest = true;
        orbit_.events.assign(valve_recorded_events,
                             {false, static_cast<double>(y_[0]), 0.0, static_cast<double>(y_[2])});
        return orbit_;
    }

    Equations equations_;
    decltype(boost::numeric::odeint::make_controlled(Number(), Number(), Stepper())) controlled_;
    Stepper stepper_;
    State y_, dy_, end_, end_dy_;
    ValveOrbit orbit_;
};

}  // namespace slideway::bench
