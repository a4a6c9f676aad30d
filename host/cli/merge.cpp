#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "host/cli/commands.hpp"
#include "host/cli/run_summary.hpp"
#include "host/cli/text.hpp"
#include "host/output/result_merge.hpp"
#include "host/study/study_run.hpp"

namespace slideway::cli {
namespace {

Provenance provenance_of(ShardFolder const& folder, Scene const& scene) {
    std::vector<Shard> const shards = folder.listed();
    if (shards.empty()) throw FileError(folder.path() + ": holds no finished members");
    std::vector<std::byte> const bytes = folder.read(shards.front());
    NetcdfFile const file = NetcdfFile::open_in_memory(shards.front().name, bytes);
    auto const text = [&](char const* name) { return file.text(NetcdfFile::global, name); };
    Provenance from{scene.title, folder.identity().scene, scene.seed, text("backend"), text("isa"), text("flags"), 1};
    double threads = 1;
    if (file.number(NetcdfFile::global, "threads", threads)) from.threads = static_cast<int>(threads);
    return from;
}

}  // namespace

int merge(MergeArguments const& arguments) {
    ShardFolder const folder(arguments.folder);
    std::string const made_by = folder.identity().program, here = build_info().text();
    if (made_by != here) {
        throw SceneError(fmt::format("{}: its shards were made by {}, this is {}; merge them with the former",
                                     arguments.folder, made_by, here));
    }
    std::string const scene_path = (std::filesystem::path(arguments.folder) / shard_names::identity).string();
    Scene const scene = parse_scene(folder.identity().scene, scene_path);
    require_writable_place(arguments.output);
    std::error_code ignored;
    bool const replaced = std::filesystem::exists(arguments.output, ignored);
    std::optional<ToleranceReport> report;
    std::uint64_t const left = merge_study(scene, folder, provenance_of(folder, scene), arguments.output, report);

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
