#include "host/store/shard_image.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "host/base/bytes.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"

namespace slideway {

namespace {

/// Writes those members of a block that have ended.
MemberSet write_block(DataFile& file, ResultLayout layout, BlockResult const& block) {
    std::vector<std::size_t> places;
    std::vector<std::vector<double>> study;
    layout.members = {};
    for (std::size_t i = 0; i < block.members.size(); ++i) {
        if (block.records[i].status == Status::not_run) continue;
        places.push_back(i);
        study.push_back(layout.study_row ? layout.study_row(block, i) : std::vector<double>());
        layout.members.add({block.members[i], 1});
        if (layout.sections > 0) layout.section_rows += sections_of(block, i).size() / section_columns(block.states());
    }
    if (places.empty()) return {};
    ResultColumns const list = result_columns(layout);
    std::vector<int> const variables = define(file, list, layout.members);
    for (std::size_t i = 0; i < variables.size(); ++i) {
        ResultColumn const& column = list.columns[i];
        ResultColumn::Numbers numbers;
        for (std::size_t k = 0; k < places.size() && column.source; ++k) column.source({block, places[k], study[k]}, numbers);
        put_numbers(file, variables[i], list, column, numbers);
    }
    return layout.members;
}

}  // namespace

MergedShard memory_shard(std::string const& name, ResultLayout const& layout, BlockResult const& block) {
    MemoryFile shard(name);
    MemberSet members = write_block(shard, layout, block);
    return {std::move(members), [shard] { return std::make_unique<MemoryFile>(shard); }};
}

ShardImage shard_image(std::string const& name, ResultLayout const& layout, Provenance const& provenance, BlockResult const& block) {
    NetcdfFile file = NetcdfFile::create_in_memory(name);
    put_attributes(file, DataFile::global, attributes_of(provenance));
    ShardImage image{write_block(file, layout, block), {}};
    if (image.members.empty()) return image;
    file.put(DataFile::global, "completeness", "shard");
    seal(file);
    image.bytes = file.close_to_bytes();
    return image;
}

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

}  // namespace slideway
