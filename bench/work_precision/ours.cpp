#include <fmt/format.h>

#include <algorithm>

#include "bench/relief_valve_orbit.hpp"
#include "bench/work_precision/method.hpp"
#include "bench/work_precision/models_kernel.hpp"
#include "tests/models/by_isa.hpp"
#include "host/config/descriptors.hpp"

namespace slideway {
SLIDEWAY_BY_ISA(LorenzMembersRun, integrate_lorenz_members)
SLIDEWAY_BY_ISA(ValveMembersRun, integrate_valve_members)
SLIDEWAY_BY_ISA(BouncingMembersRun, integrate_bouncing_members)
}  // namespace slideway

namespace slideway::bench {
namespace {

/// One way to set the engine up.
struct Choice {
    ::slideway::Method method;
    bool locate_modes = false;
};

constexpr Choice choices[] = {
    {::slideway::Method::automatic}, {::slideway::Method::dopri5},       {::slideway::Method::bs32},
    {::slideway::Method::dop853},    {::slideway::Method::verner65}, {::slideway::Method::ros34pw2},      {::slideway::Method::dopri5, true},
};

bool past_deadline(void const* deadline, double) { return Clock::now() > *static_cast<Clock::time_point const*>(deadline); }

Selection audit_quantities() {
    Selection selected = 0;
    for (Quantity const q :
         {Quantity::energy_residual, Quantity::drive_work, Quantity::friction_loss, Quantity::damping_loss}) {
        selected |= Selection(1) << static_cast<int>(q);
    }
    return selected;
}

/// A block and the memory of its results.
struct Workplace {
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities;
    BlockBase block;

    Workplace(std::size_t members, std::size_t model_states, std::size_t columns)
        : records(members), states(members * model_states), quantities(members * columns) {
        block.members = members;
        block.records = records.data();
        block.final_states = states.data();
        block.quantity_values = quantities.data();
    }
};

void run_members(Isa isa, SliderEnsemble const& ensemble, Workplace& work) {
    Block block{work.block, ensemble.members.data()};
    find_instance(isa, ensemble.parts).run(block);
}
void run_members(Isa isa, LorenzEnsemble const& ensemble, Workplace& work) {
    integrate_lorenz_members_by_isa(isa)(ensemble.members.data(), work.block);
}
void run_members(Isa isa, ValveEnsemble const& ensemble, Workplace& work) {
    integrate_valve_members_by_isa(isa)(ensemble.members.data(), work.block);
}
void run_members(Isa isa, BouncingEnsemble const& ensemble, Workplace& work) {
    integrate_bouncing_members_by_isa(isa)(ensemble.members.data(), work.block);
}

/// How many numbers a member's state and its quantities have.
struct Shape {
    std::size_t states, columns;
};
Shape shape_of(SliderEnsemble const& ensemble) {
    return {static_cast<std::size_t>(info(ensemble.parts.mechanism).states), quantity_columns};
}
Shape shape_of(LorenzEnsemble const&) { return {3, 0}; }
Shape shape_of(BouncingEnsemble const&) { return {3, 1}; }
Shape shape_of(ValveEnsemble const&) { return {3, valve_recorded_events}; }

/// What the problem's measure needs of one member.
MemberOutcome outcome_of(Workplace const& work, Shape shape, Measure measure, std::size_t i) {
    MemberOutcome member;
    auto const& record = work.records[i];
    member.finished = record.status == Status::finished;
    member.evaluations = record.rhs_evaluations + record.jacobian_evaluations;
    auto const quantities = work.quantities.data() + i * shape.columns;
    if (measure == Measure::extrema) {
        member.state.assign(quantities, quantities + shape.columns);
    } else {
        auto const state = work.states.data() + i * shape.states;
        member.state.assign(state, state + shape.states);
    }
    if (measure == Measure::energy) {
        auto const value = [&](Quantity q) { return quantities[quantity_column(q)]; };
        member.audit = {value(Quantity::drive_work), value(Quantity::friction_loss), value(Quantity::damping_loss),
                        value(Quantity::energy_residual)};
    }
    return member;
}

template <class Ensemble> Outcome run_block(Isa isa, Choice const& choice, Ensemble const& ensemble, Task const& task) {
    auto const& problem = task.problem;
    Shape const shape = shape_of(ensemble);
    Workplace work(task.members, shape.states, shape.columns);
    auto& settings = work.block.settings;
    settings.method = choice.method;
    settings.locate_modes = choice.locate_modes;
    settings.rtol = settings.atol = task.tolerance;
    settings.end_time = problem.end_time;
    settings.max_step = problem.max_step;
    if (problem.measure == Measure::energy) work.block.quantities = audit_quantities();
    if (problem.measure == Measure::extrema) work.block.quantities = 1;
    auto const start = Clock::now(), deadline = Clock::after(task.budget);
    work.block.stop = past_deadline;
    work.block.stop_context = &deadline;
    run_members(isa, ensemble, work);
    Outcome outcome;
    outcome.seconds_per_member = seconds_between(start, Clock::now()) / static_cast<double>(task.members);
    // A block that was cut off says nothing: its members in work at the end are lost, and the members that ended are the
    // easy ones.
    for (auto const& record : work.records) {
        if (record.status == Status::not_run) return outcome;
    }
    for (std::size_t i = 0; i < task.members; ++i) {
        outcome.members.push_back(outcome_of(work, shape, problem.measure, i));
    }
    return outcome;
}

/// Models without a linearisation have explicit methods alone, and for them `auto` is their pair; only a law that
/// switches has modes to locate.
bool serves(Choice const& choice, Problem const& problem) {
    using enum ::slideway::Method;
    auto const* const sliders = std::get_if<SliderEnsemble>(&problem.ensemble);
    if (sliders == nullptr) {
        bool const by_series = choice.method == automatic && problem.name == "lorenz";
        return !choice.locate_modes && (by_series || is_explicit_pair(choice.method));
    }
    return !choice.locate_modes || info(sliders->parts.law).switches;
}

std::vector<Isa> compared_isas() {
    std::vector<Isa> isas{best_isa()};
    for (Isa const isa : {Isa::avx2, Isa::scalar}) {
        if (isa != isas.front() && is_supported(isa) && compiled_isa(isa) == isa) isas.push_back(isa);
    }
    return isas;
}

}  // namespace

std::vector<Method> our_methods() {
    std::vector<Method> methods;
    for (auto const& choice : choices) {
        auto const name = fmt::format("slideway {}{}", name_of(choice.method), choice.locate_modes ? ", located" : "");
        for (Isa const isa : compared_isas()) {
            methods.push_back({name, std::string(name_of(isa)), true,
                               [=](Problem const& problem) { return serves(choice, problem); },
                               [=](Task const& task) {
                                   return std::visit([&](auto const& e) { return run_block(isa, choice, e, task); },
                                                     task.problem.ensemble);
                               }});
        }
    }
    return methods;
}

}  // namespace slideway::bench
