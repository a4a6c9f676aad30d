// What a run will take, told before it starts, also by running a few of its members.
#pragma once

#include <cstdint>
#include <optional>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/member_set.hpp"

namespace slideway {

/// Memory, output size and the number of fixed steps follow from the scene.  Other steps and hours are a rough range:
/// ringing contact holds explicit steps to a fraction of 1/Ω, free flight lets them grow to max_step, and nobody knows
/// before the run how long the slider flies.
struct Prediction {
    std::uint64_t buffer_bytes;   // of all threads' blocks; the program itself needs some tens of MB more
    std::uint64_t image_bytes;    // of blocks on their way to the disk
    std::uint64_t summary_bytes;  // of the statistics over all members at the end
    std::uint64_t design_bytes;   // of the order of all members, while it is made: of a correlated Latin hypercube
    std::uint64_t card_bytes;     // that are to be free on a card: blocks and their threads' stacks; 0 without one
    std::uint64_t output_bytes;
    std::uint64_t shard_bytes;       // beside the output, until it is whole; a bound
    std::size_t largest_block;       // members
    int busy_threads;                // that find a block to work on
    double least_steps, most_steps;  // of all members; the same where steps are fixed
    double least_seconds, most_seconds;

    std::uint64_t memory() const { return buffer_bytes + image_bytes + summary_bytes + design_bytes; }
};

/// What a scene that keeps statistics needs on the disk: of the result, and at most of its shards.  A column's sketch
/// is taken to be of 4096 buckets, eight octaves of values, or of as many as there are members; wider scatter needs
/// more.  Shards become fewer as they become many (ShardStore): their bound grows with the logarithm of the members.
std::uint64_t statistics_bytes(Scene const& scene, std::uint64_t members);
std::uint64_t statistics_shard_bytes(Scene const& scene, std::uint64_t members);

/// On the disk: of the result, and at most of the shards that members become before it.  A shard of few members is
/// mostly header (header_bytes), and there is one for each block, of each column of a sweep that continues.
/// @param block_members 0: as many as suit the run; blocks are then as small as the dearest members make them.
std::uint64_t result_bytes(Scene const& scene, MemberSet const& members, Backend const& backend, int threads);
std::uint64_t shard_bytes(Scene const& scene, MemberSet const& members, Backend const& backend, int threads,
                          std::size_t block_members);

Prediction predict(Scene const& scene, Backend const& backend, int threads, std::size_t block_members = 0);

/// A study's cost as a few of its members tell it; members that take very long are given up, and taken to go on as they began.
struct Trial {
    std::uint64_t members = 0;  // that were tried
    double steps = 0;           // of all members of the study, rejected ones included
    double seconds = 0;         // wall time on the threads that it was asked for, with the check of its resolution
};

/// Takes some seconds at most.  @return nothing where members cannot be tried alone (a sweep that continues), or do not run on the processor
std::optional<Trial> try_members(Scene const& scene, Backend const& backend, int threads);

}  // namespace slideway
