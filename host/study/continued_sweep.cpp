#include "host/study/continued_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace slideway {
namespace {

using State = std::array<double, state_size>;

/// Initial state of the inputs, in the order of the state.
constexpr double Inputs::*initial[state_size] = {&Inputs::y,    &Inputs::z,   &Inputs::vy,    &Inputs::vz, &Inputs::roll,
                                                 &Inputs::yaw,  &Inputs::pitch, &Inputs::wx,  &Inputs::wy, &Inputs::wz};

}  // namespace

EnsembleTotals run_continued(Scene const& scene, EnsemblePlan plan, KernelInstance const& kernel, BlockSink const& sink,
                             StopRequest const& stop, Progress& progress) {
    std::uint64_t const starts = scene.members, columns = plan.members / starts;
    std::vector<State> states(static_cast<std::size_t>(starts));
    std::vector<char> is_known(states.size(), 0);
    MemberSource const draw = plan.source;
    plan.members = starts;
    plan.block_members = std::min<std::size_t>(plan.block_members, static_cast<std::size_t>(starts));
    EnsembleTotals totals;
    for (std::uint64_t column = 0; column < columns; ++column) {
        std::uint64_t const first = column * starts;
        plan.first_member = first;
        plan.source = [&](std::uint64_t member, Inputs& inputs) {
            if (!draw(member, inputs)) return false;
            auto const start = static_cast<std::size_t>(member - first);
            if (!is_known[start]) return true;
            for (std::size_t i = 0; i < state_size; ++i) inputs.*initial[i] = states[start][i];
            inputs.start_angle = scene.chaos.section.level;  // where the column before has ended
            return true;
        };
        // Blocks read what a column before them has left: what this one leaves must wait for its end.
        std::vector<State> ends = states;
        std::vector<char> has_ended(states.size(), 0);
        EnsembleTotals const of_column = run_ensemble(
            plan, kernel,
            [&](BlockResult block) {
                for (std::size_t i = 0; i < block.records.size(); ++i) {
                    auto const start = static_cast<std::size_t>(block.first) + i;
                    has_ended[start] = block.records[i].status == Status::finished;
                    std::copy_n(block.final_states.begin() + static_cast<std::ptrdiff_t>(i * state_size), state_size,
                                ends[start].begin());
                }
                block.first += first;
                sink(block);
            },
            stop, &progress);
        states = ends;
        is_known = has_ended;
        totals += of_column;
        if (of_column.stopped != StopReason::none) {
            totals.not_run += (columns - column - 1) * starts;
            break;
        }
    }
    return totals;
}

}  // namespace slideway
