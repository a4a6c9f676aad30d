// Bytes of a shard of statistics, or of the variable `accumulators` of a result.
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "host/store/block_statistics.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

std::vector<std::byte> read(std::span<std::byte const> bytes) {
    Maker maker;
    BlockStatistics const statistics = parse_statistics(bytes, "statistics.bin", &maker);
    for (ColumnAccumulator const& column : statistics.columns()) {
        Summary const summary = column.summary();
        Histogram const histogram = column.histogram();
        std::uint64_t inside = histogram.below + histogram.above;
        for (std::uint64_t const count : histogram.counts) inside += count;
        require(inside == column.count(), "all numbers are in the histogram");
        if (column.count() > 0) require(summary.min <= summary.max, "the ends are in order");
        for (double const p : {0.01, 0.5, 0.99}) {
            column.quantile(p);
            column.quantile_interval(p);
        }
    }
    // Members of its own cannot join it.
    bool const joined = accepted([&] {
        BlockStatistics other = statistics;
        other.merge(statistics);
    });
    require(joined == statistics.members().empty(), "a member joins once");
    return statistics_shard(maker, statistics);
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::vector<std::byte> bytes;
    if (!fuzz::accepted([&] { bytes = fuzz::read(std::as_bytes(std::span(data, size))); })) return 0;
    fuzz::require(fuzz::read(bytes) == bytes, "statistics are written as they were read");
    return 0;
}
