#include "host/statistics/column_accumulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/base/bytes.hpp"
#include "host/base/numbers.hpp"

namespace slideway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

double ColumnAccumulator::quantile(double p) const {
    return quantile_of(count(), p, [this](std::uint64_t rank) { return at_rank(rank); });
}

double ColumnAccumulator::finite_quantile(double p) const {
    return quantile_of(finite(), p, [this](std::uint64_t rank) { return at_rank(negative_infinities_ + rank); });
}

Interval ColumnAccumulator::quantile_interval(double p, double level) const {
    return interval_of_ranks(count(), p, level, [this](std::uint64_t rank) { return at_rank(rank); });
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
    ByteWriter out;
    for (double const end : {least_, largest_}) out.put(end);
    for (std::uint64_t const number : {negative_infinities_, positive_infinities_}) out.put(number);
    for (ExactSum const* const sum : {&sum_, &squares_}) out.append(sum->bytes());
    out.append(sketch_.bytes());
    return out.take();
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
    // What is said twice is said the same: the sketch has the infinities too, and the ends are of finite numbers, where there are any.
    auto const buckets = sketch->buckets();
    auto const sketched = [&](double number) {
        auto const found = std::ranges::find(buckets, number, &QuantileSketch::Bucket::value);
        return found == buckets.end() ? 0 : found->count;
    };
    if (column.negative_infinities_ != sketched(-infinity) || column.positive_infinities_ != sketched(infinity)) return std::nullopt;
    bool const has_ends = std::isfinite(column.least_) && std::isfinite(column.largest_) && column.least_ <= column.largest_;
    bool const has_none = column.least_ == infinity && column.largest_ == -infinity;
    if (!(column.finite() > 0 ? has_ends : has_none)) return std::nullopt;
    return column;
}

}  // namespace slideway
