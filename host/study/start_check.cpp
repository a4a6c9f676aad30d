#include "host/study/start_check.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "host/study/member_numbers.hpp"
#include "host/study/probe.hpp"

namespace slideway {

std::optional<std::string> impossible_starts(Scene const& scene, Isa isa) {
    std::uint64_t const all = member_count(scene), looked = std::min(all, most_looked_at);
    std::vector<std::uint64_t> members;
    std::vector<Inputs> inputs;
    for (std::uint64_t const member : spread_over(all, looked)) {
        Inputs const drawn = member_inputs(scene, member);
        if (defect(drawn, scene.parts)) continue;
        members.push_back(member);
        inputs.push_back(drawn);
    }
    std::vector<ProbeResult> const results = probe(isa, scene.parts, inputs, std::vector<double>(inputs.size(), 0.0));

    std::uint64_t count = 0;
    std::size_t worst = 0;
    double worst_depth = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
        double depth = 0;
        for (int apex = 0; apex < 8; ++apex) depth = std::max({depth, results[i].penetration_y[apex], results[i].penetration_z[apex]});
        if (!(depth > deepest_start * std::min(inputs[i].clearance_y, inputs[i].clearance_z))) continue;
        ++count;
        if (depth <= worst_depth) continue;
        worst_depth = depth;
        worst = i;
    }
    if (count == 0) return std::nullopt;
    std::string const which = all == 1 ? std::string("it starts")
                                       : fmt::format("{} of {} members{} start", count, looked, looked < all ? " that were looked at" : "");
    double const energy = results[worst].contact_potential;
    return fmt::format("{} inside the way, deeper than a tenth of the clearance: member {} by {:.3g} mm{}", which, members[worst],
                       1e3 * worst_depth, energy > 0 ? fmt::format(", with {:.3g} J in its contacts", energy) : "");
}

}  // namespace slideway
