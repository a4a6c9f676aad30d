#include "bench/work_precision/references.hpp"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <stdexcept>

#include "bench/work_precision/bouncing_solution.hpp"
#include "bench/work_precision/error_norm.hpp"
#include "host/backend/backend.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/support/starting_in.hpp"

namespace slideway::bench {
namespace {

namespace odeint = boost::numeric::odeint;
using Real = long double;
template <std::size_t n> using State = std::array<Real, n>;
constexpr double largest_difference = 1e-11;

template <std::size_t n> std::vector<double> rounded(State<n> const& y) { return {y.begin(), y.end()}; }

/// The state at the end with rtol = atol.
template <class Stepper, std::size_t n, class Rates>
std::vector<double> integrated(Rates const& rates, State<n> y, std::vector<double> const& scale, Real tolerance,
                               Problem const& problem) {
    using Controller = ScaledController<Stepper, Real, n>;
    Controller controller(typename Controller::error_checker_type(tolerance, scale, n),
                          typename Controller::step_adjuster_type(problem.max_step));
    Real const end = problem.end_time;
    if (!integrate_to(controller, rates, y, end, 1e-6L * end, [] { return false; })) {
        throw std::runtime_error(problem.name + ": a reference fell below the resolution of time");
    }
    return rounded(y);
}

/// @tparam n ten, or twelve of a slider that is free along the way
template <std::size_t n> State<n> start_of(Inputs const& in) {
    State<n> y = {in.y, in.z, in.vy, in.vz, in.roll, in.yaw, in.pitch, in.wx, in.wy, in.wz};
    if constexpr (n > state_size) {
        y[state_size] = in.x;
        y[state_size + 1] = in.vx;
    }
    return y;
}

template <std::size_t n> auto oracle_rates(Inputs const& inputs, Parts const& parts) {
    return [&](State<n> const& y, State<n>& slope, Real t) {
        oracle::State state{};
        for (std::size_t i = 0; i < n; ++i) state[i] = static_cast<double>(y[i]);
        auto const r = oracle::evaluate(inputs, parts, static_cast<double>(t), state);
        for (std::size_t i = 0; i < n; ++i) slope[i] = r.derivative[i];
    };
}

template <std::size_t n> auto kernel_rates(Inputs const& inputs, Parts const& parts) {
    return [&inputs, instance = find_instance(Isa::scalar, parts)](State<n> const& y, State<n>& slope, Real t) {
        Inputs const in = testing::starting_in(inputs, y);
        double const time = static_cast<double>(t);
        ProbeResult result;
        instance.probe({&in, &time, 1, &result});
        for (std::size_t i = 0; i < n; ++i) slope[i] = result.derivative[i];
    };
}

struct Pair {
    std::vector<double> first, second;
};

template <std::size_t n> Pair both_of(SliderEnsemble const& ensemble, std::size_t i, Problem const& problem) {
    auto const& in = ensemble.members[i];
    auto const scale = scales(problem.ensemble, i);
    return {integrated<odeint::runge_kutta_cash_karp54<State<n>, Real>>(oracle_rates<n>(in, ensemble.parts),
                                                                        start_of<n>(in), scale, 1e-15L, problem),
            integrated<odeint::runge_kutta_dopri5<State<n>, Real>>(kernel_rates<n>(in, ensemble.parts), start_of<n>(in),
                                                                   scale, 1e-15L, problem)};
}

Pair both(SliderEnsemble const& ensemble, std::size_t i, Problem const& problem) {
    return ensemble.parts.mechanism == Mechanism::free_slider ? both_of<12>(ensemble, i, problem)
                                                               : both_of<state_size>(ensemble, i, problem);
}

Pair both(ValveEnsemble const&, std::size_t, Problem const& problem) {
    throw std::logic_error(problem.name + ": its reference is a file");
}

Pair both(BouncingEnsemble const& ensemble, std::size_t i, Problem const& problem) {
    auto const end = bouncing_solution(ensemble.members[i], problem.end_time);
    auto const state = rounded(State<3>{end.y, end.v, static_cast<Real>(end.face)});
    return {state, state};
}

Pair both(LorenzEnsemble const& ensemble, std::size_t i, Problem const& problem) {
    auto const& member = ensemble.members[i];
    State<3> y = {member.start[0], member.start[1], member.start[2]};
    auto const rates = [&](State<3> const& x, State<3>& slope, Real) {
        slope[0] = member.sigma * (x[1] - x[0]);
        slope[1] = x[0] * (member.rho - x[2]) - x[1];
        slope[2] = x[0] * x[1] - member.beta * x[2];
    };
    auto const first = integrated<odeint::runge_kutta_fehlberg78<State<3>, Real>>(rates, y, {1, 1, 1}, 1e-17L, problem);
    odeint::bulirsch_stoer<State<3>, Real> const extrapolation(1e-17L, 1e-17L);
    odeint::integrate_adaptive(extrapolation, rates, y, Real(0), Real(problem.end_time), Real(1e-3));
    return {first, rounded(y)};
}

}  // namespace

double state_error(std::vector<double> const& state, std::vector<double> const& reference,
                   std::vector<double> const& scale) {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        double const ratio = (state[i] - reference[i]) / (scale[i] + std::abs(reference[i]));
        sum += ratio * ratio;
    }
    return std::sqrt(sum / static_cast<double>(state.size()));
}

std::vector<double> scales(Ensemble const& ensemble, std::size_t member) {
    if (!std::holds_alternative<SliderEnsemble>(ensemble)) return {1, 1, 1};
    // c, c·ω, 2c/L_k, 2c/L_k·ω (docs/explanation/model.md 9); for ω √(g/c) where nothing drives the slider
    auto const& sliders = std::get<SliderEnsemble>(ensemble);
    auto const& in = sliders.members[member];
    bool const is_free = sliders.parts.mechanism == Mechanism::free_slider;
    double const clearance = std::min(in.clearance_y, in.clearance_z);
    double const rate = std::max(is_free ? std::sqrt(std::abs(in.gravity) / clearance) : std::abs(in.crank_speed), 1.0);
    double const tilt = 2 * clearance / in.slider_length;
    std::vector<double> scale = {in.clearance_y, in.clearance_z, in.clearance_y * rate, in.clearance_z * rate, tilt,
            tilt,           tilt,           tilt * rate,           tilt * rate,           tilt * rate};
    if (is_free) scale.insert(scale.end(), {in.clearance_y, in.clearance_y * rate});
    return scale;
}

void find_references(Problem& problem) {
    if (problem.measure != Measure::state) return;
    // Untimed, so all cores may help.
    std::vector<Pair> pairs(std::min(problem.size(), problem.shared + problem.shared / 2));
    std::string failure;
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        try {
            pairs[i] = std::visit([&](auto const& e) { return both(e, i, problem); }, problem.ensemble);
        } catch (std::exception const& error) {
#pragma omp critical
            failure = error.what();
        }
    }
    if (!failure.empty()) throw std::runtime_error(failure);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < pairs.size() && kept.size() < problem.shared; ++i) {
        double const difference = state_error(pairs[i].second, pairs[i].first, scales(problem.ensemble, i));
        if (!(difference <= largest_difference)) continue;
        problem.reference_difference = std::max(problem.reference_difference, difference);
        problem.reference.push_back(pairs[i].first);
        kept.push_back(i);
    }
    if (2 * kept.size() < problem.shared) throw std::runtime_error(problem.name + ": too few references agree");
    problem.shared = kept.size();
    // The others keep the lanes busy.
    for (std::size_t i = pairs.size(); i < problem.size() && kept.size() < problem.members_wanted; ++i)
        kept.push_back(i);
    std::visit(
        [&](auto& e) {
            for (std::size_t i = 0; i < kept.size(); ++i) e.members[i] = e.members[kept[i]];
            e.members.resize(kept.size());
        },
        problem.ensemble);
}

}  // namespace slideway::bench
