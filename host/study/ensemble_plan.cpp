#include "host/study/ensemble_plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/study/exponent_table.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {

namespace {

/// A smaller gap is crossed more often: from 0.5 to 0.05 mm the steps per second rise 1.6-fold (paper) to 6-fold (conservative).
MemberCost predicted_cost(Mechanism mechanism) {
    if (!info(mechanism).spatial) return [](Inputs const& inputs) { return 1 / inputs.clearance_y; };
    return [](Inputs const& inputs) { return 1 / std::min(play_y(inputs), play_z(inputs)); };
}

BlockRequest block_request(Scene const& scene) {
    OrbitSchedule const schedule = orbit_schedule(scene);
    BlockRequest request{scene.integrator,
                         scene.sample_times,
                         scene.quantities,
                         scene.series,
                         predicted_cost(scene.parts.mechanism),
                         schedule.timing,
                         schedule.stops,
                         schedule.sections,
                         schedule.crossings,
                         shadow_plan(scene),
                         {}};
    request.by_turns = schedule.by_turns;
    request.states = static_cast<std::size_t>(info(scene.parts.mechanism).states);
    request.columns = outputs_of(scene.parts.mechanism).columns;
    request.directions = [seed = scene.seed, shadows = request.shadows.count, parts = scene.parts](
                             std::uint64_t member, double* out) { draw_directions(seed, member, shadows, parts, out); };
    return request;
}

BlockDemand demand_of(Scene const& scene, BlockRequest const& request, int workers, std::size_t block_members) {
    return {scene.parts, request.shadows.count > 0, block_bytes(request, 1), workers, block_members};
}

}  // namespace

ResultLayout result_layout(Scene const& scene, MemberSet const& members) {
    ResultLayout layout;
    layout.members = members;
    layout.mechanism = scene.parts.mechanism;
    layout.sample_times = scene.sample_times;
    layout.by_turns = scene.goes_by_turns();
    layout.quantities = scene.quantities;
    layout.series = scene.series;
    auto const add = [&layout](Key const& key) { layout.parameters.push_back(parameter_column(key.name, key.unit, key.meaning, key.member)); };
    if (scene.study == StudyKind::sweep) {
        add(*scene.chaos.parameter);
        layout.sweep = layout.parameters.front().name;
    }
    for (Variation const& variation : scene.variations) add(*variation.key);
    OrbitSchedule const schedule = orbit_schedule(scene);
    layout.sections = schedule.section_rows();
    layout.crossings = schedule.crossings.room > 0;
    auto const exponents = std::make_shared<ExponentTable const>(scene);
    layout.study = exponents->columns();
    layout.study_row = [exponents](BlockResult const& block, std::size_t place) { return exponents->row(block, place); };
    if (scene.design.table != nullptr && !scene.design.table->labels.empty()) layout.labelled = scene.design.table;
    return layout;
}

StatisticsPlan statistics_plan(Scene const& scene) { return {scene.quantities, scene.limits, scene.parts.mechanism}; }

BlockDemand block_demand(Scene const& scene, Backend const& backend, int threads, std::size_t block_members) {
    return demand_of(scene, block_request(scene), backend.workers(threads), block_members);
}

EnsemblePlan ensemble_plan(Scene const& scene, MemberSet const& members, Backend const& backend, int threads,
                           std::size_t block_members) {
    EnsemblePlan plan;
    plan.members = members;
    plan.threads = plan.workers = backend.workers(threads);
    plan.request = block_request(scene);
    plan.blocks.fixed = block_members;
    plan.blocks.bounds = backend.bounds(demand_of(scene, plan.request, plan.threads, block_members));
    plan.source = [&scene](std::uint64_t member, Inputs& inputs) {
        inputs = member_inputs(scene, member);
        return !defect(inputs, scene.parts);
    };
    return plan;
}

Provenance provenance_of(Scene const& scene) {
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    LawInfo const& law = contact_info(scene.parts);
    Provenance result;
    result.title = scene.title;
    result.seed = scene.seed;
    result.mechanism = mechanism.meaning;
    if (mechanism.spatial || scene.parts.rigid) result.law = law.words, result.law_switches = law.switches;
    result.modules = modules_text(scene.parts);
    return result;
}

Provenance provenance(Scene const& scene, Backend const& backend, int threads) {
    Provenance result = provenance_of(scene);
    result.scene = resolved_toml(scene);
    result.maker = {std::string(backend.name()), backend.isa(), backend.flags(), threads};
    return result;
}

RunIdentity run_identity(Scene const& scene, MemberSet const& members, Backend const& backend) {
    std::string const resolved = resolved_toml(scene);
    return {build_info().text(), arithmetic_of(backend.isa()), members, portable_scene(resolved), paths_of_tables(resolved)};
}

}  // namespace slideway
