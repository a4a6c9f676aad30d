#include "host/store/statistics_merge.hpp"


#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/store/group_writer.hpp"
#include "host/store/result_definition.hpp"

namespace slideway {
namespace {

void write_statuses(DataFile& file, BlockStatistics const& statistics, std::uint64_t left) {
    std::vector<signed char> values;
    std::vector<double> counts;
    for (int status = 0; status < status_count; ++status) {
        values.push_back(static_cast<signed char>(status));
        counts.push_back(static_cast<double>(statistics.ended(static_cast<Status>(status))));
    }
    values.push_back(static_cast<signed char>(Status::not_run));
    counts.push_back(static_cast<double>(left));
    GroupWriter out(file);
    out.dimension("status", values.size());
    put_status_flags(file, out.put({"status_value", "", "how a member ended", {"status"}}, values));
    out.put({"status_count", "1", "members that ended so", {"status"}}, counts);
}

void write_failed(DataFile& file, BlockStatistics const& statistics) {
    if (statistics.failed().empty()) return;
    std::vector<int> members;
    std::vector<signed char> statuses;
    std::vector<double> times;
    for (FailedMember const& failed : statistics.failed()) {
        members.push_back(static_cast<int>(failed.member));
        statuses.push_back(static_cast<signed char>(failed.status));
        times.push_back(failed.time);
    }
    GroupWriter out(file);
    out.dimension("failed", members.size());
    out.put({"failed_member", "1", "number of one of the first members that failed", {"failed"}}, members);
    put_status_flags(file, out.put({"failed_status", "", "how it ended", {"failed"}}, statuses));
    out.put({"failed_time", "s", "time at which it ended", {"failed"}}, times);
}

}  // namespace

void write_merged(DataFile& file, BlockStatistics const& statistics, ResultMerge const& merge) {
    MemberSet const& members = merge.layout.members;
    put_provenance(file, merge.provenance);
    file.put(DataFile::global, "store", "statistics");
    file.put(DataFile::global, "members", members.text());
    LabelAxes axes(file);
    std::vector<char const*> units;
    for (OutputQuantity const& quantity : selected(outputs_of(merge.layout.mechanism).quantities, merge.layout.quantities)) {
        units.push_back(quantity.unit);
        if (quantity.dimension != nullptr) axes.axis(quantity.dimension);
    }
    put_quantity_names(file, merge.layout);
    file.put(DataFile::global, "quantity_units", fmt::format("{}", fmt::join(units, ", ")));
    axes.write();
    write_statuses(file, statistics, members.without(statistics.members()).count());
    write_failed(file, statistics);
    GroupWriter out(file);
    for (std::size_t i = 0; i < statistics.work().size(); ++i)
        out.put({work_table[i].name, "1", fmt::format("{} of all members", work_table[i].meaning)}, static_cast<double>(statistics.work()[i]));
    std::vector<std::byte> const bytes = statistics.bytes();
    out.dimension("byte", bytes.size());
    out.put({"accumulators", "", "exact sums and quantile sketches from which the statistics follow, as bytes", {"byte"}}, bytes);
    if (merge.conclude) merge.conclude(file);
    merge.may_pause();
}

void merge_statistics(ShardFolder const& folder, std::vector<Shard> const& shards, StatisticsPlan const& plan, ResultMerge const& merge,
                      std::string const& path) {
    auto const write = [&](DataFile& file) {
        BlockStatistics statistics(plan);
        for (Shard const& shard : shards) {
            merge.may_pause();
            statistics.merge(parse_statistics(folder.read(shard), shard.name).statistics);
        }
        merge.may_pause();
        write_merged(file, statistics, merge);
    };
    write_result(path, merge.completeness, write, merge.existing);
}

BlockStatistics stored_statistics(ResultView const& results) {
    std::vector<std::byte> bytes;
    for (double const value : results.values("accumulators")) bytes.push_back(static_cast<std::byte>(int8_of(value)));
    return BlockStatistics::parse(bytes, results.path());
}

std::uint64_t members_left(ResultView const& results) {
    std::vector<double> const counts = results.values("status_count");
    return counts.empty() ? 0 : count_of(counts.back());
}

}  // namespace slideway
