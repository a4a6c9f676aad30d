// Step control of Odeint's pairs in the norm of our error control.
#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <cmath>
#include <limits>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Error checker for Odeint: root mean square of error/(rtol |y| + atol scale) with rtol = atol.  NaN counts as a large
/// error; the default checker would accept it.
/// @tparam n components that are controlled, of which the first `states` make the mean.
template <class Number, std::size_t n> class ScaledErrorChecker {
public:
    template <class Scale>
    ScaledErrorChecker(Number tolerance, Scale const& scale, int states)
        : tolerance_(tolerance), states_(static_cast<Number>(states)) {
        for (std::size_t i = 0; i < n; ++i) absolute_[i] = tolerance * scale[i];
    }

    template <class Algebra, class State, class Deriv, class Error, class Time>
    Number error(Algebra&, State const& y, Deriv const&, Error const& y_error, Time) const {
        Number sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            Number const ratio = y_error[i] / (tolerance_ * std::fabs(y[i]) + absolute_[i]);
            sum += ratio * ratio;
        }
        return sum < Number(1e300) ? std::sqrt(sum / states_) : Number(1e150);
    }

private:
    Number tolerance_, states_;
    std::array<Number, n> absolute_;
};

/// One of Odeint's error steppers under that control.
template <class Stepper, class Number, std::size_t n>
using ScaledController =
    boost::numeric::odeint::controlled_runge_kutta<Stepper, ScaledErrorChecker<Number, n>,
                                                   boost::numeric::odeint::default_step_adjuster<Number, Number>>;

/// Steps y from 0 to the end.  @param give_up asked every 256 attempts.  @return whether it got there; false too where the
/// step fell below the resolution of time.
template <class Controller, class Rates, class State, class Number, class GiveUp>
bool integrate_to(Controller& controller, Rates const& rates, State& y, Number end, Number first_step,
                  GiveUp const& give_up) {
    Number t = 0, wish = first_step;
    Number const resolution = std::numeric_limits<Number>::epsilon() * end;
    for (unsigned attempts = 1;; ++attempts) {
        Number const remaining = end - t;
        bool const last = wish >= remaining;
        Number step = last ? remaining : wish;
        bool const accepted = controller.try_step(rates, y, t, step) == boost::numeric::odeint::success;
        if (accepted && last) return true;
        wish = step;
        if (wish < resolution || (attempts % 256 == 0 && give_up())) return false;
    }
}

/// The same with steps that may pass the end, whose state is taken from the pair's continuous extension.
template <class Controller, class Rates, class State, class GiveUp>
bool pass_densely(Controller const& controller, Rates const& rates, State& y, double end, double first_step,
                  GiveUp const& give_up) {
    boost::numeric::odeint::dense_output_runge_kutta<Controller> stepper(controller);
    stepper.initialize(y, 0.0, first_step);
    try {
        for (unsigned steps = 1; stepper.current_time() < end; ++steps) {
            stepper.do_step(rates);
            if (steps % 256 == 0 && give_up()) return false;
        }
    } catch (boost::numeric::odeint::step_adjustment_error const&) {
        return false;
    }
    stepper.calc_state(end, y);
    return true;
}

}  // namespace slideway::inline SLIDEWAY_ISA
