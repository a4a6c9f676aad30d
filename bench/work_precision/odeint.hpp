// Boost.Odeint: explicit pairs with its own step control, on std::array, so that its algebra unrolls.
#pragma once

#include <algorithm>

#include "bench/work_precision/error_norm.hpp"
#include "bench/work_precision/trajectory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Controlled steps that end at the end time, or free ones and dense output.
enum class OdeintEnd { step, dense };

/// @tparam Pair an error stepper of Odeint, by the type of its state.
template <template <class...> class Pair, OdeintEnd end = OdeintEnd::step> struct Odeint {
    template <class System> class Solver {
    public:
        explicit Solver(Odeint const&) {}

        Trajectory<System> run(System const& system, Limits const& limits) const {
            if constexpr (System::audits > 0) {
                if (limits.audited) return run<System::size + System::audits>(system, limits);
            }
            return run<System::size>(system, limits);
        }

    private:
        template <std::size_t n> static Trajectory<System> run(System const& system, Limits const& limits) {
            using State = std::array<double, n>;
            using Controller = ScaledController<Pair<State>, double, n>;
            Controller controller(typename Controller::error_checker_type(limits.tolerance, system.scale, System::size),
                                  typename Controller::step_adjuster_type(limits.max_step));
            auto const rates = [&system](State const& x, State& dxdt, double t) {
                if constexpr (n == System::size) {
                    system.rates(t, x.data(), dxdt.data());
                } else {
                    system.audited_rates(t, x.data(), dxdt.data());
                }
            };
            auto const late = [&] { return bench::Clock::now() > limits.deadline; };
            State x{};
            std::copy(system.start.begin(), system.start.end(), x.begin());
            double const first_step = 1e-3 * limits.max_step;
            Trajectory<System> result{};
            if constexpr (end == OdeintEnd::dense) {
                result.finished = pass_densely(controller, rates, x, limits.end_time, first_step, late);
            } else {
                result.finished = integrate_to(controller, rates, x, limits.end_time, first_step, late);
            }
            std::copy(x.begin(), x.end(), result.end.begin());
            return result;
        }
    };
};

}  // namespace slideway::inline SLIDEWAY_ISA
