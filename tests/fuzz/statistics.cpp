// Bytes of a shard of statistics, or of the variable `accumulators` of a result.
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "host/store/shard_image.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

std::vector<std::byte> read(std::span<std::byte const> bytes) {
    StatisticsShard shard = parse_statistics(bytes, "statistics.bin");
    for (ColumnAccumulator const& column : shard.statistics.columns()) {
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
        StatisticsShard other = shard;
        other.statistics.merge(shard.statistics);
    });
    require(joined == shard.statistics.members().empty(), "a member joins once");
    return to_bytes(shard);
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
