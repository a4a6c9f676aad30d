// What the driver hands to a sink: the results of one block of members, as views of memory that the driver owns.
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
    std::span<double const> final_states;    // [members][state_size]; NaN for a member that was not integrated
    std::span<double const> quantities;      // [members][quantity_columns]; NaN where not selected or not integrated
    std::span<double const> series;          // [selected series, in table order][members][samples]
    std::span<double const> sections;        // [members][sections][section_columns]; NaN where not reached
    std::span<double const> growths;         // [members][growths][shadows], ln; NaN where not reached
};

/// Time and state of a section.
inline constexpr std::size_t section_columns = 1 + state_size;

/// Takes blocks in any order, one call at a time.  What it throws ends the run.
using BlockSink = std::function<void(BlockResult const&)>;

}  // namespace slideway
