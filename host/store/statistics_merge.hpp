// Statistics of blocks as shards, and these to one result file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host/store/block_statistics.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

/// Statistics and who made them, and back.  @param name of what the bytes are from, for messages.  @throws FileError
std::vector<std::byte> statistics_shard(Maker const& maker, BlockStatistics const& statistics);
BlockStatistics parse_statistics(std::span<std::byte const> bytes, std::string const& name, Maker* maker = nullptr);

/// The statistics of those members of a block that have ended.
ShardImage statistics_image(StatisticsPlan const& plan, Maker const& maker, BlockResult const& block);

/// One shard for several, of the origin of the first.  One of them at a time is in memory.  @throws FileError
std::vector<std::byte> joined_statistics(std::string const& folder, std::span<Shard const> shards);

/// Writes a result file without members, as `merge_shards` one with.  Its attribute `store` is "statistics", and
/// `members` the numbers of those of the run, `quantities` the names of what the statistics are of.
/// `status_count(status)` says how many ended as `status_value`, with `not_run` last if there are any; `failed_member`,
/// `failed_status` and `failed_time` name the first failures, scalars sum the work of all members, and `accumulators`
/// holds the bytes of BlockStatistics.  Whatever the order and the division of the shards, the file has the same
/// numbers.  @throws FileError
void merge_statistics(ShardFolder const& folder, std::vector<Shard> const& shards, StatisticsPlan const& plan, ResultMerge const& merge,
                      std::string const& path);

/// The same of statistics that are there, into an empty file.
void write_merged(DataFile& file, BlockStatistics const& statistics, ResultMerge const& merge);

/// The statistics in such a file.  @throws FileError if it holds none.
BlockStatistics stored_statistics(ResultView const& results);
/// Members of the run that such a file is without.  @throws FileError if it does not say.
std::uint64_t members_left(ResultView const& results);

}  // namespace slideway
