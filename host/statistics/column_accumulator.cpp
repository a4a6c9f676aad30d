#include "host/statistics/column_accumulator.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

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

namespace {

constexpr int dropped_bits = 52 - 9;  // a bin keeps the exponent and nine bits of the fraction
constexpr std::uint32_t first_normal_bin = 1u << 9;
constexpr std::uint32_t infinity_bin = 0x7ffu << 9;
constexpr std::uint64_t magic = 0x31686374656b7371;  // "qsketch1"

std::uint32_t bin_of(double magnitude) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(magnitude) >> dropped_bits);
}

double value_of(std::uint32_t bin) {
    auto const edge = [](std::uint32_t b) { return std::bit_cast<double>(std::uint64_t{b} << dropped_bits); };
    if (bin == infinity_bin) return std::numeric_limits<double>::infinity();
    double const low = edge(bin), high = edge(bin + 1);
    if (std::isinf(high)) return low * (1 + 0x1p-11);  // the last bin: u is twice the largest power, no double
    return low * (high / (0.5 * low + 0.5 * high));    // halves: the sum may be no double
}

}  // namespace

void QuantileSketch::Store::add(std::uint32_t bin, std::uint64_t count) {
    if (counts.empty()) {
        first = bin;
        counts.push_back(0);
    } else if (bin < first) {
        counts.insert(counts.begin(), first - bin, 0);
        first = bin;
    } else if (bin - first >= counts.size()) {
        counts.resize(bin - first + 1, 0);
    }
    counts[bin - first] += count;
}

void QuantileSketch::add(double x) {
    if (std::isnan(x)) {
        ++missing_;
        return;
    }
    ++count_;
    std::uint32_t const bin = bin_of(std::abs(x));
    if (bin < first_normal_bin) {
        ++zeros_;
    } else {
        (x < 0 ? negative_ : positive_).add(bin, 1);
    }
}

void QuantileSketch::merge(QuantileSketch const& other) {
    auto const add_all = [](Store& to, Store const& from) {
        for (std::size_t i = 0; i < from.counts.size(); ++i) {
            if (from.counts[i] > 0) to.add(from.first + static_cast<std::uint32_t>(i), from.counts[i]);
        }
    };
    add_all(negative_, other.negative_);
    add_all(positive_, other.positive_);
    zeros_ += other.zeros_;
    count_ += other.count_;
    missing_ += other.missing_;
}

double QuantileSketch::at_rank(std::uint64_t rank) const {
    for (Bucket const& bucket : buckets()) {
        if (rank < bucket.count) return bucket.value;
        rank -= bucket.count;
    }
    return nan;  // of none
}

std::vector<QuantileSketch::Bucket> QuantileSketch::buckets() const {
    std::vector<Bucket> found;
    auto const add = [&](double value, std::uint64_t count) {
        if (count > 0) found.push_back({value, count});
    };
    for (std::size_t i = negative_.counts.size(); i-- > 0;)
        add(-value_of(negative_.first + static_cast<std::uint32_t>(i)), negative_.counts[i]);
    add(0, zeros_);
    for (std::size_t i = 0; i < positive_.counts.size(); ++i)
        add(value_of(positive_.first + static_cast<std::uint32_t>(i)), positive_.counts[i]);
    return found;
}

std::vector<std::byte> QuantileSketch::bytes() const {
    ByteWriter out;
    for (std::uint64_t const word : {magic, zeros_, missing_}) out.put(word);
    for (Store const* const store : {&negative_, &positive_}) {
        out.put(std::uint64_t(std::ranges::count_if(store->counts, [](std::uint64_t count) { return count > 0; })));
        for (std::size_t i = 0; i < store->counts.size(); ++i) {
            if (store->counts[i] == 0) continue;
            out.put(std::uint64_t{store->first + i});
            out.put(store->counts[i]);
        }
    }
    return out.take();
}

std::optional<QuantileSketch> QuantileSketch::from_bytes(std::span<std::byte const> bytes) {
    auto const take = [&](std::uint64_t& word) {
        if (bytes.size() < sizeof word) return false;
        std::memcpy(&word, bytes.data(), sizeof word);
        bytes = bytes.subspan(sizeof word);
        return true;
    };
    QuantileSketch sketch;
    std::uint64_t mark = 0;
    if (!take(mark) || mark != magic || !take(sketch.zeros_) || !take(sketch.missing_)) return std::nullopt;
    sketch.count_ = sketch.zeros_;
    for (Store* const store : {&sketch.negative_, &sketch.positive_}) {
        std::uint64_t used = 0, bin = 0, count = 0, last = 0;
        if (!take(used)) return std::nullopt;
        for (std::uint64_t i = 0; i < used; ++i) {
            if (!take(bin) || !take(count)) return std::nullopt;
            if (bin < first_normal_bin || bin > infinity_bin || bin <= last || count == 0) return std::nullopt;
            if (count > std::numeric_limits<std::uint64_t>::max() - sketch.count_) return std::nullopt;
            store->add(static_cast<std::uint32_t>(bin), count);
            sketch.count_ += count;
            last = bin;
        }
    }
    if (!bytes.empty()) return std::nullopt;
    return sketch;
}

}  // namespace slideway
