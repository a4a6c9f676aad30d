// Shards of statistics: what takes the place of result files where members are not stored.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/store/block_statistics.hpp"
#include "host/store/provenance.hpp"
#include "host/store/shard_folder.hpp"
#include "host/store/shard_image.hpp"

namespace slideway {

/// Statistics and who made them.
struct StatisticsShard {
    Provenance origin;  // backend, isa, flags and threads
    BlockStatistics statistics;
};

std::vector<std::byte> to_bytes(StatisticsShard const& shard);
/// @param name of what the bytes are from, for messages.  @throws FileError
StatisticsShard parse_statistics(std::span<std::byte const> bytes, std::string const& name);

/// The statistics of those members of a block that have ended.
ShardImage statistics_image(StatisticsPlan const& plan, Provenance const& origin, BlockResult const& block);

/// One shard for several, of the origin of the first.  One of them at a time is in memory.  @throws FileError
std::vector<std::byte> joined_statistics(std::string const& folder, std::span<Shard const> shards);

}  // namespace slideway
