#include <algorithm>

#include "bench/work_precision/method.hpp"
#include "host/backend/backend.hpp"

namespace slideway::bench {
namespace {

/// One way to set the engine up.
struct Choice {
    std::string name;
    void (*choose)(IntegratorSettings&);
};

/// The engine's methods; an engine that leaves no choice has its one.
template <class Settings = IntegratorSettings> std::vector<Choice> engine_choices() {
    if constexpr (requires { &Settings::method; }) {
        using Stepper = decltype(Settings::method);
        return {
            {"auto", [](Settings& s) { s.method = Stepper::automatic; }},
            {"dopri5", [](Settings& s) { s.method = Stepper::dopri5; }},
            {"bs32", [](Settings& s) { s.method = Stepper::bs32; }},
            {"ros34pw2", [](Settings& s) { s.method = Stepper::ros34pw2; }},
        };
    } else {
        return {{"dopri5", [](Settings&) {}}};
    }
}

bool past_deadline(void const* deadline) { return Clock::now() > *static_cast<Clock::time_point const*>(deadline); }

Selection audit_quantities() {
    Selection selected = 0;
    for (Quantity const q :
         {Quantity::energy_residual, Quantity::crank_work, Quantity::friction_loss, Quantity::damping_loss}) {
        selected |= Selection(1) << static_cast<int>(q);
    }
    return selected;
}

Outcome run_block(Isa isa, Choice const& choice, Task const& task) {
    auto const& problem = task.problem;
    auto const& ensemble = std::get<SliderCrankEnsemble>(problem.ensemble);
    std::size_t const n = ensemble.members.size();
    std::vector<MemberRecord> records(n);
    std::vector<double> states(n * state_size), quantities(n * quantity_columns);
    Block block;
    block.inputs = ensemble.members.data();
    block.members = n;
    block.settings.rtol = block.settings.atol = task.tolerance;
    block.settings.end_time = problem.end_time;
    block.settings.max_step = problem.max_step;
    choice.choose(block.settings);
    block.quantities = problem.measure == Measure::energy ? audit_quantities() : 0;
    block.records = records.data();
    block.final_states = states.data();
    block.quantity_values = quantities.data();
    auto const start = Clock::now();
    auto const deadline =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(task.budget));
    block.stop = past_deadline;
    block.stop_context = &deadline;
    ThreadTimer const timer;
    find_instance(isa, ensemble.parts).run(block);
    double const seconds = timer.seconds();

    Outcome outcome;
    for (std::size_t i = 0; i < n; ++i) {
        if (records[i].status == Status::not_run) continue;
        MemberOutcome member;
        member.finished = records[i].status == Status::finished;
        member.state.assign(&states[i * state_size], &states[i * state_size] + state_size);
        auto const value = [&](Quantity q) {
            return quantities[i * quantity_columns + static_cast<std::size_t>(quantity_column(q))];
        };
        member.audit = {value(Quantity::crank_work), value(Quantity::friction_loss), value(Quantity::damping_loss),
                        value(Quantity::energy_residual)};
        member.evaluations = records[i].rhs_evaluations;
        outcome.members.push_back(std::move(member));
    }
    // A block that was cut off says nothing: its members in work at the end are lost, and the members that ended are the
    // easy ones.
    if (outcome.members.size() < n) outcome.members.clear();
    outcome.seconds_per_member = seconds / static_cast<double>(n);
    return outcome;
}

}  // namespace

std::vector<Method> our_methods() {
    std::vector<Method> methods;
    for (Choice const& choice : engine_choices()) {
        for (Isa const isa : {best_isa(), Isa::scalar}) {
            methods.push_back({"slideway " + choice.name, std::string(name_of(isa)), true,
                               [](Problem const& p) { return std::holds_alternative<SliderCrankEnsemble>(p.ensemble); },
                               [=](Task const& task) { return run_block(isa, choice, task); }});
        }
    }
    return methods;
}

}  // namespace slideway::bench
