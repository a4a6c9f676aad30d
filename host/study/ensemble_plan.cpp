#include "host/study/ensemble_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/sampling/random.hpp"
#include "host/study/exponent_table.hpp"

namespace slideway {
namespace {

/// A smaller gap is crossed more often: from 0.5 to 0.05 mm the steps per second rise 1.6-fold (paper) to 6-fold (conservative).
MemberCost predicted_cost(Mechanism mechanism) {
    return [mechanism](Inputs const& inputs) { return 1 / size_of(mechanism, inputs).least_play; };
}

BlockRequest block_request(Scene const& scene) {
    OrbitSchedule const schedule = orbit_schedule(scene);
    BlockRequest request{scene.integrator,
                         scene.sample_times,
                         kept_for(outputs_of(scene.parts.mechanism), scene.quantities),
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

namespace {

// Records of growth, for the history and its errors: at least as many where there are as many rescalings, and not far more.
constexpr std::size_t least_records = 256, most_records = 4096;

std::size_t whole(double ratio) { return static_cast<std::size_t>(std::max(0.0, std::round(ratio))); }

/// The end is the last stop, to the last bit as the kernels compute it.
MemberClock clock(double first, double spacing, std::size_t stops) {
    return {std::fma(static_cast<double>(stops - 1), spacing, first), first, spacing};
}

/// Of a member that goes by turns, from angles.  @param first_back its first stop, if its crank turns back
MemberClock by_turns(MemberClock angles, double first_back, double time_limit) {
    if (angles.period == 0) angles.turns = angles.end;  // the others end at their last stop
    angles.first_back = first_back;
    angles.end = time_limit;
    return angles;
}

/// What a crank turns, forward, until it comes to a phase: in (0, 2π].  A start at the phase itself is no return to it.
double way_to(double phase, double start) {
    constexpr double turn = 2 * std::numbers::pi;
    double const way = std::fmod(phase - start, turn), positive = way > 0 ? way : way + turn;
    return positive > 1e-9 * turn ? positive : positive + turn;
}

/// Rescalings to a record: a divisor of `rescalings` if there is one that leaves neither too few records nor too many.
std::size_t rescalings_per_record(std::size_t rescalings, std::size_t repetitions = 1, std::size_t records = least_records) {
    std::size_t const all = rescalings * repetitions;
    std::size_t const most = std::clamp<std::size_t>(all / records, 1, rescalings);
    for (std::size_t n = most; n >= std::max<std::size_t>(1, all / most_records); --n) {
        if (rescalings % n == 0) return n;
    }
    return most;
}

/// Rescalings every dt from the start; those of the transient leave no record.
OrbitSchedule of_exponents(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    double const turn = turn_length(scene), dt = chaos.dt.seconds(turn);
    OrbitSchedule schedule;
    StopPlan& stops = schedule.stops;
    std::size_t const rescalings = std::max<std::size_t>(1, whole(chaos.span.seconds(turn) / dt));
    stops.growth_every = rescalings_per_record(rescalings, 1, std::max(least_records, chaos.history));
    std::size_t const records = (rescalings + stops.growth_every - 1) / stops.growth_every;
    stops.transient = std::max<std::size_t>(1, whole(chaos.transient.seconds(turn) / dt)) - 1;
    stops.count = stops.transient + records * stops.growth_every + 1;
    if (scene.goes_by_turns()) {
        MemberClock const of_all = by_turns(clock(dt, dt, stops.count), dt, scene.integrator.end_time);
        schedule.timing = [of_all](Inputs const&) { return of_all; };
        return schedule;
    }
    schedule.timing = [parts = scene.parts, spacing = chaos.dt, count = stops.count](Inputs const& inputs) {
        double const length = spacing.seconds(drive_period(parts, inputs));
        return clock(length, length, count);
    };
    return schedule;
}

/// Sections until an end, the first one after `first` in (0, 1], all in revolutions.  Whole ones hold as many wherever they start.
std::size_t sections_until(double end, double first) {
    constexpr double rounding = 1e-9;
    double const revolutions = std::round(end);
    return whole(std::abs(end - revolutions) < rounding ? revolutions : std::floor(end - first + rounding) + 1);
}

/// Sections once a revolution, with rescalings at equal times between them if there are shadows: of the scene's own member those of the record.
OrbitSchedule of_sections(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    double const turn = turn_length(scene), phase = chaos.section.level;
    double const first = scene.goes_by_turns() ? way_to(phase, scene.inputs.start_angle) : first_time_at(phase, scene.parts, scene.inputs);
    double const begin = chaos.transient.seconds(turn), end = begin + chaos.span.seconds(turn);
    std::size_t const per_turn = chaos.exponents > 0 ? std::max<std::size_t>(1, whole(turn / chaos.dt.seconds(turn))) : 1;
    std::size_t const transient = sections_until(begin / turn, first / turn);
    std::size_t const least = chaos.exponents > 0 && transient == 0 ? 2 : 1;  // growth is that from section to section
    std::size_t const sections = std::max(least, sections_until(end / turn, first / turn) - transient);
    OrbitSchedule schedule;
    schedule.sections = true;
    schedule.stops.transient = transient * per_turn;
    schedule.stops.count = schedule.stops.transient + (sections - 1) * per_turn + 1;
    schedule.stops.section_every = per_turn;
    // The revolution before the first section counts too: growth over as many revolutions as there are sections.
    if (chaos.exponents > 0) {
        schedule.stops.growth_lead = transient > 0 ? per_turn : 0;
        schedule.stops.growth_every = rescalings_per_record(per_turn, sections);
    }
    std::size_t const count = schedule.stops.count;
    if (scene.goes_by_turns()) {
        schedule.timing = [phase, spacing = turn / static_cast<double>(per_turn), count, limit = scene.integrator.end_time](Inputs const& in) {
            return by_turns(clock(way_to(phase, in.start_angle), spacing, count), way_to(in.start_angle, phase), limit);
        };
        return schedule;
    }
    schedule.timing = [parts = scene.parts, phase, per_turn, count](Inputs const& inputs) {
        double const spacing = drive_period(parts, inputs) / static_cast<double>(per_turn);
        return clock(first_time_at(phase, parts, inputs), spacing, count);
    };
    return schedule;
}

/// What is recorded of a section: where a rigid contact closes its gap, an impact.
CrossingPlan::On crossings_of(Scene const& scene) {
    SectionSurface const& section = scene.chaos.section;
    bool const closes = section.level == 0 && scene.parts.rigid && scene.integrator.method != Method::moreau_jean;
    using On = SectionSurface::On;
    switch (section.on) {
        case On::gap_y:
            return closes ? CrossingPlan::On::impacts_y : CrossingPlan::On::gap_y;
        case On::gap_z:
            return closes ? CrossingPlan::On::impacts_z : CrossingPlan::On::gap_z;
        case On::impacts:
            return CrossingPlan::On::impacts;
        case On::phase:
        case On::state:
            break;
    }
    return CrossingPlan::On::state;
}

/// Crossings from the end of the transient on.
OrbitSchedule of_crossings(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    OrbitSchedule schedule;
    schedule.sections = true;
    bool const of_state = chaos.section.on == SectionSurface::On::state;
    bool const turns = of_state && info(scene.parts.mechanism).state[chaos.section.index] == Series::crank_angle;
    schedule.crossings = {crossings_of(scene), chaos.section.direction, turns, chaos.section.index, chaos.section.level, chaos.max_crossings};
    if (scene.goes_by_turns()) {
        double const from = chaos.transient.seconds(turn_length(scene)), to = from + chaos.span.seconds(turn_length(scene));
        MemberClock const of_all = by_turns({to, from, 0}, from, scene.integrator.end_time);
        schedule.timing = [of_all](Inputs const&) { return of_all; };
        return schedule;
    }
    schedule.timing = [parts = scene.parts, transient = chaos.transient, span = chaos.span](Inputs const& inputs) {
        double const period = drive_period(parts, inputs), from = transient.seconds(period);
        return MemberClock{from + span.seconds(period), from, 0};
    };
    return schedule;
}

/// What a crank has turned at the end, whichever way it turns, at least [rad].
double least_turned(OrbitSchedule const& schedule, Scene const& scene) {
    MemberClock const own = schedule.timing(scene.inputs);
    std::size_t const stops = schedule.stops.count;
    return stops == 0 ? own.turns : std::fma(static_cast<double>(stops - 1), own.period, std::min(own.first_stop, own.first_back));
}

}  // namespace

OrbitSchedule orbit_schedule(Scene const& scene) {
    OrbitSchedule schedule;
    if (scene.study == StudyKind::lyapunov) schedule = of_exponents(scene);
    if (scene.study == StudyKind::poincare || scene.study == StudyKind::sweep) {
        schedule = scene.chaos.section.on == SectionSurface::On::phase ? of_sections(scene) : of_crossings(scene);
    }
    if (scene.goes_by_turns() && !schedule.timing) {
        MemberClock const of_all = by_turns({.end = scene.chaos.span.seconds(turn_length(scene))}, 0, scene.integrator.end_time);
        schedule.timing = [of_all](Inputs const&) { return of_all; };
    }
    if (scene.has_own_ends())
        schedule.timing = [parts = scene.parts, span = scene.chaos.span](Inputs const& in) { return MemberClock{.end = span.seconds(drive_period(parts, in))}; };
    schedule.by_turns = scene.goes_by_turns();
    schedule.end = schedule.timing ? schedule.timing(scene.inputs).end : scene.integrator.end_time;
    schedule.turns = (schedule.by_turns ? least_turned(schedule, scene) : schedule.end) / turn_length(scene);
    return schedule;
}

ShadowPlan shadow_plan(Scene const& scene) {
    if (scene.study == StudyKind::ensemble || scene.study == StudyKind::poincare) return {};
    ChaosSettings const& chaos = scene.chaos;
    return {chaos.exponents, chaos.d0, chaos.d0_lower, chaos.d0_upper, nullptr};
}

void draw_directions(std::uint64_t seed, std::uint64_t member, int shadows, Parts const& parts, double* directions) {
    int const states = info(parts.mechanism).states;
    for (int shadow = 0; shadow < shadows; ++shadow) {
        double* const w = directions + shadow * states;
        double squares = 0;
        for (int i = 0; i < states; ++i) {
            std::uint64_t const place = static_cast<std::uint64_t>(shadow) * static_cast<std::uint64_t>(states) + static_cast<std::uint64_t>(i);
            std::uint64_t const word = philox({member, place, 0, 0}, {seed, name_hash("shadow")})[0];
            w[i] = is_prescribed(parts, i)
                       ? 0
                       : static_cast<double>(static_cast<std::int64_t>(word >> 11)) * 0x1p-52 - 1;  // in [-1, 1)
            squares += w[i] * w[i];
        }
        double const length = std::sqrt(squares);
        for (int i = 0; i < states; ++i) w[i] /= length;
    }
}

}  // namespace slideway
