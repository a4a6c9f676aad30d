#include "bench/work_precision/members.hpp"

#include <fmt/os.h>

#include <cstddef>
#include <string>
#include <utility>

#include "bench/work_precision/references.hpp"
#include "kernels/inputs.hpp"

namespace slideway::bench {
namespace {

using Numbers = std::vector<std::pair<std::string, double>>;

Numbers numbers(SliderEnsemble const& ensemble, std::size_t i) {
    Numbers found;
    for (Key const& key : input_keys) found.emplace_back(key.name, key.get(ensemble.members[i]));
    return found;
}
Numbers numbers(BouncingEnsemble const& ensemble, std::size_t i) {
    auto const& m = ensemble.members[i];
    return {{"y", m.y}, {"v", m.v}, {"stiffness", m.stiffness}, {"rate", m.rate}};
}
Numbers numbers(LorenzEnsemble const& ensemble, std::size_t i) {
    auto const& m = ensemble.members[i];
    return {{"sigma", m.sigma}, {"rho", m.rho}, {"beta", m.beta}, {"x", m.start[0]}, {"y", m.start[1]}, {"z", m.start[2]}};
}
Numbers numbers(ValveEnsemble const& ensemble, std::size_t i) { return {{"inflow", ensemble.members[i].inflow}}; }

}  // namespace

void write_members(std::filesystem::path const& file, Problem const& problem) {
    if (problem.measure != Measure::state) return;
    auto out = fmt::output_file(file.string());
    for (std::size_t member = 0; member < problem.shared; ++member) {
        auto row = std::visit([&](auto const& e) { return numbers(e, member); }, problem.ensemble);
        row.emplace_back("end_time", problem.end_time);
        auto const scale = scales(problem.ensemble, member);
        for (std::size_t i = 0; i < scale.size(); ++i) {
            row.emplace_back(fmt::format("scale.{}", i), scale[i]);
            row.emplace_back(fmt::format("end.{}", i), problem.reference[member][i]);
        }
        for (std::size_t i = 0; member == 0 && i < row.size(); ++i) out.print("{}{}", i == 0 ? "" : ",", row[i].first);
        if (member == 0) out.print("\n");
        for (std::size_t i = 0; i < row.size(); ++i) out.print("{}{:.17g}", i == 0 ? "" : ",", row[i].second);
        out.print("\n");
    }
}

}  // namespace slideway::bench
