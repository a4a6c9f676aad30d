#include "host/store/shard_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "host/base/bytes.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/result_definition.hpp"
#include "host/store/result_seal.hpp"

namespace slideway {

namespace {

/// The sections that a member of a block reached: [sections][1 + states].
std::span<double const> sections_of(BlockResult const& block, std::size_t row) {
    std::size_t const width = block.sections.size() / block.members.size();
    auto const room = block.sections.subspan(row * width, width);
    std::size_t reached = 0;
    while (reached < width && !std::isnan(room[reached])) reached += section_columns(block.states());
    return room.first(reached);
}

/// Rows of a block, picked out of its arrays and written as whole variables.
class BlockRows {
public:
    BlockRows(DataFile& file, ResultLayout const& layout, ResultVariables const& ids, BlockResult const& block,
              std::vector<std::size_t> const& rows)
        : file_(file), layout_(layout), ids_(ids), block_(block), rows_(rows) {}

    void write(StudyValues const& study) {
        write_records();
        write_states();
        write_quantities();
        write_series();
        for (std::size_t i = 0; i < ids_.study.size(); ++i) {
            std::size_t const width = layout_.study.width(layout_.study.columns[i]);
            write_rows(ids_.study[i], study[i], width, width);
        }
        if (layout_.sections > 0) write_sections();
    }

private:
    std::size_t members() const { return block_.members.size(); }

    template <class T, class ValueOf> void write_each(int variable, ValueOf value_of) {
        std::vector<T> column;
        for (std::size_t const row : rows_) column.push_back(static_cast<T>(value_of(row)));
        file_.write(variable, column.data());
    }

    /// @param values [members][stride] of the block, of which `width` are the variable's
    void write_rows(int variable, std::span<double const> values, std::size_t stride, std::size_t width) {
        std::vector<double> picked;
        picked.reserve(rows_.size() * width);
        for (std::size_t const row : rows_) {
            auto const of_member = values.subspan(row * stride, width);
            picked.insert(picked.end(), of_member.begin(), of_member.end());
        }
        file_.write(variable, picked.data());
    }

    void write_records() {
        auto const& records = block_.records;
        write_each<signed char>(ids_.status, [&](std::size_t i) { return records[i].status; });
        for (std::size_t k = 0; k < ids_.work.size(); ++k) {
            write_each<double>(ids_.work[k], [&](std::size_t i) { return records[i].*work_table[k].of; });
        }
        write_each<double>(ids_.end_time, [&](std::size_t i) { return records[i].time; });
    }

    void write_states() {
        for (std::size_t k = 0; k < ids_.final_states.size(); ++k)
            write_each<double>(ids_.final_states[k], [&](std::size_t i) { return block_.final_states[i * block_.states() + k]; });
        for (std::size_t k = 0; k < ids_.parameters.size(); ++k)
            write_each<double>(ids_.parameters[k], [&](std::size_t i) { return block_.inputs[i].*layout_.parameters[k].member; });
    }

    void write_quantities() {
        for (ResultVariables::Quantity const& quantity : ids_.quantities) {
            write_rows(quantity.id, block_.quantities.subspan(quantity.first_column), block_.columns(), quantity.columns);
        }
    }

    void write_series() {
        std::size_t const samples = layout_.sample_times.size(), values = block_.members.size() * samples;
        for (std::size_t k = 0; k < ids_.series.size(); ++k) write_rows(ids_.series[k], block_.series.subspan(k * values, values), samples, samples);
    }

    void write_sections() {
        std::size_t const width = section_columns(block_.states());
        std::vector<std::vector<double>> columns(width);
        for (std::size_t const row : rows_) {
            auto const sections = sections_of(block_, row);
            for (std::size_t i = 0; i < sections.size(); ++i) columns[i % width].push_back(sections[i]);
        }
        write_each<int>(ids_.section_count, [&](std::size_t i) { return sections_of(block_, i).size() / width; });
        if (ids_.section_crossings >= 0) {
            constexpr std::uint64_t largest = std::numeric_limits<int>::max();
            write_each<int>(ids_.section_crossings, [&](std::size_t i) { return std::min(block_.records[i].crossings, largest); });
        }
        if (columns[0].empty()) return;
        for (std::size_t j = 0; j < width; ++j) file_.write(ids_.section_columns[j], columns[j].data());
    }

    DataFile& file_;
    ResultLayout const& layout_;
    ResultVariables const& ids_;
    BlockResult const& block_;
    std::vector<std::size_t> const& rows_;
};

/// The rows of those members that have ended, into an empty file.  @return the members
MemberSet write_block(DataFile& file, ResultLayout layout, BlockResult const& block, StudyValues const& study) {
    std::vector<std::size_t> rows;
    MemberSet members;
    for (std::size_t i = 0; i < block.records.size(); ++i) {
        if (block.records[i].status == Status::not_run) continue;
        rows.push_back(i);
        members.add({block.members[i], 1});
    }
    if (rows.empty()) return members;
    layout.members = members;
    for (std::size_t i = 0; i < rows.size() && layout.sections > 0; ++i) {
        layout.section_rows += sections_of(block, rows[i]).size() / section_columns(block.states());
    }
    ResultVariables const ids = define_variables(file, layout);
    BlockRows(file, layout, ids, block, rows).write(study);
    return members;
}

}  // namespace

MergedShard memory_shard(std::string const& name, ResultLayout layout, BlockResult const& block, StudyValues const& study) {
    MemoryFile shard(name);
    MemberSet const members = write_block(shard, std::move(layout), block, study);
    return {members, [shard](MergedShard::Use const& use) { use(shard); }};
}

ShardImage shard_image(std::string const& name, ResultLayout layout, Provenance const& provenance,
                       BlockResult const& block, StudyValues const& study) {
    NetcdfFile file = NetcdfFile::create_in_memory(name);
    put_provenance(file, provenance);
    ShardImage image{write_block(file, std::move(layout), block, study), {}};
    if (image.members.empty()) return image;
    file.put(DataFile::global, "completeness", "shard");
    seal(file);
    image.bytes = file.close_to_bytes();
    return image;
}

std::vector<std::byte> to_bytes(StatisticsShard const& shard) {
    ByteWriter out;
    for (std::string const* const text : {&shard.maker.backend, &shard.maker.isa, &shard.maker.flags}) {
        out.put(std::string_view(*text));
    }
    out.put(static_cast<std::uint64_t>(shard.maker.threads));
    out.put(shard.statistics.bytes());
    return out.take();
}

StatisticsShard parse_statistics(std::span<std::byte const> bytes, std::string const& name) {
    ByteReader in(bytes, name);
    Maker maker;
    for (std::string* const text : {&maker.backend, &maker.isa, &maker.flags}) *text = in.text();
    maker.threads = static_cast<int>(in.word());
    auto const statistics = in.block();
    in.end();
    return {std::move(maker), BlockStatistics::parse(statistics, name)};
}

ShardImage statistics_image(StatisticsPlan const& plan, Maker const& maker, BlockResult const& block) {
    StatisticsShard shard{maker, BlockStatistics(plan)};
    shard.statistics.add(block, plan);
    if (shard.statistics.members().empty()) return {};
    return {shard.statistics.members(), to_bytes(shard)};
}

std::vector<std::byte> joined_statistics(std::string const& folder, std::span<Shard const> shards) {
    std::optional<StatisticsShard> joined;
    for (Shard const& shard : shards) {
        StatisticsShard next = parse_statistics(read_shard(folder, shard), shard.name);
        if (joined)
            joined->statistics.merge(next.statistics);
        else
            joined = std::move(next);
    }
    return joined ? to_bytes(*joined) : std::vector<std::byte>();
}

}  // namespace slideway
