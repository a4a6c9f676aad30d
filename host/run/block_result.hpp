// What a run hands to a sink: the results of one block of members, as views of memory that the run owns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "kernels/block.hpp"

namespace slideway {

struct BlockResult {
    std::span<std::uint64_t const> members;  // their numbers in the scene, ascending
    std::span<Inputs const> inputs;          // [members], as drawn, also those that cannot be used
    std::span<MemberRecord const> records;   // [members]
    std::span<double const> final_states;    // [members][states()]; NaN for a member that was not integrated
    std::span<double const> quantities;      // [members][quantity_columns]; NaN where not selected or not integrated
    std::span<double const> series;          // [selected series, in table order][members][samples]
    std::span<double const> sections;        // [members][sections][section_columns(states())]; NaN where not reached
    std::span<double const> growths;         // [members][growths][shadows], ln; NaN where not reached

    /// Numbers of a member's state.
    std::size_t states() const { return members.empty() ? 0 : final_states.size() / members.size(); }
};

/// Time and state of a section.
constexpr std::size_t section_columns(std::size_t states) { return 1 + states; }

/// Takes blocks in any order, one call at a time.  What it throws ends the run.
using BlockSink = std::function<void(BlockResult const&)>;

}  // namespace slideway
