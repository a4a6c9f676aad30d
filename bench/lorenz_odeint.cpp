#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

#include "bench/lorenz_kernel.hpp"

namespace slideway {

void odeint_lorenz(LorenzRun const& run) {
    using State = std::array<double, 3>;
    boost::numeric::odeint::runge_kutta4<State> stepper;
    for (std::size_t i = 0; i < run.members; ++i) {
        double const rho = run.rho[i], sigma = 10, beta = 8.0 / 3.0;
        auto const rates = [=](State const& s, State& ds, double) {
            ds[0] = sigma * (s[1] - s[0]);
            ds[1] = s[0] * (rho - s[2]) - s[1];
            ds[2] = s[0] * s[1] - beta * s[2];
        };
        State s{10, 10, 10};
        for (std::uint64_t n = 0; n < run.steps; ++n) {
            stepper.do_step(rates, s, static_cast<double>(n) * run.step, run.step);
        }
        for (std::size_t j = 0; j < 3; ++j) run.states[3 * i + j] = s[j];
    }
}

}  // namespace slideway
