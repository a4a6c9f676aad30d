#include "host/study/trial.hpp"

#include <algorithm>
#include <vector>

#include "host/run/ensemble.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/orbit_schedule.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr std::uint64_t most_tried = 32, most_steps_of_one = 100'000;
constexpr double full_lanes = 0.9;     // of lanes in use where members are many
constexpr double beside_members = 0.1;  // [s]: a program that starts, shards, the file made of them

}  // namespace

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
    EnsemblePlan const plan = ensemble_plan(trial, MemberSet::of(spread_over(all, count)), backend, threads);
    StopRequest const nobody;
    EnsembleTotals const totals = run_ensemble(plan, backend.kernel(trial.parts, plan.request.shadows.count > 0), take, nobody);

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
