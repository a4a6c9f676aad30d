#include "host/commands/text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/descriptors.hpp"
#include "host/store/run_identity.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/tolerance_report.hpp"
#include "host/study/verification.hpp"

namespace slideway::cli {
namespace {

/// How many members ended how, as the result file has it.
using Statuses = std::vector<StatusCount>;

template <class Condition> std::uint64_t count_where(Statuses const& statuses, Condition const& holds) {
    std::uint64_t sum = 0;
    for (StatusCount const& one : statuses) sum += holds(one.status) ? one.members : 0;
    return sum;
}

std::uint64_t count_of(Statuses const& statuses, Status status) {
    return count_where(statuses, [status](Status one) { return one == status; });
}

std::uint64_t count_failed(Statuses const& statuses) {
    return count_where(statuses, [](Status one) { return one != Status::finished && one != Status::not_run; });
}

/// Options with which a member has the bits that it has in a result.
std::string_view replay_backend(std::string_view isa) {
    auto const& isas = all_isas();
    bool const is_processor = std::any_of(isas.begin(), isas.end(), [&](Isa one) { return name_of(one) == isa; });
    if (is_processor) return "--isa ";
    // A card that rounds as the processor does is no better to look at a single member.
    return arithmetic_of(isa) == arithmetic_of("avx2") ? "--backend cpu" : "--backend cuda";
}

std::string replay_command(RunArguments const& arguments, Scene const& scene, std::string_view isa,
                           std::uint64_t member) {
    std::string command = "slideway run " + shell_quoted(arguments.scene.path);
    for (auto const& [key, value] : arguments.scene.overrides) command += " --set " + shell_quoted(fmt::format("{}={}", key, value));
    // Without a row of its own there is nothing to look at.
    if (!scene.stores_members()) command += " --set study.store=members";
    if (arguments.any_start) command += " --any-start";
    std::string_view const backend = replay_backend(isa);
    return command + fmt::format(" {}{} --member {}", backend, backend.ends_with(' ') ? isa : "", member);
}

std::string_view advice_on(Method method) {
    if (has_fixed_step(method)) return "use a smaller integrator.step, or method = \"auto\"";
    if (method == Method::ros34pw2) return "it is for lasting contact alone; use method = \"auto\" where there are impacts";
    return "use smaller rtol and atol";
}

/// What became of members whose method left its stable range, and the way out (docs/evidence/stability.md).
void print_instability(Scene const& scene, Statuses const& ended) {
    Method const method = scene.integrator.method;
    std::uint64_t const unstable = count_of(ended, Status::unstable);
    // A step beyond the limit throws the slider out of its joint, if it does not end in infinity.
    std::uint64_t const broken =
        has_fixed_step(method)
            ? count_of(ended, Status::nonfinite) + count_of(ended, Status::geometry) + count_of(ended, Status::contact_domain)
            : 0;
    if (unstable + broken == 0) return;
    std::string const name = has_fixed_step(method)
                                 ? fmt::format("{} with a step of {:.3g} s", name_of(method), scene.integrator.fixed_step)
                                 : std::string(name_of(method));
    std::vector<std::string> what;
    if (unstable > 0) what.push_back(fmt::format("{} unstable by the energy audit", unstable));
    if (broken > 0) what.push_back(fmt::format("{} broke down", broken));
    print_text(0, "\n{} failed in {} ({}): {}.", name, counted(unstable + broken, "member"), fmt::join(what, ", "), advice_on(method));
}

/// Members whose crank did not turn so far in the time that it had.
void print_late(Scene const& scene, Statuses const& ended) {
    std::uint64_t const late = count_of(ended, Status::out_of_time);
    if (late == 0) return;
    print_text(0, "\n{} had not turned as far as study.revolutions after study.time_limit = {:.6g} s: give it longer, or look at one with --member K.",
               late == 1 ? "The crank of 1 member" : fmt::format("The cranks of {}", counted(late, "member")), scene.integrator.end_time);
}

/// Members that spent their steps before their end.
void print_spent(Scene const& scene, Statuses const& ended) {
    std::uint64_t const spent = count_of(ended, Status::max_steps);
    if (spent == 0) return;
    bool const pair = is_explicit_pair(scene.integrator.method);
    print_text(0, "\n{} spent integrator.max_steps = {}: try a larger one, {}looser rtol and atol, or look at one with --member K.",
               counted(spent, "member"), scene.integrator.max_steps, pair ? "method = \"auto\", " : "");
}

void print_failures(RunArguments const& arguments, Scene const& scene, Statuses const& ended,
                    ResultReader const& results) {
    if (count_failed(ended) == 0) return;
    constexpr std::size_t listed = 5;
    auto const failed = failed_members(results, listed);
    print_out("\n{}{}:\n", counted(count_failed(ended), "failed member"),
               count_failed(ended) > listed ? fmt::format(", the first {}", listed) : "");
    for (FailedMember const& member : failed) {
        auto const why = defect(member_inputs(scene, member.member), scene.parts);
        std::string const label = label_of(scene, member.member);
        print_text(4, "  member {}{}: {}{}", member.member, label.empty() ? "" : fmt::format(" ({})", label), name_of(member.status), why ? ": " + *why : fmt::format(" at t = {:.6g} s", member.time));
        print_out("    {}\n", replay_command(arguments, scene, results.attribute("isa"), member.member));
    }
}

/// A law makes energy where its modes switch (model.md 8); a reader of results has to know how much.
void print_energy_made(Scene const& scene, Statuses const& ended, std::vector<QuantitySummary> const& quantities) {
    if (!makes_energy(scene.parts)) return;
    LawInfo const& law = info(scene.parts.law);
    auto const mean_of = [&](std::string_view label) -> QuantitySummary const* {
        for (QuantitySummary const& quantity : quantities) {
            if (quantity.label == label && quantity.values.count > 0) return &quantity;
        }
        return nullptr;
    };
    QuantitySummary const* const residual = mean_of("energy_residual");
    if (residual == nullptr) return;
    double const made = residual->values.mean;
    // Where the method may have failed the law is not to blame alone.
    Method const method = scene.integrator.method;
    bool const doubtful = is_always_audited(method) || count_of(ended, Status::unstable) > 0;
    std::string const cause =
        doubtful ? fmt::format("The {} law's mode switching and the errors of {} together", law.name, name_of(method))
                 : fmt::format("Mode switching of the {} law", law.name);
    if (std::max(std::abs(residual->values.min), std::abs(residual->values.max)) <= least_energy(scene)) {
        print_text(0, "\n{} made no energy: {:.2g} J per member on average is rounding.", cause, made);
        return;
    }
    std::string sentence = fmt::format("\n{} made {:.3g} J of energy per member on average", cause, made);
    QuantitySummary const* const work = mean_of("drive_work");
    if (work != nullptr && std::abs(work->values.mean) > least_energy(scene)) {
        sentence += fmt::format(", {:.3g} % of the {}'s work of {:.3g} J", 100 * made / std::abs(work->values.mean),
                   counts_for(*find_key("mechanism.rod_length"), scene.parts.mechanism) ? "crank" : "drive", work->values.mean);
    }
    if (doubtful) {
        sentence += fmt::format("; {} tells them apart",
                                is_always_audited(method) ? "method = \"auto\"" : "a smaller rtol and atol");
    }
    print_lines(0, sentence + ".");
}

/// Whether the numbers above are the integration's: to stdout beside them, and where they are, to stderr.
void print_verification(ResultReader const& results) {
    auto const summary = verification_summary(results);
    if (!summary) return;
    print_text(0, "\n{}", *summary);
    warn_of_results(results);
}

double sum_of(ResultReader const& results, std::string const& variable) {
    double sum = 0;
    for (double const value : results.values(variable)) {
        if (!std::isnan(value)) sum += value;  // of members that were not run
    }
    return sum;
}

}  // namespace

std::uint64_t failed_count(ResultReader const& results) { return count_failed(count_statuses(results)); }

void warn_of_results(ResultReader const& results) {
    auto const summary = verification_summary(results);
    if (summary && summary->starts_with("NOT")) tell("warning: {}\n", summary->substr(0, summary->find('\n')));
}

void print_throughput(Scene const& scene, StudyOptions const& options, EnsembleTotals const& totals, int ranks) {
    double const rate = totals.seconds > 0 ? static_cast<double>(totals.done()) / totals.seconds : 0.0;
    OrbitSchedule const schedule = orbit_schedule(scene);
    double const turns = schedule.timing ? schedule.turns : 0;
    print_field("throughput",
                fmt::format("{:.4g} members/s, {}{} wall time ({}{}, {})", rate,
                            turns > 0 ? fmt::format("{:.4g} members x revolutions/s, ", rate * turns) : "",
                            duration_text(totals.seconds), ranks > 1 ? fmt::format("{} ranks of ", ranks) : "",
                            counted(static_cast<std::uint64_t>(options.backend->workers(options.threads)), "thread"), options.backend->machine()));
    // Of a card's lanes nobody knows.
    if (options.backend->name() == "cpu") {
        print_field("lanes in use", fmt::format("{:.1f} %", 100 * totals.lane_utilisation()));
    }
}

void print_results(RunArguments const& arguments, Scene const& scene, ResultReader const& results,
                   std::optional<ToleranceReport> const& report) {
    auto const quantities = summarise_quantities(results);
    Statuses const ended = count_statuses(results);
    print_field("members", fmt::format("{}", count_where(ended, [](Status) { return true; })));
    print_statuses(ended);
    print_field("steps", fmt::format("{:.0f} accepted ({:.0f} by the stiff method), {:.0f} rejected",
                                     sum_of(results, "steps_accepted"), sum_of(results, "stiff_steps"),
                                     sum_of(results, "steps_rejected")));
    print_field("evaluations",
                fmt::format("{:.0f} right-hand sides, {:.0f} Jacobians", sum_of(results, "rhs_evaluations"),
                            sum_of(results, "jacobian_evaluations")));
    if (report)
        print_tolerance(*report);
    else
        print_quantities(quantities);
    bool const has_values = std::ranges::any_of(quantities, [](QuantitySummary const& one) { return one.values.count > 0; });
    if (has_values && std::isfinite(turn_length(scene))) {
        print_out("  (over the whole run, its transient included)\n");
    }
    print_exponents(results);
    print_sections(results);
    print_verification(results);
    print_energy_made(scene, ended, quantities);
    print_instability(scene, ended);
    print_late(scene, ended);
    print_spent(scene, ended);
    print_failures(arguments, scene, ended, results);
    if (!scene.stores_members()) {
        print_text(0, "\nMembers are not stored; a single one can be had with --member K --set study.store=members.");
    }
}

}  // namespace slideway::cli
