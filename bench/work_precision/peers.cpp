#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <span>

#include "bench/work_precision/odeint.hpp"
#include "bench/work_precision/system.hpp"
#if SLIDEWAY_CVODE
#include "bench/work_precision/cvode.hpp"
#endif

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using bench::Clock;
using bench::Outcome;
using bench::Task;

template <class System, class Library, class Member>
Outcome run_members(Library const& library, std::vector<Member> const& ensemble, Task const& task) {
    std::span const members(ensemble.data(), task.members);
    auto const& problem = task.problem;
    bool const audited = problem.measure == bench::Measure::energy;
    typename Library::template Solver<System> solver(library);
    Outcome outcome;
    auto const start = Clock::now();
    auto last_end = start;
    Limits const limits{problem.end_time, problem.max_step, task.tolerance, audited, Clock::after(task.budget)};
    for (auto const& member : members) {
        System const system(member);
        auto const end = solver.run(system, limits);
        if (Clock::now() > limits.deadline) break;  // this one may be cut off
        bench::MemberOutcome result;
        result.finished = end.finished;
        result.state.assign(end.end.begin(), end.end.begin() + System::size);
        result.evaluations = system.evaluations;
        if constexpr (System::audits > 0) {
            if (audited) {
                auto const* w = &end.end[System::size];
                double const change =
                    system.energy(problem.end_time, end.end.data()) - system.energy(0, system.start.data());
                result.audit = {w[0], w[1], w[2], change - w[0] + w[1] + w[2]};
            }
        }
        outcome.members.push_back(std::move(result));
        last_end = Clock::now();
    }
    // Of members that came to their end.
    outcome.seconds_per_member =
        bench::seconds_between(start, last_end) / static_cast<double>(std::max<std::size_t>(outcome.members.size(), 1));
    return outcome;
}

template <class Library> bench::Method peer(std::string name, std::string code, Library library) {
    return {std::move(name), std::move(code), false,
            // Those have events.
            [](bench::Problem const& p) {
                return p.measure != bench::Measure::extrema && !std::holds_alternative<bench::BouncingEnsemble>(p.ensemble);
            },
            [library](Task const& task) {
                return with_systems(task.problem.ensemble, [&]<class System>(auto const& members) {
                    return run_members<System>(library, members, task);
                });
            }};
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway::bench {

namespace odeint = boost::numeric::odeint;

std::vector<Method> peer_methods() {
    std::vector<Method> methods;
    methods.push_back(peer("Odeint dopri5", "scalar", Odeint<odeint::runge_kutta_dopri5>{}));
    methods.push_back(peer("Odeint dopri5 dense", "scalar", Odeint<odeint::runge_kutta_dopri5, OdeintEnd::dense>{}));
    methods.push_back(peer("Odeint Cash-Karp", "scalar", Odeint<odeint::runge_kutta_cash_karp54>{}));
#if SLIDEWAY_CVODE
    methods.push_back(peer("CVODE BDF", "scalar", Cvode{CV_BDF, 5}));
    // Orders above 2 are not stable on the imaginary axis, where undamped contact has its modes.
    methods.push_back(peer("CVODE BDF2", "scalar", Cvode{CV_BDF, 2}));
    methods.push_back(peer("CVODE Adams", "scalar", Cvode{CV_ADAMS, 12}));
#endif
    methods.push_back(valve_peer());
    return methods;
}

}  // namespace slideway::bench
