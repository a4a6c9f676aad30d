#include "host/study/prediction.hpp"

#include <algorithm>
#include <cmath>

#include "host/backend/linkage_numbers.hpp"
#include "host/config/linkages.hpp"
#include "host/config/settings.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/shard_writer.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/study_run.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/members/stiffest_rate.hpp"

namespace slideway {
namespace {

/// Tried steps per time 1/Ω where a slider rings in contact: measured in settling, gaps down to 10 µs and strong
/// damping included, at tolerances from 1e-3 to 1e-8, rounded up.  Of `auto` they are its explicit pair's, for a member
/// that never comes to rest long enough to change over.
double contact_steps(Parts const& parts, IntegratorSettings const& settings) {
    double const finer = 1e-6 / std::min(settings.rtol, settings.atol);
    bool const low_order = settings.method == Method::bs32 || (settings.method == Method::automatic && auto_takes_bs32(settings.rtol, settings.locate_modes || ends_at_changes(parts)));
    return low_order ? 15 * std::cbrt(finer) : 5 * std::pow(finer, 0.2);
}

/// Bytes of the statistics of so many members, in memory or in a file.
std::uint64_t statistics_image_bytes(Scene const& scene, std::uint64_t members) {
    constexpr std::uint64_t octaves = 8, buckets = octaves * 512, bytes_per_bucket = 16, beside = 700;
    std::uint64_t const columns = columns_of(scene.parts.mechanism, scene.quantities).size();
    constexpr std::uint64_t head = 4096;  // counts, failed members, who made it
    return head + columns * (beside + bytes_per_bucket * std::min(members, buckets));
}

/// What the end of a run holds at once: the report, with the numbers and the order of the members, their inputs with
/// ranks and copies, and a column that is ranked; or the widest quantity, one of its columns and that column sorted.
std::uint64_t summary_bytes(Scene const& scene) {
    // Those of all members and of one shard.
    if (!scene.stores_members()) return 2 * statistics_image_bytes(scene, member_count(scene));
    int widest = 0;
    for (OutputQuantity const& quantity : selected(outputs_of(scene.parts.mechanism).quantities, scene.quantities)) widest = std::max(widest, quantity.columns);
    std::uint64_t const members = member_count(scene), word = sizeof(double);
    std::uint64_t const plain = members * word * (1 + (widest > 0 ? static_cast<std::uint64_t>(widest) + 2 : 0));
    std::uint64_t const sections = orbit_schedule(scene).section_rows() > 0 ? members * word : 0;
    // What is freed leaves holes that larger pieces do not fit in: a quarter more, measured with a million members.
    auto const with_holes = [](std::uint64_t bytes) { return bytes + bytes / 4; };
    if (!asks_for_report(scene)) return with_holes(sections + plain);
    // Numbers and statuses, as they are read and as they are kept; later these make room for a column and its sorted
    // copy.
    std::uint64_t report = members * (4 * word);
    if (scene.design.kind == DesignKind::saltelli) {
        report += members * word;
    } else if (!scene.variations.empty()) {
        constexpr std::uint64_t of_input = 3, of_output = 5;  // values, ranks, a copy; also their order and places
        report += std::min<std::uint64_t>(members, ReportSettings().most_correlated) * word *
                  (of_input * scene.variations.size() + of_output);
    }
    constexpr std::uint64_t libraries = 16'000'000;  // of Eigen's and OpenMP's own, and what netCDF keeps of a file
    return libraries + with_holes(sections + std::max(plain, report));
}

struct StepRange {
    double least, most;
};

/// Of one member.
StepRange steps_of_member(Scene const& scene) {
    OrbitSchedule const schedule = orbit_schedule(scene);
    double const end = schedule.end;
    auto const stops = static_cast<double>(schedule.stops.count);
    if (has_fixed_step(scene.integrator.method)) {
        double const steps = fixed_steps(scene.integrator) + stops;
        return {steps, steps};
    }
    double const least = end / scene.integrator.max_step + stops;
    // Impacts have no duration; how many there are nobody knows.
    constexpr double rigid_steps = 20;
    if (scene.parts.rigid) return {least, rigid_steps * least};
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    Inputs const in = complete_inputs(scene.inputs, mechanism);
    Linkage const* const linkage = linkage_of(scene.parts.mechanism);
    double const rate = linkage != nullptr ? stiffest_rate(linkage->plan, in) : stiffest_rate(mechanism, info(scene.parts.law), in);
    return {least, least + end * rate * contact_steps(scene.parts, scene.integrator)};
}

/// How many shards members become at most: their blocks, of the dearest members that are foreseen.
std::uint64_t most_shards(Scene const& scene, MemberSet const& members, EnsemblePlan const& plan,
                          Backend const& backend) {
    bool const continued = is_continued(scene);
    std::uint64_t const places = place_count(scene, members);
    std::uint64_t const of_place = continued ? scene.chaos.values.size() : 1;
    auto const workers = static_cast<std::uint64_t>(plan.workers);
    if (plan.blocks.fixed > 0) return (places + plan.blocks.fixed - 1) / plan.blocks.fixed * of_place;
    BlockSizer sizer(plan.blocks, places, plan.workers);
    double const copies = 1 + shadow_plan(scene).count;
    double const seconds = static_cast<double>(of_place) * copies * steps_of_member(scene).most;
    constexpr double many = 1e9;
    sizer.measured(1, seconds * plan.workers * backend.seconds_per_step(many, plan.workers), 1);
    std::uint64_t blocks = workers;  // trials
    std::uint64_t left = places;
    // Sizes change only towards the end of the run.
    std::uint64_t const end = 4 * workers * (plan.blocks.bounds.most + sizer.next(left));
    if (left > end) {
        std::uint64_t const size = sizer.next(left), before = (left - end) / size;
        blocks += before;
        left -= before * size;
    }
    for (; left > 0; ++blocks) left -= std::min(left, sizer.next(left));
    return std::min(blocks, places) * of_place;
}

constexpr std::uint64_t most_tried = 32, most_steps_of_one = 100'000;
constexpr double full_lanes = 0.9;     // of lanes in use where members are many
constexpr double beside_members = 0.1;  // [s]: a program that starts, shards, the file made of them

}  // namespace

std::uint64_t statistics_bytes(Scene const& scene, std::uint64_t members) {
    constexpr std::uint64_t bins_and_edges = 129 * sizeof(double), quantiles = 36 * sizeof(double);
    return statistics_image_bytes(scene, members) +
           columns_of(scene.parts.mechanism, scene.quantities).size() * (bins_and_edges + quantiles);
}

std::uint64_t statistics_shard_bytes(Scene const& scene, std::uint64_t members) {
    // Blocks of one lane's width make the most shards; of each generation there are 64 at most, and the one made of
    // them.
    constexpr std::uint64_t joined = ShardStore::shards_joined, least_block = 8;
    std::uint64_t bytes = 0, of_shard = least_block;
    for (std::uint64_t shards = members / least_block + 1; shards > 0; shards /= joined) {
        bytes += (std::min(shards, joined) + 1) * statistics_image_bytes(scene, std::min(of_shard, members));
        of_shard *= joined;
    }
    return bytes;
}

std::uint64_t shard_bytes(Scene const& scene, MemberSet const& members, Backend const& backend, int threads,
                          std::size_t block_members) {
    if (!scene.stores_members()) return statistics_shard_bytes(scene, members.count());
    ResultLayout const layout = result_layout(scene, members);
    EnsemblePlan const plan = ensemble_plan(scene, members, backend, threads, block_members);
    return payload_bytes(layout) +
           most_shards(scene, members, plan, backend) * header_bytes(layout, provenance(scene, backend, threads));
}

std::uint64_t result_bytes(Scene const& scene, MemberSet const& members, Backend const& backend, int threads) {
    if (!scene.stores_members()) return statistics_bytes(scene, members.count());
    ResultLayout const layout = result_layout(scene, members);
    // A report has some ten variables of each column, described at length.
    constexpr std::uint64_t of_report = 10'000, of_column = 8'000;
    std::uint64_t const report =
        asks_for_report(scene) ? of_report + of_column * columns_of(scene.parts.mechanism, scene.quantities).size() : 0;
    return payload_bytes(layout) + header_bytes(layout, provenance(scene, backend, threads)) + report;
}

Prediction predict(Scene const& scene, Backend const& backend, int threads, std::size_t block_members) {
    std::uint64_t const count = member_count(scene);
    MemberSet const all(MemberRange{0, count});
    EnsemblePlan const plan = ensemble_plan(scene, all, backend, threads, block_members);
    auto const members = static_cast<double>(count);
    auto const workers = static_cast<std::uint64_t>(plan.threads);
    std::uint64_t const first_block = std::min(BlockSizer(plan.blocks, count, plan.threads).next(count), count);
    std::uint64_t const busy = std::min((count + first_block - 1) / first_block, workers);
    std::uint64_t const share = (count + workers - 1) / workers;
    std::uint64_t const largest =
        block_members > 0 ? std::min<std::uint64_t>(count, block_members)
                          : std::min<std::uint64_t>(plan.blocks.bounds.shared ? count : share, plan.blocks.bounds.most);

    Prediction prediction{};
    prediction.busy_threads = static_cast<int>(std::max<std::uint64_t>(busy, 1));
    prediction.largest_block = static_cast<std::size_t>(largest);
    prediction.buffer_bytes = busy * block_bytes(plan.request, static_cast<std::size_t>(largest));
    std::uint64_t const reserved = plan.blocks.bounds.reserved;
    // With the tenth that is left free of what blocks may have.
    prediction.card_bytes = reserved > 0 ? reserved + prediction.buffer_bytes / 9 * 10 : 0;
    // What travels is made ready beside the blocks.
    if (reserved > 0) prediction.buffer_bytes *= 2;
    // Copies of blocks: those that wait and the one that becomes a shard.  Its image, as it grows and when it is whole.
    constexpr std::uint64_t copies_of_blocks = ShardWriter::most_waiting + 1, images = 3;
    ResultLayout const of_block = result_layout(scene, MemberSet(MemberRange{0, largest}));
    prediction.image_bytes =
        copies_of_blocks * block_bytes(plan.request, static_cast<std::size_t>(largest)) +
        images * (scene.stores_members()
                      ? payload_bytes(of_block) + header_bytes(of_block, provenance(scene, backend, threads))
                      : statistics_image_bytes(scene, largest));
    prediction.summary_bytes = summary_bytes(scene);
    prediction.design_bytes = design_bytes(scene.design, scene.members);
    prediction.output_bytes = result_bytes(scene, all, backend, threads);
    prediction.shard_bytes = shard_bytes(scene, all, backend, threads, block_members);
    auto const [least, most] = steps_of_member(scene);
    prediction.least_steps = members * least;
    prediction.most_steps = members * most;
    double const copies = 1 + shadow_plan(scene).count;
    double const seconds_per_step = copies * backend.seconds_per_step(members, prediction.busy_threads);
    prediction.least_seconds = prediction.least_steps * seconds_per_step;
    prediction.most_seconds = prediction.most_steps * seconds_per_step;
    return prediction;
}

std::optional<Trial> try_members(Scene const& scene, Backend const& backend, int threads) {
    if (is_continued(scene) || backend.name() != "cpu") return std::nullopt;
    std::uint64_t const all = member_count(scene), count = std::min(all, most_tried);
    Scene trial = without_series(scene);
    auto const shadows = static_cast<std::uint64_t>(shadow_plan(scene).count);
    trial.integrator.max_steps = std::min(trial.integrator.max_steps, most_steps_of_one / (1 + shadows));
    double const end = orbit_schedule(scene).end;
    double steps = 0, tried = 0;
    auto const take = [&](BlockResult const& block) {
        for (MemberRecord const& record : block.records) {
            auto const own = static_cast<double>(record.steps_accepted + record.steps_rejected);
            bool const given_up = record.status == Status::max_steps && trial.integrator.max_steps < scene.integrator.max_steps;
            tried += own;
            steps += given_up && record.time > 0 ? own * std::max(1.0, end / record.time) : own;
        }
    };
    EnsembleTotals const totals = run_members(trial, spread_over(all, count), {backend, threads}, take);

    Trial found;
    found.members = count;
    found.steps = steps / static_cast<double>(count) * static_cast<double>(all);
    // Of few members lanes run empty towards the end, and threads wait for the last one; of many they do not.
    double const busy = std::min<double>(threads, static_cast<double>(count));
    double const of_a_step = tried > 0 ? totals.seconds * busy * totals.lane_utilisation() / tried : 0;
    double const lanes_used = all > 4 * count ? full_lanes : totals.lane_utilisation();
    double const checked = foreseen_check(scene, scene.verify, all) / static_cast<double>(all);
    found.seconds = beside_members + (1 + checked) * found.steps * of_a_step / (std::min<double>(threads, static_cast<double>(all)) * lanes_used);
    return found;
}

}  // namespace slideway
