// What members come to together, where none of them is stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/run/block_buffers.hpp"
#include "host/run/member_set.hpp"
#include "host/sampling/design.hpp"
#include "host/statistics/column_accumulator.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/result_view.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// Which numbers of a member count, and where.
struct StatisticsPlan {
    Selection quantities = 0;
    std::vector<Limit> limits;
    Mechanism mechanism{};  // whose quantities they are
};

/// A member that ran and did not finish.
struct FailedMember {
    std::uint64_t member;
    Status status;
    double time;  // [s] where it ended
};

/// Counts, exact sums, sketches and the first failures of a set of members.  All of it is the same to the last bit in
/// whichever order the members come and however they are divided into parts.
///
/// Whom the numbers are of is the policy of a tolerance report: the columns are of members that finished; a member that
/// failed meets no limit, and neither does NaN.
class BlockStatistics {
public:
    static constexpr std::size_t most_failed = 100;  // members that are kept by number, the lowest

    /// Of no members.
    explicit BlockStatistics(StatisticsPlan const& plan);

    /// The members of a block that have ended; none of them may be in here already.
    /// @throws std::invalid_argument if a limit is of a quantity that is not selected.
    void add(BlockResult const& block, StatisticsPlan const& plan);
    /// @throws FileError if the other's columns or limits are not as many, or members are in both.
    void merge(BlockStatistics const& other);

    MemberSet const& members() const { return members_; }
    std::uint64_t ended(Status status) const { return counts_[static_cast<std::size_t>(status)]; }
    /// Of `columns_of` the quantities.
    std::span<ColumnAccumulator const> columns() const { return columns_; }
    /// Members that meet each limit; all of them.
    std::span<std::uint64_t const> met() const { return std::span(counts_).subspan(first_met, counts_.size() - first_met - 1); }
    std::uint64_t all_met() const { return counts_.back(); }
    std::span<FailedMember const> failed() const { return failed_; }

    /// Of all members, in the order of work_table.
    std::span<std::uint64_t const> work() const { return std::span(counts_).subspan(status_count, work_table.size()); }

    /// A magic word with a version, then little-endian numbers; the same for the same members, however they came
    /// together.
    std::vector<std::byte> bytes() const;
    /// @param name of what they are from, for messages.  @throws FileError if they are not those of statistics.
    static BlockStatistics parse(std::span<std::byte const> bytes, std::string const& name);

private:
    BlockStatistics() = default;

    MemberSet members_;
    static constexpr std::size_t first_met = status_count + work_table.size();
    std::vector<std::uint64_t> counts_;  // of ends by status, of work, of members that meet each limit, of those that meet all
    std::vector<ColumnAccumulator> columns_;
    std::vector<FailedMember> failed_;  // ascending
};

// Statistics of blocks as shards, and these to one result file.

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
