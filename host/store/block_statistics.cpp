#include "host/store/block_statistics.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

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

}  // namespace slideway
