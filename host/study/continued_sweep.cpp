#include "host/study/continued_sweep.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/study/state_table.hpp"

namespace slideway {
namespace {

using State = std::array<double, state_size>;

/// Members [first, end).
struct Members {
    std::uint64_t first, end;
    std::uint64_t count() const { return end > first ? end - first : 0; }
};

Members common(Members a, Members b) { return {std::max(a.first, b.first), std::min(a.end, b.end)}; }

/// Clearances of the joint that a state comes from.
struct Gaps {
    double y = 1, z = 1;
};

/// Where each start stands: the state in which its member of the last column ended, if that one finished.
struct Places {
    std::vector<State> states;
    std::vector<Gaps> gaps;
    std::vector<char> is_known;
    explicit Places(std::uint64_t starts) : states(starts), gaps(starts), is_known(starts, 0) {}
};

/// A state of a joint in another one: places and velocities keep their share of the clearance, tilts that of the tighter
/// gap.  Else a slider that lay on its way would begin the next column inside it, or in the air.
void place(Inputs& inputs, State const& state, Gaps const& gaps) {
    double const along_y = inputs.clearance_y / gaps.y, along_z = inputs.clearance_z / gaps.z;
    double const tilt = std::min(along_y, along_z);
    double const share[state_size] = {along_y, along_z, along_y, along_z, tilt, tilt, tilt, tilt, tilt, tilt};
    for (std::size_t i = 0; i < state_size; ++i) inputs.*state_inputs[i] = share[i] * state[i];
}

}  // namespace

EnsembleTotals run_continued(Scene const& scene, EnsemblePlan plan, KernelInstance const& kernel, BlockSink const& sink,
                             StopRequest const& stop, Progress& progress) {
    std::uint64_t const starts = scene.members;
    Members const asked{plan.first_member, plan.first_member + plan.members};
    std::uint64_t const first_column = asked.first / starts, last_column = (asked.end - 1) / starts;
    // Within one column a start needs none but its own places; of several, the last may need all.
    Members const needed =
        first_column == last_column ? Members{asked.first % starts, (asked.end - 1) % starts + 1} : Members{0, starts};
    MemberSource const draw = plan.source;
    std::size_t const block_members =
        std::min<std::size_t>(plan.block_members, static_cast<std::size_t>(needed.count()));
    Places places(starts);
    EnsembleTotals totals;

    for (std::uint64_t column = 0; column <= last_column; ++column) {
        std::uint64_t const first = column * starts;
        plan.source = [&](std::uint64_t member, Inputs& inputs) {
            if (!draw(member, inputs)) return false;
            auto const start = static_cast<std::size_t>(member - first);
            if (!places.is_known[start]) return true;
            place(inputs, places.states[start], places.gaps[start]);
            inputs.start_angle = scene.chaos.section.level;  // where the column before has ended
            return true;
        };
        // Blocks read what a column before them has left: what this one leaves must wait for its end.
        Places ends = places;
        auto const run = [&](Members members, bool is_asked) {
            plan.first_member = members.first;
            plan.members = members.count();
            plan.block_members = block_members;
            return run_ensemble(
                plan, kernel,
                [&](BlockResult block) {
                    for (std::size_t i = 0; i < block.records.size(); ++i) {
                        auto const start = static_cast<std::size_t>(members.first - first + block.first) + i;
                        ends.gaps[start] = {block.inputs[i].clearance_y, block.inputs[i].clearance_z};
                        ends.is_known[start] = block.records[i].status == Status::finished;
                        std::copy_n(block.final_states.begin() + static_cast<std::ptrdiff_t>(i * state_size),
                                    state_size, ends.states[start].begin());
                    }
                    block.first += members.first - asked.first;
                    if (is_asked) sink(block);
                },
                stop, is_asked ? &progress : nullptr);
        };
        // Those before what is asked for only lead to it; those after it, in the last column, lead nowhere.
        Members const in_column{first + needed.first, first + needed.end}, here = common(in_column, asked);
        run({in_column.first, here.count() > 0 ? here.first : in_column.end}, false);
        if (here.count() > 0) totals += run(here, true);
        places = ends;
        if (stop.reason() == StopReason::none) continue;
        totals.not_run = asked.count() - (totals.failed() + totals.ended[static_cast<std::size_t>(Status::finished)]);
        totals.stopped = totals.not_run > 0 ? stop.reason() : StopReason::none;
        break;
    }
    return totals;
}

}  // namespace slideway
