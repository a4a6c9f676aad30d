#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "host/cli/commands.hpp"
#include "host/cli/run_summary.hpp"
#include "host/cli/text.hpp"
#include "host/output/result_merge.hpp"
#include "host/study/study_run.hpp"

namespace slideway::cli {

int merge(MergeArguments const& arguments) {
    ShardFolder const folder(arguments.folder);
    std::string const made_by = folder.identity().program, here = build_info().text();
    if (made_by != here) {
        throw SceneError(fmt::format("{}: its shards were made by {}, this is {}; merge them with the former",
                                     arguments.folder, made_by, here));
    }
    std::string const scene_path = (std::filesystem::path(arguments.folder) / shard_names::identity).string();
    Scene const scene = scene_of(folder);
    require_writable_place(arguments.output);
    std::error_code ignored;
    bool const replaced = std::filesystem::exists(arguments.output, ignored);
    std::optional<ToleranceReport> report;
    std::uint64_t const left = merge_study(scene, folder, shard_origin(folder, scene), arguments.output, report);

    RunArguments replay;
    replay.scene.path = scene_path;
    ResultReader const results(arguments.output);
    print_field("scene", scene.title.empty() ? scene_path : fmt::format("{} ({})", scene.title, scene_path));
    print_results(replay, scene, parse_isa(results.attribute("isa")), results, report);
    fmt::print("\n");
    print_field("results", fmt::format("{}{}; {} is no longer needed", arguments.output,
                                       replaced ? " (replaced a former file)" : "", arguments.folder));
    if (left == 0) return exit_code::done;
    fmt::print(stderr, "slideway: {} of {} members have not run; run them and merge again\n", left,
               folder.identity().members.count());
    return exit_code::stopped_early;
}

}  // namespace slideway::cli
