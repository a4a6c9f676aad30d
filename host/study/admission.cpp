#include "host/study/admission.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "host/study/member_numbers.hpp"
#include "host/study/probe.hpp"
#include "host/study/result_summary.hpp"

namespace slideway {
namespace {

/// A member that is looked at, and what the kernels say of its start.
struct Start {
    std::uint64_t member;
    double clearance;  // the smaller one [m]
    ProbeResult at;

    double depth() const {
        double deepest = 0;
        for (int apex = 0; apex < 8; ++apex) deepest = std::max({deepest, at.penetration_y[apex], at.penetration_z[apex]});
        return deepest;
    }
    bool is_inside() const { return depth() > deepest_start * clearance; }
    bool is_nowhere() const { return at.status != Status::finished; }
};

/// Of members that draw what can be used.
std::vector<Start> starts_of(Scene const& scene, Isa isa, std::uint64_t looked) {
    std::vector<Start> starts;
    std::vector<Inputs> inputs;
    bool const spatial = info(scene.parts.mechanism).spatial;
    for (std::uint64_t const member : spread_over(member_count(scene), looked)) {
        Inputs const drawn = member_inputs(scene, member);
        if (defect(drawn, scene.parts)) continue;
        starts.push_back({member, spatial ? std::min(drawn.clearance_y, drawn.clearance_z) : drawn.clearance_y, {}});
        inputs.push_back(drawn);
    }
    std::vector<ProbeResult> const results = probe(isa, scene.parts, inputs, std::vector<double>(inputs.size(), 0.0));
    for (std::size_t i = 0; i < starts.size(); ++i) starts[i].at = results[i];
    return starts;
}

std::string depth_text(Start const& start) {
    double const energy = start.at.contact_potential;
    return fmt::format("by {:.3g} mm{}", 1e3 * start.depth(), energy > 0 ? fmt::format(", with {:.3g} J in its contacts", energy) : "");
}

constexpr std::string_view deep = "inside the way, deeper than a tenth of the clearance";

/// Of a row, at its place in the table.
std::optional<std::string> broken_row(Scene const& scene, std::vector<Start> const& starts) {
    MemberTable const& table = *scene.design.table;
    for (Start const& start : starts) {
        if (!start.is_inside() && !start.is_nowhere()) continue;
        auto const row = static_cast<std::size_t>(start.member);
        std::string const where = fmt::format("{}:{}", table.name, table.lines[row]);
        if (start.is_nowhere()) return fmt::format("{}: its mechanism cannot be evaluated at the start ({})", where, name_of(start.at.status));
        return fmt::format("{}: its member starts {}: {}", where, deep, depth_text(start));
    }
    return {};
}

std::optional<std::string> broken_draws(Scene const& scene, std::vector<Start> const& starts, std::uint64_t looked) {
    std::uint64_t const all = member_count(scene);
    auto const nowhere = static_cast<std::uint64_t>(std::ranges::count_if(starts, &Start::is_nowhere));
    if (!starts.empty() && nowhere == starts.size()) {
        return fmt::format("{} be evaluated at the start ({})", all == 1 ? "its mechanism cannot" : "no member can", name_of(starts.front().at.status));
    }
    auto const inside = std::ranges::count_if(starts, &Start::is_inside);
    if (inside == 0) return {};
    auto const deeper = [](Start const& a, Start const& b) { return (a.is_inside() ? a.depth() : 0) < (b.is_inside() ? b.depth() : 0); };
    Start const& worst = *std::ranges::max_element(starts, deeper);
    std::string const which = all == 1 ? std::string("it starts")
                                       : fmt::format("{} of {} members{} start", inside, looked, looked < all ? " that were looked at" : "");
    return fmt::format("{} {}: member {} {}", which, deep, worst.member, depth_text(worst));
}

/// Draws that break a rule fail alone; who checks a scene wants to know how many will.
std::optional<std::string> invalid_draws(Scene const& scene) {
    std::uint64_t const all = member_count(scene), looked = std::min(all, most_looked_at);
    std::uint64_t invalid = 0, first = 0;
    std::string why;
    for (std::uint64_t const member : spread_over(all, looked)) {
        auto const found = defect(member_inputs(scene, member), scene.parts);
        if (found && invalid++ == 0) first = member, why = *found;
    }
    if (invalid == 0) return {};
    return fmt::format("{}: {} of {} members{} draw what cannot be and will fail: member {}, {}", scene.path, invalid, looked, looked < all ? " that were looked at" : "", first, why);
}

}  // namespace

std::optional<std::string> impossible_starts(Scene const& scene, Isa isa) {
    std::uint64_t const looked = std::min(member_count(scene), most_looked_at);
    std::vector<Start> const starts = starts_of(scene, isa, looked);
    // Members whose inputs come from a program fail alone, as draws do.
    bool const of_file = scene.design.table != nullptr && !scene.design.table->lines.empty();
    return of_file ? broken_row(scene, starts) : broken_draws(scene, starts, looked);
}

std::optional<std::string> admit(Scene const& scene, bool any_start) {
    auto const wrong = impossible_starts(scene, best_isa());
    if (!wrong) return invalid_draws(scene);
    if (any_start) return wrong;
    bool const has_place = scene.design.table != nullptr && !scene.design.table->lines.empty();
    throw SceneError(fmt::format("{}{}; change {}, or add --any-start", has_place ? "" : scene.path + ": ", *wrong,
                                 has_place ? "the row" : "[initial] or [joint]"));
}

}  // namespace slideway
