#include "bench/relief_valve_odeint.hpp"

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include "bench/relief_valve_scalar.hpp"
#include "tests/models/relief_valve.hpp"

namespace slideway::bench {
namespace {

using State = std::array<double, 3>;

struct KernelEquations {
    ReliefValve::Parameters<double> parameters;

    void rates(State const& y, State& dy) const {
        ReliefValve::derivative<false>(0.0, y.data(), parameters, {}, dy.data(),
                                       static_cast<ReliefValve::Report<double>*>(nullptr));
    }
    void reset(State& y) const { ReliefValve::reset(ReliefValve::impact, true, y.data(), parameters); }
    static bool at_rest(State const& dy) { return ReliefValve::at_rest(dy.data()); }
};

}  // namespace

ValveOrbit odeint_valve_orbit(double inflow, double tolerance) {
    using Stepper = boost::numeric::odeint::runge_kutta_cash_karp54<State>;
    ReliefValve::Inputs const inputs{.inflow = inflow};
    State start;
    ReliefValve::initial_state(inputs, start.data());
    return ScalarValve<Stepper, KernelEquations>({ReliefValve::parameters(inputs)}, tolerance).run(start);
}

}  // namespace slideway::bench
