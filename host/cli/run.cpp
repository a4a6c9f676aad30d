#include <cmath>
#include <filesystem>
#include <numbers>
#include <system_error>

#include <fmt/format.h>

#include "host/cli/commands.hpp"
#include "host/cli/orbit_text.hpp"
#include "host/cli/text.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway::cli {
namespace {

std::string default_output(RunArguments const& arguments) {
    std::string const stem = std::filesystem::path(arguments.scene.path).stem().string();
    if (!arguments.members) return stem + ".nc";
    // A replay must not replace the ensemble that it looks into.
    auto const [first, count] = *arguments.members;
    return count == 1 ? fmt::format("{}_member_{}.nc", stem, first)
                      : fmt::format("{}_members_{}-{}.nc", stem, first, first + count - 1);
}

MemberRange member_range(RunArguments const& arguments, Scene const& scene) {
    std::uint64_t const members = member_count(scene);
    if (!arguments.members) return {0, members};
    MemberRange const range = *arguments.members;
    if (range.count > members || range.first > members - range.count) {
        std::string const asked = range.count == 1
                                      ? fmt::format("--member {}", range.first)
                                      : fmt::format("--members {}..{}", range.first, range.first + range.count - 1);
        throw SceneError(fmt::format("{}: {} has members 0 to {}", asked, scene.path, members - 1));
    }
    return range;
}

std::string replay_command(RunArguments const& arguments, Isa isa, std::uint64_t member) {
    std::string command = "slideway run " + shell_quoted(arguments.scene.path);
    for (auto const& [key, value] : arguments.scene.overrides) command += " --set " + shell_quoted(key + "=" + value);
    return command + fmt::format(" --isa {} --member {}", name_of(isa), member);
}

std::string_view advice_on(Method method) {
    switch (method) {
        case Method::rk4:
            return "use a smaller integrator.step, or method = \"auto\"";
        case Method::ros34pw2:
            return "it is for lasting contact alone; use method = \"auto\" where there are impacts";
        default:
            return "use smaller rtol and atol";
    }
}

/// What became of members whose method left its stable range, and the way out (docs/stability.md).
void print_instability(Scene const& scene, EnsembleTotals const& totals) {
    Method const method = scene.integrator.method;
    auto const ended = [&](Status status) { return totals.ended[static_cast<std::size_t>(status)]; };
    std::uint64_t const unstable = ended(Status::unstable);
    // A step beyond the limit throws the slider out of its joint, if it does not end in infinity.
    std::uint64_t const broken =
        method == Method::rk4 ? ended(Status::nonfinite) + ended(Status::geometry) + ended(Status::contact_domain) : 0;
    if (unstable + broken == 0) return;
    std::string const name = method == Method::rk4
                                 ? fmt::format("rk4 with a step of {:.3g} s", scene.integrator.fixed_step)
                                 : std::string(name_of(method));
    std::string what;
    if (unstable > 0) what = fmt::format("{} unstable by the energy audit", unstable);
    if (broken > 0) what += fmt::format("{}{} broke down", what.empty() ? "" : ", ", broken);
    fmt::print("\n{} failed in {} member{} ({}): {}.\n", name, unstable + broken, unstable + broken == 1 ? "" : "s",
               what, advice_on(method));
}

/// Members that spent their steps before their end.
void print_spent(Scene const& scene, EnsembleTotals const& totals) {
    std::uint64_t const spent = totals.ended[static_cast<std::size_t>(Status::max_steps)];
    if (spent == 0) return;
    bool const pair = scene.integrator.method == Method::dopri5 || scene.integrator.method == Method::bs32;
    fmt::print(
        "\n{} member{} spent integrator.max_steps = {}: try a larger one, {}looser rtol and atol, or look at one "
        "with --member K.\n",
        spent, spent == 1 ? "" : "s", scene.integrator.max_steps, pair ? "method = \"auto\", " : "");
}

void print_failures(RunArguments const& arguments, Scene const& scene, Isa isa, EnsembleTotals const& totals,
                    ResultReader const& results) {
    if (totals.failed() == 0) return;
    constexpr std::size_t listed = 5;
    auto const failed = failed_members(results, listed);
    fmt::print("\n{} failed member{}{}:\n", totals.failed(), totals.failed() == 1 ? "" : "s",
               totals.failed() > listed ? fmt::format(", the first {}", listed) : "");
    for (FailedMember const& member : failed) {
        fmt::print("  member {}: {}", member.member, name_of(member.status));
        auto const why = defect(member_inputs(scene, member.member));
        if (why)
            fmt::print(": {}", *why);
        else
            fmt::print(" at t = {:.6g} s", member.time);
        fmt::print("\n    {}\n", replay_command(arguments, isa, member.member));
    }
}

/// The paper's law makes energy where its modes switch (model.md 8); a reader of results has to know how much.
void print_energy_made(Scene const& scene, EnsembleTotals const& totals,
                       std::vector<QuantitySummary> const& quantities) {
    if (scene.parts.law != Law::paper) return;
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
    bool const doubtful = is_always_audited(method) || totals.ended[static_cast<std::size_t>(Status::unstable)] > 0;
    std::string const cause =
        doubtful ? fmt::format("The paper law's mode switching and the errors of {} together", name_of(method))
                 : "Mode switching of the paper law";
    fmt::print("\n{} made {:.3g} J of energy per member on average", cause, made);
    QuantitySummary const* const work = mean_of("crank_work");
    if (work != nullptr && work->values.mean != 0) {
        fmt::print(", {:.3g} % of the crank's work of {:.3g} J", 100 * made / std::abs(work->values.mean),
                   work->values.mean);
    }
    if (doubtful) {
        fmt::print("; {} tells them apart",
                   is_always_audited(method) ? "method = \"auto\"" : "a smaller rtol and atol");
    }
    fmt::print(".\n");
}

void print_summary(RunArguments const& arguments, Scene const& scene, EnsembleOptions const& options,
                   EnsembleTotals const& totals, bool replaced) {
    ResultReader const results(options.output);
    auto const quantities = summarise_quantities(results);
    std::uint64_t const ran = options.range.count - totals.not_run;
    print_field("scene", scene.title.empty() ? scene.path : fmt::format("{} ({})", scene.title, scene.path));
    print_field("members", fmt::format("{}", options.range.count));
    print_statuses(count_statuses(results));
    double const rate = totals.seconds > 0 ? static_cast<double>(ran) / totals.seconds : 0.0;
    double const turns = orbit_schedule(scene).longest * std::abs(scene.inputs.crank_speed) / (2 * std::numbers::pi);
    print_field(
        "throughput",
        fmt::format("{:.4g} members/s, {}{} wall time ({} threads, {}, {} lanes)", rate,
                    turns > 0 ? fmt::format("{:.4g} members x revolutions/s, ", rate * turns) : "",
                    duration_text(totals.seconds), options.threads, name_of(options.isa), lanes_of(options.isa)));
    print_field("steps", fmt::format("{} accepted ({} by the stiff method), {} rejected", totals.steps_accepted,
                                     totals.stiff_steps, totals.steps_rejected));
    print_field("evaluations",
                fmt::format("{} right-hand sides, {} Jacobians", totals.rhs_evaluations, totals.jacobian_evaluations));
    print_field("lanes in use", fmt::format("{:.1f} %", 100 * totals.lane_utilisation()));
    print_quantities(quantities);
    if (!quantities.empty() && turns > 0) fmt::print("  (over the whole run, its transient included)\n");
    print_exponents(results);
    print_sections(results);
    print_energy_made(scene, totals, quantities);
    print_instability(scene, totals);
    print_spent(scene, totals);
    print_failures(arguments, scene, options.isa, totals, results);
    fmt::print("\n");
    print_field("results", fmt::format("{}{}", options.output, replaced ? " (replaced a former file)" : ""));
}

}  // namespace

int run(RunArguments const& arguments) {
    require_backend(arguments.backend);
    Isa const isa = parse_isa(arguments.scene.isa);
    Scene const scene = load_scene(arguments.scene);
    print_warnings(scene);
    EnsembleOptions options;
    options.range = member_range(arguments, scene);
    options.output = arguments.output.empty() ? default_output(arguments) : arguments.output;
    options.isa = isa;
    options.threads = arguments.threads.value_or(default_threads());
    options.progress = Progress::style_for(stderr, arguments.quiet);
    std::error_code ignored;
    if (std::filesystem::equivalent(options.output, scene.path, ignored)) {
        throw SceneError(options.output + ": is the scene itself; give another name with -o");
    }
    bool const replaced = std::filesystem::exists(options.output, ignored);

    StopRequest stop;
    if (arguments.max_hours) stop.stop_after(std::chrono::duration<double, std::ratio<3600>>(*arguments.max_hours));
    EnsembleTotals totals;
    {
        SignalScope const signals(stop);
        totals = run_ensemble_study(scene, options, stop);
    }
    print_summary(arguments, scene, options, totals, replaced);

    if (totals.stopped != StopReason::none) {
        fmt::print(stderr, "slideway: stopped early ({}): {} of {} members were not run\n",
                   totals.stopped == StopReason::signal ? "signal" : "--max-hours", totals.not_run,
                   options.range.count);
        return exit_code::stopped_early;
    }
    if (arguments.max_failures.exceeded(totals.failed(), options.range.count)) {
        fmt::print(stderr, "slideway: {} of {} members failed, more than --max-failures {}\n", totals.failed(),
                   options.range.count, arguments.max_failures.text());
        return exit_code::too_many_failures;
    }
    return exit_code::done;
}

}  // namespace slideway::cli
