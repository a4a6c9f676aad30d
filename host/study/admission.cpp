#include "host/study/admission.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "host/study/ensemble_plan.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/probe.hpp"
#include "host/study/result_summary.hpp"

namespace slideway {
namespace {

/// A member that is looked at, and what the kernels say of its start.
struct Start {
    std::uint64_t member;
    double play;                  // the smaller one [m]
    double preload_y, preload_z;  // how deep a slider in the middle is [m]
    double into_stops;            // [m]
    ProbeResult at;

    double depth() const {
        double deepest = 0;
        for (int apex = 0; apex < 8; ++apex) deepest = std::max({deepest, at.penetration_y[apex] - preload_y, at.penetration_z[apex] - preload_z});
        return deepest;
    }
    double deepest() const { return std::max(depth(), into_stops); }
    bool is_inside() const { return deepest() > deepest_start * play; }
    bool is_nowhere() const { return at.status != Status::finished; }
    /// Rigid contacts have no state inside the way; else the rod does not reach.
    std::string why_nowhere(Scene const& scene) const {
        bool const inside = scene.parts.rigid && at.status == Status::geometry && depth() > 1e-6 * play;
        return fmt::format("({}{})", name_of(at.status), inside ? fmt::format(": with rigid contacts it may not begin inside the way, by {:.3g} mm", 1e3 * depth()) : "");
    }
};

/// The members that are looked at.
struct Look {
    std::uint64_t members = 0;
    std::vector<Start> starts;  // of those that draw what can be used
    std::uint64_t invalid = 0, first_invalid = 0;
    std::string why_invalid;
    std::optional<std::pair<std::uint64_t, Problem>> unresolved;  // the first whose drive is not
};

/// How deep members start in stops, at least: by the energy that one as stiff as the stiffest would have.
void look_into_stops(Scene const& scene, Isa isa, std::vector<Inputs> const& inputs, std::vector<Start>& starts) {
    std::vector<Load> stops;
    std::copy_if(scene.parts.loads.loads, scene.parts.loads.loads + scene.parts.loads.count, std::back_inserter(stops),
                 [](Load const& load) { return load.kind == LoadKind::stop; });
    if (stops.empty()) return;
    Parts with = scene.parts, without = scene.parts;
    with.loads = {stops.data(), static_cast<int>(stops.size())}, without.loads = {};
    std::vector<double> const times(inputs.size(), 0.0);
    std::vector<ProbeResult> const stopped = probe(isa, with, inputs, times), free = probe(isa, without, inputs, times);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        double stiffest = 0;
        double const reach = size_of(scene.parts.mechanism, inputs[i]).length;
        for (Load const& stop : stops)
            stiffest = std::max(stiffest, stop.turns ? inputs[i].*load_inputs[stop.angular_stiffness] / (reach * reach) : inputs[i].*load_inputs[stop.stiffness]);
        starts[i].into_stops = std::sqrt(2 * std::max(stopped[i].energy - free[i].energy, 0.0) / stiffest);
    }
}

Look look_at(Scene const& scene, Isa isa) {
    Look look;
    look.members = std::min(member_count(scene), most_looked_at);
    std::vector<Start>& starts = look.starts;
    std::vector<Inputs> inputs;
    bool const spatial = info(scene.parts.mechanism).spatial;
    OrbitSchedule const schedule = orbit_schedule(scene);
    for (std::uint64_t const member : spread_over(member_count(scene), look.members)) {
        Inputs const drawn = member_inputs(scene, member);
        if (auto const found = defect(drawn, scene.parts)) {
            if (look.invalid++ == 0) look.first_invalid = member, look.why_invalid = *found;
            continue;
        }
        if (!look.unresolved) {
            auto problem = unresolved_drive(scene.parts, drawn, schedule.timing ? schedule.timing(drawn).end : schedule.end);
            if (problem) look.unresolved = {member, *std::move(problem)};
        }
        double const y = spatial ? mean_clearance_y(drawn) : 0, z = spatial ? mean_clearance_z(drawn) : 0;
        starts.push_back({member, size_of(scene.parts.mechanism, drawn).least_play, std::max(-y, 0.0), std::max(-z, 0.0), 0, {}});
        inputs.push_back(drawn);
    }
    std::vector<ProbeResult> const results = probe(isa, scene.parts, inputs, std::vector<double>(inputs.size(), 0.0));
    for (std::size_t i = 0; i < starts.size(); ++i) starts[i].at = results[i];
    look_into_stops(scene, isa, inputs, starts);
    return look;
}

std::string depth_text(Start const& start) {
    if (start.into_stops > start.depth()) return fmt::format("by {:.3g} mm", 1e3 * start.into_stops);
    double const energy = start.at.contact_potential;
    return fmt::format("by {:.3g} mm{}", 1e3 * start.depth(), energy > 0 ? fmt::format(", with {:.3g} J in its contacts", energy) : "");
}

std::string deep(Start const& start) {
    return fmt::format("inside {}, deeper than a tenth of the clearance", start.into_stops > start.depth() ? "a stop" : "the way");
}

/// Where a row stands: "members.csv:4".
std::string place_of_row(Scene const& scene, std::uint64_t member) {
    MemberTable const& table = *scene.design.table;
    return fmt::format("{}:{}", table.name, table.lines[static_cast<std::size_t>(member)]);
}

/// Of a row, at its place in the table.
std::optional<std::string> broken_row(Scene const& scene, std::vector<Start> const& starts) {
    for (Start const& start : starts) {
        if (!start.is_inside() && !start.is_nowhere()) continue;
        std::string const where = place_of_row(scene, start.member);
        if (start.is_nowhere()) return fmt::format("{}: its mechanism cannot be evaluated at the start {}", where, start.why_nowhere(scene));
        return fmt::format("{}: its member starts {}: {}", where, deep(start), depth_text(start));
    }
    return {};
}

std::optional<std::string> broken_draws(Scene const& scene, std::vector<Start> const& starts, std::uint64_t looked) {
    std::uint64_t const all = member_count(scene);
    auto const nowhere = static_cast<std::uint64_t>(std::ranges::count_if(starts, &Start::is_nowhere));
    if (!starts.empty() && nowhere == starts.size()) {
        return fmt::format("{} be evaluated at the start {}", all == 1 ? "its mechanism cannot" : "no member can", starts.front().why_nowhere(scene));
    }
    auto const inside = std::ranges::count_if(starts, &Start::is_inside);
    // The values of a sweep are given, not drawn.
    if (scene.study == StudyKind::sweep && nowhere > 0) {
        Start const& first = *std::ranges::find_if(starts, &Start::is_nowhere);
        return fmt::format("member {} cannot be evaluated at the start {}", first.member, first.why_nowhere(scene));
    }
    if (inside == 0) return {};
    auto const deeper = [](Start const& a, Start const& b) { return (a.is_inside() ? a.deepest() : 0) < (b.is_inside() ? b.deepest() : 0); };
    Start const& worst = *std::ranges::max_element(starts, deeper);
    std::string const which = all == 1 ? std::string("it starts")
                                       : fmt::format("{} of {} members{} start", inside, looked, looked < all ? " that were looked at" : "");
    return fmt::format("{} {}: member {} {}", which, deep(worst), worst.member, depth_text(worst));
}

bool is_of_a_file(Scene const& scene) { return scene.design.table != nullptr && !scene.design.table->lines.empty(); }

std::string unresolved_text(Scene const& scene, std::pair<std::uint64_t, Problem> const& found) {
    auto const& [member, problem] = found;
    std::string const where = is_of_a_file(scene) ? place_of_row(scene, member) : fmt::format("{}: member {}", scene.path, member);
    return fmt::format("{}: the study is too long: {}; {}", where, problem.reason, problem.advice);
}

std::optional<std::string> impossible_starts(Scene const& scene, Look const& look) {
    // Members whose inputs come from a program fail alone, as draws do.
    return is_of_a_file(scene) ? broken_row(scene, look.starts) : broken_draws(scene, look.starts, look.members);
}

/// Draws that break a rule fail alone; who checks a scene wants to know how many will.
std::optional<std::string> invalid_draws(Scene const& scene, Look const& look) {
    if (look.invalid == 0) return {};
    return fmt::format("{}: {} of {} members{} draw what cannot be and will fail: member {}, {}", scene.path, look.invalid, look.members,
                       look.members < member_count(scene) ? " that were looked at" : "", look.first_invalid, look.why_invalid);
}

}  // namespace

std::optional<std::string> impossible_starts(Scene const& scene, Isa isa) { return impossible_starts(scene, look_at(scene, isa)); }

std::optional<std::string> admit(Scene const& scene, bool any_start) {
    Look const look = look_at(scene, best_isa(scene.parts));
    if (look.unresolved) throw SceneError(unresolved_text(scene, *look.unresolved));
    auto const wrong = impossible_starts(scene, look);
    if (!wrong) return invalid_draws(scene, look);
    if (any_start) return wrong;
    bool const has_place = is_of_a_file(scene);
    bool const has_ends = scene.parts.loads.find(LoadKind::way_ends) != nullptr;
    std::string const scene_parts = fmt::format("[initial], [joint]{} or [mechanism]", has_ends ? ", [way_ends], off which it may begin," : "");
    throw SceneError(fmt::format("{}{}; change {}, or add --any-start", has_place ? "" : scene.path + ": ", *wrong, has_place ? "the row" : scene_parts));
}

}  // namespace slideway
