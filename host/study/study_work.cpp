// Members of a study, through host/run, into shards; at every rank.
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/run/rank_messages.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/shard_writer.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/study_run.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

/// The ends of those of the members that earlier runs have finished.
MemberEnds recalled_ends(std::string const& path, Mechanism mechanism, MemberSet const& wanted) {
    MechanismInfo const& has = info(mechanism);
    auto const ends = std::make_shared<std::unordered_map<std::uint64_t, MemberEnd>>();
    ShardFolder const folder(path);
    for (Shard const& shard : folder.listed()) {
        if (!shard.members.overlaps(wanted)) continue;
        NetcdfFile const file = NetcdfFile::open_in_memory(shard.name, folder.read(shard));
        std::vector<std::uint64_t> const members = shard.members.members(0, shard.members.count());
        ResultView const results(file);
        std::vector<double> const statuses = results.values("status", members.size());
        std::vector<std::vector<double>> states;
        states.reserve(static_cast<std::size_t>(has.states));
        for (int k = 0; k < has.states; ++k) states.push_back(results.values(std::string("final_") + state_info(has, k).name, members.size()));
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (!wanted.contains(members[i])) continue;
            MemberEnd& end = (*ends)[members[i]];
            end.finished = status_of(statuses[i]) == Status::finished;
            for (std::size_t k = 0; k < states.size(); ++k) end.state[k] = states[k][i];
        }
    }
    return [ends](std::uint64_t member) -> std::optional<MemberEnd> {
        auto const found = ends->find(member);
        return found == ends->end() ? std::nullopt : std::optional(found->second);
    };
}

/// Result files of a scene's blocks, or their statistics.
std::unique_ptr<ShardWriter> shard_writer(Scene const& scene, StudyOptions const& options, ShortRun* brief = nullptr) {
    std::string const folder = shard_folder_of(options.output);
    Provenance const origin = provenance(scene, *options.backend, options.threads);
    if (!scene.stores_members()) {
        auto form = [plan = statistics_plan(scene), maker = origin.maker](BlockResult const& block) { return statistics_image(plan, maker, block); };
        return std::make_unique<ShardWriter>(folder, std::move(form), joined_statistics);
    }
    auto form = [folder, origin, layout = result_layout(scene, {})](BlockResult const& block) { return shard_image(folder, layout, origin, block); };
    return std::make_unique<ShardWriter>(folder, std::move(form), ShardJoin(), brief);
}

/// This rank's share of the work.
EnsembleTotals compute(Scene const& scene, StudyOptions const& options, StudyWork const& work, int ranks,
                       MemberQueue& queue, StopRequest const& stop, Progress& progress) {
    std::string const folder = shard_folder_of(options.output);
    EnsemblePlan plan = ensemble_plan(scene, work.todo, *options.backend, options.threads, options.block_members);
    plan.workers = plan.threads * ranks;
    BlockKernel const kernel = options.backend->kernel(scene.parts, plan.request.shadows.count > 0);
    if (is_continued(scene)) {
        MemberEnds const ends = work.before > 0
                                    ? recalled_ends(folder, scene.parts.mechanism, members_before(scene, work.todo))
                                    : MemberEnds{};
        continue_columns(scene, plan, work.todo, kernel, ends, stop);
    }
    auto const writer = shard_writer(scene, options, work.brief);
    BlockSink const sink = [&](BlockResult const& block) { writer->write(block); };
    EnsembleTotals const totals = run_ensemble(plan, queue, kernel, sink, stop, &progress);
    writer->finish(totals.stopped == StopReason::none);
    return totals;
}

/// With the check that follows where it is small; what a large one takes is known but roughly.
ProgressTask progress_task(Scene const& scene, StudyOptions const& options, StudyWork const& work, int ranks) {
    constexpr double small = 0.25;
    ProgressTask task{work.before + work.todo.count(), work.before};
    if (options.part.of_array) return task;
    auto const all = static_cast<double>(task.members);
    // Rank 0 alone checks, and its lanes take as long for few members as for those that fill them.
    EnsemblePlan const plan = ensemble_plan(scene, work.todo, *options.backend, options.threads, options.block_members);
    double const lanes = static_cast<double>(plan.threads) * static_cast<double>(plan.blocks.bounds.lanes);
    double const check = foreseen_check(scene, scene.verify, task.members) * std::max(1 / lanes, 1 / static_cast<double>(2 * least_members)) *
                         std::min(all, ranks * lanes);
    task.check_follows = check > small * all;
    if (!task.check_follows) task.after = check;
    return task;
}

}  // namespace

void put_into_shards(Scene const& scene, StudyOptions const& options, ShortRun& brief) {
    if (!brief.block) return;
    brief.claim();
    auto const writer = shard_writer(scene, options);
    writer->write(brief.block());
    writer->finish();
    brief.block = {};
}

EnsembleTotals run_work(Scene const& scene, StudyOptions const& options, StudyWork const& work, Ranks& ranks,
                        StopRequest const& stop) {
    std::uint64_t const places = place_count(scene, work.todo);
    Progress progress(progress_task(scene, options, work, ranks.count()), options.progress, stderr, stop);
    auto const queue = ranks.share(places, [&](std::uint64_t members) { progress.add_distant(members); });
    // Every rank comes to `gather`, whatever happens to it, and before its queue ends: others may still take from it.
    std::string mine;
    std::exception_ptr failure;
    try {
        mine = to_bytes(compute(scene, options, work, ranks.count(), *queue, stop, progress));
    } catch (std::exception const&) {
        failure = std::current_exception();
        queue->abandon();
        mine = to_bytes(failure);
    }
    std::vector<std::string> const all = ranks.gather(mine);
    if (ranks.rank() > 0) return {};
    if (failure) std::rethrow_exception(failure);
    return sum_of(all);
}

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
