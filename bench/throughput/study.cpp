// What shards and merge cost: a study to its result file beside the same members through the driver alone.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include <unistd.h>

#include "bench/throughput/throughput.hpp"
#include "host/study/study_run.hpp"

namespace slideway::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t members = 512;

Scene scattered_starts() {
    Scene scene = read_scene(SLIDEWAY_SCENES "/ensemble_starts.toml");
    scene.members = members;
    return scene;
}

StudyOptions options_of(Scene const& scene) {
    StudyOptions options;
    options.output = (fs::temp_directory_path() / ("bench_study_" + std::to_string(getpid()) + ".nc")).string();
    options.range = {0, scene.members};
    options.backend = cpu_backend(best_isa());
    options.threads = 1;
    return options;
}

/// The driver alone: blocks are dropped as they come.
void time_driver(benchmark::State& state) {
    auto const scene = scattered_starts();
    auto const options = options_of(scene);
    for (auto _ : state) {
        EnsemblePlan const plan = ensemble_plan(scene, MemberSet(options.range), *options.backend, options.threads);
        StopRequest const stop;
        run_ensemble(
            plan, options.backend->kernel(scene.parts, plan.request.shadows.count > 0), [](BlockResult const&) {}, stop);
    }
    count_rate(state, "members/s", members);
}

/// All that `slideway run` does but its summary: shards, merge, removal of the shards.
void time_study(benchmark::State& state) {
    auto const scene = scattered_starts();
    auto const options = options_of(scene);
    for (auto _ : state) {
        StopRequest const stop;
        auto const ranks = Ranks::join();
        StudyRun run(scene, options);
        run_work(scene, options, run.work(), *ranks, stop);
        std::optional<ToleranceReport> report;
        if (!run.merge(stop, report)) return state.SkipWithError("shards and result do not come together");
        run.remove_shards();
        fs::remove(options.output);
    }
    count_rate(state, "members/s", members);
}

}  // namespace

void register_study() {
    benchmark::RegisterBenchmark("study/driver alone", time_driver)->Unit(benchmark::kMillisecond)->UseRealTime();
    benchmark::RegisterBenchmark("study/shards and merge", time_study)->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace slideway::bench
