// The memory of one block: inputs and results, reused from block to block by the same thread.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/run/stop.hpp"
#include "kernels/block.hpp"

namespace slideway {

struct BlockResult {
    std::span<std::uint64_t const> members;  // their numbers in the scene, ascending
    std::span<Inputs const> inputs;          // [members], as drawn, also those that cannot be used
    std::span<MemberRecord const> records;   // [members]
    std::span<double const> final_states;    // [members][states()]; NaN for a member that was not integrated
    std::span<double const> quantities;      // [members][columns()]; NaN where not selected or not integrated
    std::span<double const> series;          // [selected series, in table order][members][samples]
    std::span<double const> sections;        // [members][sections][section_columns(states())]; NaN where not reached
    std::span<double const> growths;         // [members][growths][shadows], ln; NaN where not reached
    std::span<double const> clock = {};      // [members][samples], by turns: when each was [s]; NaN likewise

    /// Numbers of a member's state.
    std::size_t states() const { return members.empty() ? 0 : final_states.size() / members.size(); }
    /// Numbers of a member's row of all quantities.
    std::size_t columns() const { return members.empty() ? 0 : quantities.size() / members.size(); }
};

/// Time and state of a section.
constexpr std::size_t section_columns(std::size_t states) { return 1 + states; }

/// Takes blocks in any order, one call at a time.  What it throws ends the run.
using BlockSink = std::function<void(BlockResult const&)>;

/// Fills in the inputs of a member, complete, and says whether they can be used.  Called from several threads.
using MemberSource = std::function<bool(std::uint64_t member, Inputs& inputs)>;

/// What a member may cost, in any unit: members of a block start with the dearest, so that it is not the last to end.
using MemberCost = std::function<double(Inputs const& inputs)>;

/// When a member ends and stops, from its complete inputs.
using MemberTiming = std::function<MemberClock(Inputs const& inputs)>;

/// Unit vectors [shadows][states] in which a member's shadows start.
using ShadowDirections = std::function<void(std::uint64_t member, double* directions)>;

/// What every block of a run has in common.
struct BlockRequest {
    IntegratorSettings integrator;
    std::vector<double> sample_times;  // empty: no time series; by turns angles
    Selection quantities = 0;
    Selection series = 0;
    MemberCost cost;      // empty: members start in their order
    MemberTiming timing;  // empty: all end at integrator.end_time and nobody stops
    StopPlan stops;
    bool sections = false;  // the states at the stops' sections are kept
    CrossingPlan crossings;
    ShadowPlan shadows;  // its directions are those of
    ShadowDirections directions;
    bool by_turns = false;  // BlockBase::by_turns
    std::size_t states = state_size;  // numbers of a member's state
    std::size_t columns = quantity_columns;  // of a member's row of all quantities
};

/// Bytes that a block of `members` needs.
std::uint64_t block_bytes(BlockRequest const& request, std::size_t members);

/// Useful over executed lane steps; 1 if there were none.
inline double lane_utilisation(std::uint64_t useful, std::uint64_t executed) {
    return executed == 0 ? 1 : static_cast<double>(useful) / static_cast<double>(executed);
}

class BlockBuffers {
public:
    /// Draws the members of these numbers and integrates those with usable inputs.  The others get status `invalid_inputs` and NaN results;
    /// those that `stop` cut short get `not_run` and NaN.
    /// @throws what the kernel throws; there are no results then
    void run(BlockKernel const& kernel, BlockRequest const& request, MemberSource const& source,
             StopRequest const& stop, std::span<std::uint64_t const> numbers);

    /// Views of the last run.
    BlockResult result() const;

    std::uint64_t lane_steps_executed() const { return lane_steps_executed_; }
    std::uint64_t lane_steps_useful() const { return lane_steps_useful_; }
    double lane_utilisation() const { return slideway::lane_utilisation(lane_steps_useful_, lane_steps_executed_); }

private:
    void draw(BlockRequest const& request, MemberSource const& source);
    void sort_by_cost(MemberCost const& cost);

    std::vector<std::uint64_t> members_;
    std::vector<Inputs> drawn_, usable_;
    std::vector<char> is_usable_;
    std::vector<std::uint32_t> order_;
    std::vector<MemberRecord> records_;
    std::vector<double> final_states_, quantities_, series_, sections_, growths_, sample_clock_;
    std::vector<MemberClock> clocks_;
    std::vector<double> directions_;
    std::uint64_t lane_steps_executed_ = 0, lane_steps_useful_ = 0;
};

}  // namespace slideway
