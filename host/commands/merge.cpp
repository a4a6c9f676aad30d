#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/base/process.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/result_view.hpp"
#include "host/store/shard_claim.hpp"
#include "host/study/admission.hpp"
#include "host/study/study_run.hpp"

namespace slideway::cli {
namespace {

/// A result in the place of a shard, or of what tells them, would be the end of the run.
void require_outside(OutputTarget const& target, std::string const& folder) {
    std::error_code ignored;
    if (std::filesystem::equivalent(folder_of(target.path()), folder, ignored)) {
        throw FileError(fmt::format("{}: lies in the folder of the shards; give a name elsewhere with -o", target.name()));
    }
}

/// What the manifests list and is what was written.  The rest counts as not run.
std::vector<Shard> intact_shards(ShardFolder const& folder) {
    std::vector<DamagedShard> damaged;
    std::vector<Shard> shards = folder.intact(damaged);
    for (DamagedShard const& one : damaged) {
        tell("warning: {}/{}: {}; its members are left out: slideway run --resume runs them again\n",
                   folder.path(), one.shard.name, one.words());
    }
    return shards;
}

/// A folder that cannot be written to is merged all the same.
void mend(ShardFolder const& folder) {
    if (folder.damaged_identity().empty()) return;
    try {
        folder.mend();
        warn_of_mending(folder.damaged_identity());
    } catch (FileError const& error) {
        tell("warning: {}: is damaged or gone, and cannot be written again: {}\n", folder.damaged_identity(), error.what());
    }
}

/// @return members without results; nothing if a signal came
std::optional<std::uint64_t> merged_unless_stopped(MergeArguments const& arguments, Scene const& scene, ShardFolder const& folder,
                                                   std::vector<Shard> const& shards, OutputTarget const& target,
                                                   std::optional<ToleranceReport>& report, StopRequest const& stop) {
    ReportSettings settings;
    settings.pause = pause_of(stop);
    auto const backend = cpu_backend(best_isa(scene.parts));
    auto const check = resolution_check(scene, *backend, default_threads(), stop, Progress::style_for(stderr, arguments.json));
    try {
        return merge_study(scene, folder, shards, shard_origin(folder, shards, scene), target, report, settings, check);
    } catch (MergeStopped const&) {
        return {};
    }
}

}  // namespace

int execute(MergeArguments const& arguments) {
    ShardFolder const folder(arguments.folder);
    std::string const made_by = folder.identity().program, here = build_info().text();
    if (made_by != here) {
        throw SceneError(fmt::format("{}: its shards were made by {}, this is {}; merge them with the former",
                                     arguments.folder, made_by, here));
    }
    std::string const scene_path = (std::filesystem::path(arguments.folder) / shard_names::identity).string();
    Scene scene = scene_of(folder);
    require_memory(memory_of_work(default_threads()));
    OutputTarget const target(arguments.output, {inputs_of(scene), arguments.force, is_result_file});
    require_outside(target, arguments.folder);
    require_room_beside(target.path());
    ShardClaim::require_nobody(shard_folder_of(arguments.output), arguments.output);
    std::vector<Shard> const shards = intact_shards(folder);
    mend(folder);
    scene.verify = asked_check(folder, shards, scene);
    std::optional<ToleranceReport> report;
    StopRequest stop;
    SignalScope const signals(stop);
    auto const merged = merged_unless_stopped(arguments, scene, folder, shards, target, report, stop);
    if (!merged) {
        tell("slideway: stopped early (signal): {} was not made, and {} is as it was: merge again\n", arguments.output, arguments.folder);
        return exit_code::stopped_early;
    }
    std::uint64_t const left = *merged;

    RunArguments replay;
    replay.scene.path = scene_path;
    ResultReader const results(arguments.output);
    if (arguments.json) {
        print_out("{}", result_json("merge", results, results.seal(), report, nullptr, left, {}, &scene));
        return left == 0 ? exit_code::done : exit_code::stopped_early;
    }
    // Of the commands that repeat failed members; starts are looked at for them alone.
    bool const some_failed = !failed_members(results, 1).empty();
    replay.any_start = some_failed && impossible_starts(scene, best_isa(scene.parts));
    print_field("scene", scene_text(scene, scene_path));
    print_results(replay, scene, results, report);
    print_out("\n");
    print_field("results", fmt::format("{}{}; {}", arguments.output, target.replaces() ? " (replaced a former file)" : "",
                                       words_on_need(folder, arguments.output, some_failed)));
    if (left == 0) return exit_code::done;
    tell("slideway: {} of {} members have not run; run them and merge again\n", left,
               folder.identity().members.count());
    return exit_code::stopped_early;
}

}  // namespace slideway::cli
