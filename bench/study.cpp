// What the shards cost: a study to its result file over the same members through the driver alone.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <fmt/format.h>

#include "bench/command_line.hpp"
#include "bench/machine.hpp"
#include "bench/median.hpp"
#include "host/study/study_run.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The driver alone: blocks are dropped as they come.
double engine_seconds(Scene const& scene, StudyOptions const& options) {
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet(options.range), *options.backend, options.threads);
    StopRequest const stop;
    auto const start = std::chrono::steady_clock::now();
    run_ensemble(
        plan, options.backend->kernel(scene.parts, plan.request.shadows.count > 0), [](BlockResult const&) {}, stop);
    return seconds_since(start);
}

/// All that `slideway run` does but its summary: shards, merge, removal of the shards.
double study_seconds(Scene const& scene, StudyOptions const& options) {
    auto const start = std::chrono::steady_clock::now();
    StopRequest const stop;
    auto const ranks = Ranks::join();
    StudyRun run(scene, options);
    run_work(scene, options, run.work(), *ranks, stop);
    std::optional<ToleranceReport> report;
    if (!run.merge(stop, report)) std::abort();
    run.remove_shards();
    double const seconds = seconds_since(start);
    fs::remove(options.output);
    return seconds;
}

int benchmark(std::string const& path, std::string const& folder, int members, int threads, int rounds) {
    Scene scene = read_scene(path);
    scene.members = static_cast<std::uint64_t>(members);
    StudyOptions options;
    options.output = (fs::path(folder) / "bench_study.nc").string();
    options.range = {0, scene.members};
    options.backend = cpu_backend(best_isa());
    options.threads = threads;
    std::vector<double> engine, study, ratios;
    for (int round = 0; round < rounds; ++round) {
        engine.push_back(engine_seconds(scene, options));
        study.push_back(study_seconds(scene, options));
        ratios.push_back(study.back() / engine.back());
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("# A study to its result file\n\n{}- {}, {} members, {} threads, {}, {} rounds\n\n", machine_and_build(),
               path, members, threads, options.backend->isa(), rounds);
    fmt::print("| | median |\n|---|---|\n| driver alone, members/s | {:.1f} |\n", members / median(engine));
    fmt::print("| with shards and merge, members/s | {:.1f} |\n", members / median(study));
    fmt::print("| time per member over the driver's, median of the rounds' ratios | {:.3f} |\n", median(ratios));
    fmt::print("| least, most | {:.3f}, {:.3f} |\n", *std::min_element(ratios.begin(), ratios.end()),
               *std::max_element(ratios.begin(), ratios.end()));
    fmt::print("| resident at most | {:.0f} MB |\n", static_cast<double>(usage.ru_maxrss) / 1e3);
    return 0;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    slideway::bench::CommandLine line("Time per member of a study with shards, over the driver alone");
    std::string scene = "scenes/ensemble_starts.toml", folder = ".";
    int members = 20000, threads = 2, rounds = 5;
    line.option("--scene", scene, "Scene file");
    line.folder("--folder", folder, "Where shards and results go");
    line.count("--members", members, "Members");
    line.count("--threads", threads, "Threads");
    line.count("--rounds", rounds, "Rounds");
    if (auto const code = line.parse(argc, argv)) return *code;
    return slideway::benchmark(scene, folder, members, threads, rounds);
}
