#include "host/statistics/column_accumulator.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace slideway {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

static_assert(std::endian::native == std::endian::little, "bytes() is defined as little-endian");

}  // namespace

void ColumnAccumulator::add(double x) {
    sketch_.add(x);
    if (std::isnan(x)) return;
    sum_.add(x);
    if (std::isinf(x)) {
        ++(x < 0 ? negative_infinities_ : positive_infinities_);
        squares_.add(infinity);
        return;
    }
    double const unsigned_zero = x + 0.0;  // -0 is +0: which of them came first must not show
    least_ = std::min(least_, unsigned_zero);
    largest_ = std::max(largest_, unsigned_zero);
    double const square = x * x;
    squares_.add(square);
    if (std::isfinite(square)) squares_.add(std::fma(x, x, -square));
}

void ColumnAccumulator::merge(ColumnAccumulator const& other) {
    least_ = std::min(least_, other.least_);
    largest_ = std::max(largest_, other.largest_);
    negative_infinities_ += other.negative_infinities_;
    positive_infinities_ += other.positive_infinities_;
    sum_.add(other.sum_);
    squares_.add(other.squares_);
    sketch_.merge(other.sketch_);
}

double ColumnAccumulator::min() const {
    if (count() == 0) return nan;
    return negative_infinities_ > 0 ? -infinity : least_;  // +infinity if there is no finite number
}

double ColumnAccumulator::max() const {
    if (count() == 0) return nan;
    return positive_infinities_ > 0 ? infinity : largest_;
}

double ColumnAccumulator::mean() const { return sum_.value() / static_cast<double>(count()); }

double ColumnAccumulator::sd() const {
    if (count() < 2 || !std::isfinite(sum_.value())) return nan;
    if (!squares_.is_finite()) return infinity;
    ExactSum::Scaled spread = ExactSum::spread(count(), sum_, squares_);
    if (!(spread.mantissa > 0)) return 0;  // below 0: squares that were rounded
    if (spread.exponent % 2 != 0) {
        spread.mantissa *= 2;
        --spread.exponent;
    }
    auto const n = static_cast<double>(count());
    return std::ldexp(std::sqrt(spread.mantissa / n / (n - 1)), spread.exponent / 2);
}

double ColumnAccumulator::at_rank(std::uint64_t rank) const {
    // The ends are known.
    if (rank == 0) return min();
    if (rank + 1 >= count()) return max();
    return std::clamp(sketch_.at_rank(rank), min(), max());
}

namespace {

/// Type 7 between the ranks from `first` on, n of them.  @param value_at of a rank
template <class ValueAt> double type7(std::uint64_t first, std::uint64_t n, double p, ValueAt value_at) {
    if (n == 0) return nan;
    double const h = static_cast<double>(n - 1) * p;
    auto const below = std::min(static_cast<std::uint64_t>(h), n - 1);
    double const fraction = h - static_cast<double>(below);
    double const low = value_at(first + below);
    // Without a fraction the neighbour does not count: it may be infinite, or beyond the end.
    if (!(fraction > 0) || below + 1 == n) return low;
    return low + fraction * (value_at(first + below + 1) - low);
}

}  // namespace

double ColumnAccumulator::quantile(double p) const {
    return type7(0, count(), p, [this](std::uint64_t rank) { return at_rank(rank); });
}

double ColumnAccumulator::finite_quantile(double p) const {
    return type7(negative_infinities_, finite(), p, [this](std::uint64_t rank) { return at_rank(rank); });
}

Interval ColumnAccumulator::quantile_interval(double p, double level) const {
    Interval interval;
    if (count() == 0) return interval;
    auto const [low, high] = quantile_ranks(count(), p, level);
    if (low >= 1) interval.low = at_rank(low - 1);
    if (high <= count()) interval.high = at_rank(high - 1);
    return interval;
}

Histogram ColumnAccumulator::histogram() const {
    Histogram result;
    result.below = negative_infinities_;
    result.above = positive_infinities_;
    if (finite() == 0) return result;
    result.edges = histogram_edges({least_, largest_, {finite_quantile(0.25), finite_quantile(0.75)}, finite()});
    result.counts.assign(result.edges.size() - 1, 0);
    // The last bin has its upper edge.
    auto const first = result.edges.begin() + 1, last = result.edges.end() - 1;
    for (auto const& [value, members] : sketch_.buckets()) {
        if (std::isinf(value)) continue;
        double const within = std::clamp(value, least_, largest_);
        result.counts[static_cast<std::size_t>(std::upper_bound(first, last, within) - first)] += members;
    }
    return result;
}

Summary ColumnAccumulator::summary() const { return {count(), missing(), mean(), sd(), min(), quantile(0.5), max()}; }

std::vector<std::byte> ColumnAccumulator::bytes() const {
    std::vector<std::byte> bytes;
    auto const put = [&](void const* from, std::size_t length) {
        bytes.resize(bytes.size() + length);
        std::memcpy(bytes.data() + bytes.size() - length, from, length);
    };
    for (double const end : {least_, largest_}) put(&end, sizeof end);
    for (std::uint64_t const number : {negative_infinities_, positive_infinities_}) put(&number, sizeof number);
    for (ExactSum const* const sum : {&sum_, &squares_}) put(sum->bytes().data(), ExactSum::byte_count);
    auto const sketch = sketch_.bytes();
    put(sketch.data(), sketch.size());
    return bytes;
}

std::optional<ColumnAccumulator> ColumnAccumulator::from_bytes(std::span<std::byte const> bytes) {
    constexpr std::size_t ends = 2 * sizeof(double), counts = 2 * sizeof(std::uint64_t);
    constexpr std::size_t head = ends + counts + 2 * ExactSum::byte_count;
    if (bytes.size() < head) return std::nullopt;
    ColumnAccumulator column;
    std::memcpy(&column.least_, bytes.data(), sizeof column.least_);
    std::memcpy(&column.largest_, bytes.data() + sizeof(double), sizeof column.largest_);
    std::memcpy(&column.negative_infinities_, bytes.data() + ends, sizeof(std::uint64_t));
    std::memcpy(&column.positive_infinities_, bytes.data() + ends + sizeof(std::uint64_t), sizeof(std::uint64_t));
    auto const sum = ExactSum::from_bytes(bytes.subspan(ends + counts, ExactSum::byte_count));
    auto const squares =
        ExactSum::from_bytes(bytes.subspan(ends + counts + ExactSum::byte_count, ExactSum::byte_count));
    auto const sketch = QuantileSketch::from_bytes(bytes.subspan(head));
    if (!sum || !squares || !sketch) return std::nullopt;
    column.sum_ = *sum;
    column.squares_ = *squares;
    column.sketch_ = *sketch;
    std::uint64_t const infinite = column.negative_infinities_ + column.positive_infinities_;
    if (infinite > sketch->count() || std::isnan(column.least_) || std::isnan(column.largest_)) return std::nullopt;
    if ((column.finite() > 0) != (column.least_ <= column.largest_)) return std::nullopt;
    return column;
}

}  // namespace slideway
