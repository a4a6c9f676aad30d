#include "host/store/block_statistics.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/bytes.hpp"

namespace slideway {
namespace {

constexpr std::uint64_t magic = 0x31746174736b6c73;  // "slkstat1": the last letter is the version

bool is_before(FailedMember const& a, FailedMember const& b) { return a.member < b.member; }

}  // namespace

BlockStatistics::BlockStatistics(StatisticsPlan const& plan)
    : counts_(first_met + plan.limits.size() + 1), columns_(columns_of(plan.mechanism, plan.quantities).size()) {}

void BlockStatistics::add(BlockResult const& block, StatisticsPlan const& plan) {
    std::vector<QuantityColumn> const columns = columns_of(plan.mechanism, plan.quantities);
    std::vector<std::size_t> limited;
    for (Limit const& limit : plan.limits) {
        QuantityColumn const* const column = column_of(columns, limit);
        if (column == nullptr) throw std::invalid_argument("no quantity of the statistics: " + limit.name());
        limited.push_back(column->place);
    }
    for (std::size_t i = 0; i < block.records.size(); ++i) {
        MemberRecord const& record = block.records[i];
        if (record.status == Status::not_run) continue;
        members_.add({block.members[i], 1});
        ++counts_[static_cast<std::size_t>(record.status)];
        for (std::size_t k = 0; k < work_table.size(); ++k) counts_[status_count + k] += record.*work_table[k].of;
        if (record.status != Status::finished) {
            failed_.push_back({block.members[i], record.status, record.time});
            continue;
        }
        auto const row = block.quantities.subspan(i * block.columns(), block.columns());
        for (std::size_t k = 0; k < columns.size(); ++k) columns_[k].add(row[columns[k].place]);
        bool all = !limited.empty();
        for (std::size_t k = 0; k < limited.size(); ++k) {
            double const value = row[limited[k]];
            bool const within = plan.limits[k].low <= value && value <= plan.limits[k].high;  // not of NaN
            counts_[first_met + k] += within;
            all = all && within;
        }
        counts_.back() += all;
    }
    std::ranges::sort(failed_, is_before);
    if (failed_.size() > most_failed) failed_.resize(most_failed);
}

void BlockStatistics::merge(BlockStatistics const& other) {
    if (other.columns_.size() != columns_.size() || other.counts_.size() != counts_.size()) {
        throw FileError(fmt::format("cannot merge statistics of {} columns and {} limits with those of {} and {}",
                                    columns_.size(), met().size(), other.columns_.size(), other.met().size()));
    }
    if (MemberSet const both = members_.common(other.members_); !both.empty()) {
        throw FileError(fmt::format("cannot merge statistics: both hold the members {}", both.text()));
    }
    members_.add(other.members_);
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
    for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].merge(other.columns_[i]);
    std::vector<FailedMember> failed;
    std::ranges::merge(failed_, other.failed_, std::back_inserter(failed), is_before);
    if (failed.size() > most_failed) failed.resize(most_failed);
    failed_ = std::move(failed);
}

std::vector<std::byte> BlockStatistics::bytes() const {
    ByteWriter out;
    out.put(magic);
    out.put(std::uint64_t{members_.ranges().size()});
    for (MemberRange const& range : members_.ranges()) {
        out.put(range.first);
        out.put(range.count);
    }
    out.append(std::as_bytes(std::span(counts_).first(first_met)));
    out.put(std::uint64_t{met().size()});
    out.append(std::as_bytes(std::span(counts_).subspan(first_met)));
    out.put(std::uint64_t{failed_.size()});
    for (FailedMember const& member : failed_) {
        out.put(member.member);
        out.put(static_cast<std::uint64_t>(member.status));
        out.put(member.time);
    }
    out.put(std::uint64_t{columns_.size()});
    for (ColumnAccumulator const& column : columns_) out.put(column.bytes());
    return out.take();
}

BlockStatistics BlockStatistics::parse(std::span<std::byte const> bytes, std::string const& name) {
    ByteReader in(bytes, name);
    constexpr std::size_t word = sizeof(std::uint64_t);
    BlockStatistics read;
    if (in.word() != magic) in.fail("they are of another version");
    for (std::size_t n = in.count(2 * word), i = 0; i < n; ++i) {
        std::uint64_t const first = in.word(), count = in.word();
        if (count == 0 || first + count < first) in.fail("a range of members is none");
        read.members_.add({first, count});
    }
    for (std::size_t i = 0; i < first_met; ++i) read.counts_.push_back(in.word());
    auto const ends = std::span(read.counts_).first(status_count);
    if (std::accumulate(ends.begin(), ends.end(), std::uint64_t{0}) != read.members_.count()) in.fail("its statuses do not add up");
    read.counts_.resize(first_met + in.count(word) + 1);
    for (std::size_t i = first_met; i < read.counts_.size(); ++i) read.counts_[i] = in.word();
    read.failed_.resize(in.count(3 * word));
    for (FailedMember& member : read.failed_) {
        member.member = in.word();
        std::uint64_t const status = in.word();
        if (status >= status_count) in.fail("a status is none");
        member.status = static_cast<Status>(status);
        member.time = in.real();
    }
    for (std::size_t n = in.count(word), i = 0; i < n; ++i) {
        auto column = ColumnAccumulator::from_bytes(in.block());
        if (!column) in.fail("a column is none");
        if (column->count() + column->missing() != read.ended(Status::finished)) in.fail("a column does not add up");
        read.columns_.push_back(std::move(*column));
    }
    in.end();
    return read;
}

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
