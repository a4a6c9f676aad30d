#include "bench/relief_valve_odeint.hpp"
#include "bench/work_precision/method.hpp"

namespace slideway::bench {
namespace {

Outcome solve(Task const& task) {
    auto const& ensemble = std::get<ValveEnsemble>(task.problem.ensemble);
    Outcome outcome;
    auto const start = Clock::now(), deadline = Clock::after(task.budget);
    for (std::size_t i = 0; i < task.members && Clock::now() < deadline; ++i) {
        auto const orbit = odeint_valve_orbit(ensemble.members[i].inflow, task.tolerance);
        MemberOutcome member;
        member.finished = orbit.events.size() == valve_recorded_events;
        member.evaluations = orbit.rhs;
        for (auto const& event : orbit.events) member.state.push_back(event.x);
        outcome.members.push_back(std::move(member));
    }
    outcome.seconds_per_member = seconds_between(start, Clock::now()) / static_cast<double>(outcome.members.size());
    return outcome;
}

}  // namespace

Method valve_peer() {
    return {"Odeint Cash-Karp", "scalar", false,
            [](Problem const& problem) { return problem.measure == Measure::extrema; }, solve};
}

}  // namespace slideway::bench
