
#include <optional>

#include <fmt/format.h>

#include "host/store/result_merge.hpp"
#include "host/store/statistics_merge.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/study_run.hpp"

namespace slideway {
namespace {

/// What takes the blocks of a run and makes a file of them.
class MemoryStore {
public:
    MemoryStore(Scene const& scene, ResultMerge merge) : scene_(scene), merge_(std::move(merge)) {}

    void take(BlockResult const& block) {
        if (!scene_.stores_members()) return statistics_.add(block, plan_);
        shards_.push_back(memory_shard(scene_.path, merge_.layout, block));
        if (shards_.back().members.empty()) shards_.pop_back();
    }
    MemoryFile file(std::uint64_t left) {
        MemoryFile file(scene_.path);
        if (left > 0) merge_.completeness = fmt::format("{} of {} members not run", left, merge_.layout.members.count());
        if (scene_.stores_members())
            write_merged(file, shards_, merge_);
        else
            write_merged(file, statistics_, merge_);
        file.put(DataFile::global, "completeness", merge_.completeness);
        return file;
    }

private:
    Scene const& scene_;
    ResultMerge merge_;
    StatisticsPlan const plan_ = statistics_plan(scene_);
    BlockStatistics statistics_{plan_};
    std::vector<MergedShard> shards_;
};

}  // namespace

MemoryFile run_in_memory(Scene const& scene, MemoryRun const& run) {
    MemberSet const members(MemberRange{0, member_count(scene)});
    EnsemblePlan plan = ensemble_plan(scene, members, *run.backend, run.threads);
    BlockKernel const kernel = run.backend->kernel(scene.parts, plan.request.shadows.count > 0);
    if (is_continued(scene)) continue_columns(scene, plan, members, kernel, {}, run.stop);
    ResultMerge merge{.layout = result_layout(scene, members),
                      .provenance = provenance(scene, *run.backend, run.threads),
                      .completeness = "complete",
                      .conclude = {},
                      .pause = {}};
    std::uint64_t left = 0;
    auto const check = resolution_check(scene, *run.backend, run.threads, run.stop, run.progress);
    merge.conclude = [&](DataFile& file) {
        std::optional<ToleranceReport> report;
        conclude_study(scene, file, report, {run.threads});
        if (run.verify && left == 0) check(file);
    };
    MemoryStore store(scene, std::move(merge));
    std::optional<Progress> progress;
    if (run.progress != Progress::Style::none) progress.emplace(ProgressTask{members.count()}, run.progress, stderr, run.stop);
    BlockSink const sink = [&](BlockResult const& block) { store.take(block); };
    left = members.count() - run_ensemble(plan, kernel, sink, run.stop, progress ? &*progress : nullptr).done();
    progress.reset();
    return store.file(left);
}

std::uint64_t memory_bytes(Scene const& scene) {
    return payload_bytes(result_layout(scene, MemberSet(MemberRange{0, member_count(scene)})));
}

}  // namespace slideway
