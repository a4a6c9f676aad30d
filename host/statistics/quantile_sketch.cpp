#include "host/statistics/quantile_sketch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "host/base/bytes.hpp"
#include "host/base/numbers.hpp"

namespace slideway {

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
