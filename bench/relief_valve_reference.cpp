#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "bench/relief_valve_odeint.hpp"
#include "bench/relief_valve_scalar.hpp"

namespace slideway::bench {
namespace {

using Number = long double;
using State = std::array<Number, 3>;

/// The equations, with the valve's rules of rest as tests/models/relief_valve.hpp states them.
struct PlainEquations {
    Number q;

    void rates(State const& y, State& dy) const {
        auto const [x, v, p] = y;
        Number const force = p - (x + 10) - 1.25L * v;
        bool const seated = x == 0 && v == 0 && force < 0;
        dy = {v, seated ? 0 : force, 20 * (q - x * std::sqrt(p > 0 ? p : 0))};
    }
    void reset(State& y) const {
        Number const rebound = -0.8L * y[1], below_opening = 10 - y[2];
        bool const last =
            rebound < 1e-6L && below_opening > 0 && 80 * q * rebound <= 0.2L * below_opening * below_opening;
        y[0] = 0;
        y[1] = last ? 0 : rebound;
    }
    static bool at_rest(State const& dy) {
        return std::abs(dy[0]) <= 1e-7L && std::abs(dy[1]) <= 1e-7L && std::abs(dy[2]) <= 1e-7L;
    }
};

}  // namespace

ValveOrbit reference_valve_orbit(double inflow, double tolerance) {
    using Stepper = boost::numeric::odeint::runge_kutta_fehlberg78<State, Number>;
    return ScalarValve<Stepper, PlainEquations>({inflow}, tolerance).run({0.2L, 0, 0});
}

}  // namespace slideway::bench
