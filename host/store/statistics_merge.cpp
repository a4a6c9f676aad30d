#include "host/store/statistics_merge.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/bytes.hpp"

namespace slideway {
namespace {

/// How members ended, with `not_run` last.
void add_statuses(ResultColumns& list, BlockStatistics const& statistics, std::uint64_t left) {
    ResultColumn values = status_column("status_value", "how a member ended", "status"), counts{"status_count", "1", "members that ended so", {"status"}};
    for (int status = 0; status < status_count; ++status) {
        values.values.push_back(status);
        counts.values.push_back(static_cast<double>(statistics.ended(static_cast<Status>(status))));
    }
    values.values.push_back(static_cast<double>(Status::not_run));
    counts.values.push_back(static_cast<double>(left));
    list.dimensions.push_back({"status", counts.values.size()});
    list.columns.insert(list.columns.end(), {std::move(values), std::move(counts)});
}

void add_failed(ResultColumns& list, BlockStatistics const& statistics) {
    if (statistics.failed().empty()) return;
    ResultColumn members{"failed_member", "1", "number of one of the first members that failed", {"failed"}, "", {}, DataFile::Type::int32};
    ResultColumn statuses = status_column("failed_status", "how it ended", "failed"), times{"failed_time", "s", "time at which it ended", {"failed"}};
    for (FailedMember const& failed : statistics.failed()) {
        members.values.push_back(static_cast<double>(failed.member));
        statuses.values.push_back(static_cast<double>(failed.status));
        times.values.push_back(failed.time);
    }
    list.dimensions.push_back({"failed", statistics.failed().size()});
    list.columns.insert(list.columns.end(), {std::move(members), std::move(statuses), std::move(times)});
}

ResultColumns statistics_columns(BlockStatistics const& statistics, ResultLayout const& layout) {
    ResultColumns list;
    std::vector<char const*> names, units;
    for (OutputQuantity const& quantity : selected(outputs_of(layout.mechanism).quantities, layout.quantities)) {
        names.push_back(quantity.name);
        units.push_back(quantity.unit);
        if (quantity.dimension != nullptr) list.add_labels_of(quantity.dimension);
    }
    if (!names.empty()) list.attributes.push_back({"quantities", fmt::format("{}", fmt::join(names, " "))});
    list.attributes.push_back({"store", "statistics"});
    list.attributes.push_back({"members", layout.members.text()});
    list.attributes.push_back({"quantity_units", fmt::format("{}", fmt::join(units, ", "))});
    add_statuses(list, statistics, layout.members.without(statistics.members()).count());
    add_failed(list, statistics);
    for (std::size_t i = 0; i < work_table.size(); ++i)
        list.columns.push_back({.name = work_table[i].name, .unit = "1", .meaning = fmt::format("{} of all members", work_table[i].meaning),
                                .values = {static_cast<double>(statistics.work()[i])}});
    return list;
}

}  // namespace

std::vector<std::byte> statistics_shard(Maker const& maker, BlockStatistics const& statistics) {
    ByteWriter out;
    for (std::string const* const text : {&maker.backend, &maker.isa, &maker.flags}) out.put(std::string_view(*text));
    out.put(static_cast<std::uint64_t>(maker.threads));
    out.put(statistics.bytes());
    return out.take();
}

BlockStatistics parse_statistics(std::span<std::byte const> bytes, std::string const& name, Maker* maker) {
    ByteReader in(bytes, name);
    Maker found;
    for (std::string* const text : {&found.backend, &found.isa, &found.flags}) *text = in.text();
    found.threads = static_cast<int>(in.word());
    auto const statistics = in.block();
    in.end();
    if (maker != nullptr) *maker = std::move(found);
    return BlockStatistics::parse(statistics, name);
}

ShardImage statistics_image(StatisticsPlan const& plan, Maker const& maker, BlockResult const& block) {
    BlockStatistics statistics(plan);
    statistics.add(block, plan);
    if (statistics.members().empty()) return {};
    return {statistics.members(), statistics_shard(maker, statistics)};
}

std::vector<std::byte> joined_statistics(std::string const& folder, std::span<Shard const> shards) {
    Maker maker;
    std::optional<BlockStatistics> joined;
    for (Shard const& shard : shards) {
        BlockStatistics next = parse_statistics(read_shard(folder, shard), shard.name, joined ? nullptr : &maker);
        if (joined)
            joined->merge(next);
        else
            joined = std::move(next);
    }
    return joined ? statistics_shard(maker, *joined) : std::vector<std::byte>();
}

void write_merged(DataFile& file, BlockStatistics const& statistics, ResultMerge const& merge) {
    put_attributes(file, DataFile::global, attributes_of(merge.provenance));
    define(file, statistics_columns(statistics, merge.layout));
    std::vector<std::byte> const bytes = statistics.bytes();
    file.add_dimension("byte", bytes.size());
    put(file, {"accumulators", "", "exact sums and quantile sketches from which the statistics follow, as bytes", {"byte"}}, bytes);
    if (merge.conclude) merge.conclude(file);
    merge.may_pause();
}

void merge_statistics(ShardFolder const& folder, std::vector<Shard> const& shards, StatisticsPlan const& plan, ResultMerge const& merge,
                      std::string const& path) {
    auto const write = [&](DataFile& file) {
        BlockStatistics statistics(plan);
        for (Shard const& shard : shards) {
            merge.may_pause();
            statistics.merge(parse_statistics(folder.read(shard), shard.name));
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
