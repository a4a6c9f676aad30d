#include "host/study/ensemble_study.hpp"

#include <algorithm>
#include <optional>

#include "host/output/result_writer.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/exponent_table.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {

namespace {

/// A smaller gap is crossed more often: from 0.5 to 0.05 mm the steps per second rise 1.6-fold (paper) to 6-fold (conservative).
double predicted_cost(Inputs const& inputs) { return 1 / std::min(inputs.clearance_y, inputs.clearance_z); }

}  // namespace

ResultLayout result_layout(Scene const& scene, MemberRange range) {
    ResultLayout layout{range.first, range.count, scene.sample_times, scene.quantities, scene.series, {}, 0, false,
                        "",          {}};
    auto const add = [&layout](Key const& key) {
        std::string name(key.name);
        std::replace(name.begin(), name.end(), '.', '_');
        layout.parameters.push_back({std::move(name), std::string(key.unit), std::string(key.meaning), key.member});
    };
    if (scene.study == StudyKind::sweep) {
        add(*scene.chaos.parameter);
        layout.sweep = layout.parameters.front().name;
    }
    for (Variation const& variation : scene.variations) add(*variation.key);
    OrbitSchedule const schedule = orbit_schedule(scene);
    layout.sections = schedule.section_rows();
    layout.crossings = schedule.crossings.room > 0;
    layout.study = ExponentTable(scene).layout();
    return layout;
}

EnsemblePlan ensemble_plan(Scene const& scene, MemberRange range, Isa isa, int threads) {
    EnsemblePlan plan;
    plan.first_member = range.first;
    plan.members = range.count;
    plan.block_members = default_block_members(range.count, threads, lanes_of(isa));
    plan.threads = threads;
    OrbitSchedule const schedule = orbit_schedule(scene);
    plan.request = {scene.integrator,
                    scene.sample_times,
                    scene.quantities,
                    scene.series,
                    predicted_cost,
                    schedule.timing,
                    schedule.stops,
                    schedule.sections,
                    schedule.crossings,
                    shadow_plan(scene),
                    {}};
    plan.request.directions = [seed = scene.seed, shadows = plan.request.shadows.count](
                                  std::uint64_t member, double* out) { draw_directions(seed, member, shadows, out); };
    plan.source = [&scene](std::uint64_t member, Inputs& inputs) {
        inputs = member_inputs(scene, member);
        return !defect(inputs);
    };
    return plan;
}

Provenance provenance(Scene const& scene, Isa isa, int threads) {
    return {scene.title, resolved_toml(scene), scene.seed, "cpu", std::string(name_of(isa)), flags_of(isa), threads};
}

EnsembleTotals run_ensemble_study(Scene const& scene, EnsembleOptions const& options, StopRequest const& stop) {
    ResultWriter writer(options.output, result_layout(scene, options.range),
                        provenance(scene, options.isa, options.threads));
    EnsemblePlan const plan = ensemble_plan(scene, options.range, options.isa, options.threads);
    EnsembleTotals totals;
    {
        Progress progress(options.range.count, options.progress, stderr, stop);
        ExponentTable const exponents(scene);
        KernelInstance const kernel = find_instance(options.isa, scene.parts);
        auto const sink = [&](BlockResult const& block) { writer.write(block, exponents.values(block)); };
        totals = scene.study == StudyKind::sweep && scene.chaos.continued
                     ? run_continued(scene, plan, kernel, sink, stop, progress)
                     : run_ensemble(plan, kernel, sink, stop, &progress);
    }
    writer.finish(totals.lane_utilisation(), totals.stopped);
    return totals;
}

}  // namespace slideway
