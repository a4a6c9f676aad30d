// One block of members as the bytes of a result file, or of their statistics where members are not stored.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host/run/block_buffers.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/provenance.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {

/// An ordinary result file of the block's members that have ended; those that were cut short are not in it.
struct ShardImage {
    MemberSet members;
    std::vector<std::byte> bytes;  // empty if none have ended
};

/// @param layout of the run; its members do not count.  @param name of the file, for messages.  @throws FileError
ShardImage shard_image(std::string const& name, ResultLayout const& layout, Provenance const& provenance, BlockResult const& block);
/// The same in memory, without provenance.
MergedShard memory_shard(std::string const& name, ResultLayout const& layout, BlockResult const& block);

/// Statistics and who made them, and back.  @param name of what the bytes are from, for messages.  @throws FileError
std::vector<std::byte> statistics_shard(Maker const& maker, BlockStatistics const& statistics);
BlockStatistics parse_statistics(std::span<std::byte const> bytes, std::string const& name, Maker* maker = nullptr);

/// The statistics of those members of a block that have ended.
ShardImage statistics_image(StatisticsPlan const& plan, Maker const& maker, BlockResult const& block);

/// One shard for several, of the origin of the first.  One of them at a time is in memory.  @throws FileError
std::vector<std::byte> joined_statistics(std::string const& folder, std::span<Shard const> shards);

}  // namespace slideway
