#include "host/store/statistics_shard.hpp"

#include <optional>

#include "host/base/byte_stream.hpp"

namespace slideway {

std::vector<std::byte> to_bytes(StatisticsShard const& shard) {
    ByteWriter out;
    for (std::string const* const text : {&shard.origin.backend, &shard.origin.isa, &shard.origin.flags}) {
        out.put(std::string_view(*text));
    }
    out.put(static_cast<std::uint64_t>(shard.origin.threads));
    out.put(shard.statistics.bytes());
    return out.take();
}

StatisticsShard parse_statistics(std::span<std::byte const> bytes, std::string const& name) {
    ByteReader in(bytes, name);
    Provenance origin;
    for (std::string* const text : {&origin.backend, &origin.isa, &origin.flags}) *text = in.text();
    origin.threads = static_cast<int>(in.word());
    auto const statistics = in.block();
    in.end();
    return {std::move(origin), BlockStatistics::parse(statistics, name)};
}

ShardImage statistics_image(StatisticsPlan const& plan, Provenance const& origin, BlockResult const& block) {
    StatisticsShard shard{origin, BlockStatistics(plan)};
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
