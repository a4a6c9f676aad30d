#include <exception>
#include <filesystem>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/linkage_modules.hpp"
#include "host/backend/module_compiler.hpp"
#include "host/base/bytes.hpp"
#include "host/base/process.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/run/rank_messages.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/prediction.hpp"

namespace slideway::cli {
namespace {

/// Of the overrides, so that runs of one scene that differ in them have names of their own: ".contact.law=conservative"; a checksum where
/// that would be no good name.
std::string words_of(Overrides const& overrides) {
    constexpr std::size_t longest = 40;
    constexpr std::string_view good = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.";
    std::string words;
    for (auto const& [key, value] : overrides) words += fmt::format(".{}={}", key, value);
    if (words.size() <= longest && words.find_first_not_of(good) == words.npos) return words;
    return fmt::format(".set-{:08x}", static_cast<std::uint32_t>(fnv1a(std::as_bytes(std::span(words)))));
}

std::string default_output(RunArguments const& arguments) {
    std::string const stem = std::filesystem::path(arguments.scene.path).stem().string() + words_of(arguments.scene.overrides);
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

StudyOptions study_options(RunArguments const& arguments, Scene const& scene) {
    StudyOptions options = arguments.study;
    options.range = member_range(arguments, scene);
    if (options.output.empty()) options.output = default_output(arguments);
    options.progress = Progress::style_for(stderr, !arguments.shows_progress());
    return options;
}

BackendChoice chosen_backend(RunArguments const& arguments, Scene const& scene, StudyOptions const& options,
                             Ranks const& ranks) {
    BackendRequest request = arguments.scene.backend;
    request.threads = options.threads;
    request.block_members = options.block_members;
    request.share = {ranks.local_rank(), ranks.local_count()};
    MemberSet const members = members_of_part(scene, options.part, MemberSet(options.range));
    return choose_backend(request, scene, place_count(scene, members));
}

/// Results that there were, and that must be computed again.
void warn_of_losses(StudyOptions const& options, StudyRun const& run) {
    warn_of_mending(run.mended());
    for (DamagedShard const& damaged : run.damaged()) {
        std::string const& name = damaged.shard.name;
        tell("warning: {}/{}: {}; its members run again\n", shard_folder_of(options.output), name,
                   damaged.is_gone || damaged.is_manifest ? damaged.words() : fmt::format("{} and is now {}{}", damaged.words(), shard_names::damaged, name));
    }
    if (options.resume && !run.is_complete() && run.work().before == 0 && run.target().replaces()) {
        tell("warning: {}: holds a part of this run, but its shards are gone; all members run again\n",
                   options.output);
    }
}

/// Before the start: what it will take, and what there is already.
void announce(Scene const& scene, StudyOptions const& options, std::string const& reason, Prediction const& prediction,
              StudyRun const& run) {
    StudyWork const& work = run.work();
    if (work.before > 0) {
        tell("resuming: {} of {} members are done\n", work.before, work.before + work.todo.count());
    }
    tell("backend {}{}{}\n", backend_text(*options.backend), reason.empty() ? "" : ": ", reason);
    tell("memory {}{}, disk {} and {} for the shards until the end\n",
               bytes_text(prediction.memory()), card_memory_text(prediction),
               bytes_text(prediction.output_bytes), shards_text(scene, prediction));
}

bool says_text(RunArguments const& arguments) { return !arguments.quiet && !arguments.json; }

int end_stopped(StudyOptions const& options, std::string_view why, std::uint64_t left) {
    std::string const folder = shard_folder_of(options.output);
    tell("slideway: stopped early{}: {} {} not run; those that did are kept in {}: add --resume to go on, or make a file of them with slideway merge\n", why,
         counted(left, "member"), left == 1 ? "has" : "have", folder);
    return exit_code::stopped_early;
}

int end_unmerged(StudyOptions const& options) {
    tell("slideway: stopped early (signal): all members have run, and are kept in {}: add --resume to merge them\n",
        shard_folder_of(options.output));
    return exit_code::stopped_early;
}

/// Where members are left, or wait for those of other parts.
int end_with_shards(RunArguments const& arguments, StudyOptions const& options, EnsembleTotals const& totals, std::uint64_t left) {
    std::string const folder = shard_folder_of(options.output);
    if (arguments.json) print_out("{}", stopped_json(folder, left));
    if (left == 0) {
        if (says_text(arguments)) print_field("results", fmt::format("part {} is done, in {}; slideway merge makes one file of all parts",
                                           options.part.name(), folder));
        return exit_code::done;
    }
    std::string const why = totals.stopped == StopReason::signal       ? " (signal)"
                            : totals.stopped == StopReason::time_limit ? " (--max-hours)"
                                                                       : "";
    return end_stopped(options, why, left);
}

/// @param totals of what has just run, or nullptr
int conclude(RunArguments const& arguments, Scene const& scene, StudyOptions const& options, bool replaced,
             std::optional<ToleranceReport> report, EnsembleTotals const* totals) {
    ResultReader const results(options.output);
    bool const tells = arguments.json || !arguments.quiet;
    if (tells && !report && asks_for_report(scene)) report = tolerance_report(results, scene, {options.threads});
    if (arguments.json) {
        print_out("{}", result_json("run", results, results.seal(), report, totals, 0, {}, &scene));
    } else if (!arguments.quiet) {
        print_results(arguments, scene, results, report);
        print_out("\n");
        print_field("results", fmt::format("{}{}", options.output, replaced ? " (replaced a former file)" : ""));
    }
    if (!says_text(arguments)) warn_of_results(results);
    std::uint64_t const failed = failed_count(results), members = options.range.count;
    if (!arguments.max_failures.exceeded(failed, members)) return exit_code::done;
    tell("slideway: {} of {} members failed, more than --max-failures {}\n", failed, members,
               arguments.max_failures.text());
    return exit_code::too_many_failures;
}

std::string kept(std::string_view failure, StudyOptions const& options) {
    return fmt::format("{}; what is finished is kept in {}: add --resume to go on", failure, shard_folder_of(options.output));
}

/// What is thrown at the moment, with what becomes of the members that are finished.
[[noreturn]] void throw_kept(StudyOptions const& options, StudyRun const& run) {
    if (!run.has_folder()) throw;
    try {
        throw;
    } catch (SceneError const&) {
        throw;
    } catch (DeviceError const& error) {
        throw DeviceError(kept(error.what(), options));
    } catch (...) {
        Complaint const complaint = complaint_of(std::current_exception());
        if (complaint.code != exit_code::file_trouble) throw;
        throw FileError(kept(complaint.line, options));
    }
}

/// Before a word is said of a result that is whole: whatever stops the words then, no shards lie beside it.
void remove_shards(StudyOptions const& options, StudyRun& run) {
    try {
        if (auto const strangers = run.remove_shards(); !strangers.empty())
            tell("warning: {}: stays, for it holds what is not of this run: {}\n", shard_folder_of(options.output), fmt::join(strangers, ", "));
    } catch (FileError const& error) {
        throw FileError(fmt::format("{}; {} is complete, and run --resume removes the rest", error.what(), options.output));
    }
}

/// Rank 0.
int lead(RunArguments const& arguments, Scene const& scene, StudyOptions const& options, StudyRun& run, Ranks& ranks,
         StopRequest const& stop) {
    if (says_text(arguments)) print_field("scene", scene_text(scene, scene.path));
    if (run.is_complete()) {
        if (arguments.shows_progress()) tell("resuming: {} is complete already\n", options.output);
        return conclude(arguments, scene, options, false, {}, nullptr);
    }
    std::optional<ToleranceReport> report;
    EnsembleTotals done;
    try {
        EnsembleTotals const totals = run_work(scene, options, run.work(), ranks, stop);
        if (says_text(arguments)) print_throughput(scene, options, totals, ranks.count());
        std::uint64_t const left = run.left();
        if (left > 0 || options.part.of_array) return end_with_shards(arguments, options, totals, left);
        done = totals;
        if (!run.merge(stop, report)) return end_unmerged(options);
    } catch (...) {
        throw_kept(options, run);
    }
    remove_shards(options, run);
    return conclude(arguments, scene, options, run.target().replaces(), std::move(report), &done);
}

/// A linkage that will run for minutes is compiled before, where that has not been done and can be: with the same bits in less time.
void compile_before_long(Scene const& scene, StudyOptions const& options, Prediction const& prediction, StudyRun const& run) {
    constexpr double long_run = 60;  // [s]; compilers take a third of that
    double const share = static_cast<double>(run.work().todo.count()) / static_cast<double>(member_count(scene));
    bool const may_be_long = scene.parts.linkage != nullptr && options.backend->name() == "cpu" && share * prediction.most_seconds > long_run;
    Isa const isa = compiled_isa(parse_isa(options.backend->isa()));
    if (!may_be_long || compiled_linkage(scene.parts, isa) != nullptr) return;
    std::optional<Trial> const trial = try_members(scene, *options.backend, options.threads);
    double const seconds = share * (trial ? trial->seconds : prediction.least_seconds);
    if (seconds < long_run) return;
    tell("compiling the linkage, as slideway compile does, for about {} of integration\n", duration_text(seconds));
    try {
        compile_modules({scene.path, linkage_header(scene.parts), "", {isa}, options.threads, &objection_to});
    } catch (std::exception const& error) {
        tell("warning: {}; it runs by tables\n", error.what());
    }
}

/// What rank 0 tells the others before they begin; empty if there is nothing to do.
std::string invitation(StudyRun const& run, Backend const& backend) {
    if (run.is_complete()) return {};
    return to_text(Invitation{backend.isa(), run.work().before, run.work().todo});
}

/// Machines may differ, and bits may not.  @param leader instruction set of rank 0
std::shared_ptr<Backend const> backend_beside(std::string const& leader, std::shared_ptr<Backend const> own) {
    if (arithmetic_of(own->isa()) == arithmetic_of(leader)) return own;
    for (Isa const isa : all_isas()) {
        if (name_of(isa) == leader && is_supported(isa)) return cpu_backend(isa);
    }
    throw SceneError(fmt::format(
        "slideway: rank 0 computes with {} and this machine has but {}, whose results have other bits; start ranks on "
        "machines that are alike, or add --backend cpu",
        leader, own->isa()));
}

/// Rank 0 alone ends with the code of the run: mpirun kills the ranks that are left when one of them ends with another than 0, and
/// rank 0 has still to say why.
int await_end(Ranks& ranks) {
    ranks.agree(0);
    return exit_code::done;
}

/// The other ranks: they only compute.
int help(RunArguments const& arguments, Ranks& ranks, StopRequest const& stop) {
    std::string const invited = ranks.broadcast({});
    if (invited.empty()) return await_end(ranks);
    Invitation const invitation = read_invitation(invited);
    StudyWork const work{invitation.todo, invitation.before};
    Scene const scene = load_scene(arguments.scene);
    StudyOptions options = study_options(arguments, scene);
    options.backend = backend_beside(invitation.isa, chosen_backend(arguments, scene, options, ranks).backend);
    options.progress = Progress::Style::none;
    run_work(scene, options, work, ranks, stop);
    return await_end(ranks);
}

}  // namespace

int execute(RunArguments const& arguments) {
    std::unique_ptr<Ranks> const ranks = Ranks::join();
    // Until the process ends: a signal that comes when all is done must not kill it.
    static StopRequest stop;
    static SignalScope const signals(stop);
    if (arguments.max_hours) stop.stop_after(std::chrono::duration<double, std::ratio<3600>>(*arguments.max_hours));
    bool invited = ranks->rank() > 0;
    try {
        if (ranks->rank() > 0) return help(arguments, *ranks, stop);
        Scene const scene = admitted_scene(arguments.scene, arguments.any_start);
        StudyOptions options = study_options(arguments, scene);
        BackendChoice const choice = chosen_backend(arguments, scene, options, *ranks);
        options.backend = choice.backend;
        // Of a card that lacks the memory this is the last word: nothing is on the disk yet.
        Prediction const prediction = predict(scene, *options.backend, options.threads, options.block_members);
        require_memory(prediction.memory() + memory_of_work(options.threads));
        options.shared = ranks->count() > 1;
        StudyRun study(scene, options);
        warn_of_losses(options, study);
        if (arguments.shows_progress() && !study.is_complete()) announce(scene, options, choice.reason, prediction, study);
        if (!study.is_complete()) compile_before_long(scene, options, prediction, study);
        invited = true;
        ranks->broadcast(invitation(study, *options.backend));
        return ranks->agree(lead(arguments, scene, options, study, *ranks, stop));
    } catch (...) {
        Complaint const complaint = complaint_of(std::current_exception());
        if (ranks->is_in_round()) {
            // The others are at work, and hear nothing but the end of the job.
            std::fflush(stdout);
            tell("{}\n", complaint.line);
            ranks->abort(complaint.code);
        }
        if (ranks->rank() > 0) throw;
        // The others wait for what rank 0 says.
        if (!invited) ranks->broadcast({});
        ranks->agree(complaint.code);
        throw;
    }
}

}  // namespace slideway::cli
