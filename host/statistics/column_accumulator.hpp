// What is kept of a column of numbers that nobody keeps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "host/statistics/exact_sum.hpp"
#include "host/statistics/summary.hpp"

namespace slideway {

// Quantiles of more numbers than one wants to keep.

/// Counts of numbers in bins of bounded relative width, for quantiles of bounded relative error; merging adds integers,
/// so a sketch depends on neither the order of its numbers nor their division into parts.
/// Source: Masson, Rim and Lee (2019), DDSketch: a fast and fully-mergeable quantile sketch with relative-error
/// guarantees, PVLDB 12.  We deviate in the bins: each octave is cut into 512 equal ones, so that a bin is the first
/// bits of the double and no logarithm is needed, at 1.4 times the bins of geometric ones.
///
/// Bin [l, u) answers with 2 l u/(l + u), whose relative distance from l and u is (u - l)/(u + l) <= 2^-9/(2 + 2^-9) <
/// `error`.  Numbers below the least normal double (2.2e-308) count as 0; infinities are numbers; NaN are counted
/// apart.
class QuantileSketch {
public:
    static constexpr double error = 0x1p-10;  // α = 0.00098

    void add(double x);
    void merge(QuantileSketch const& other);

    std::uint64_t count() const { return count_; }      // without NaN
    std::uint64_t missing() const { return missing_; }  // NaN

    /// The number of this rank in ascending order, from 0 and below `count`, within `error` of it relative; exact for zeros and
    /// infinities.  @return NaN without numbers.
    double at_rank(std::uint64_t rank) const;

    /// Numbers that the sketch does not tell apart: how many, and what it answers for them.
    struct Bucket {
        double value;
        std::uint64_t count;
    };
    /// Those that hold a number, ascending.
    std::vector<Bucket> buckets() const;

    /// Little-endian; the same for the same counts, however they came together.
    std::vector<std::byte> bytes() const;
    /// Nothing if the bytes are not those of a sketch.
    static std::optional<QuantileSketch> from_bytes(std::span<std::byte const> bytes);

    friend bool operator==(QuantileSketch const& a, QuantileSketch const& b) { return a.bytes() == b.bytes(); }

private:
    /// Counts of magnitudes by bin; only the range of bins that occur is kept.
    struct Store {
        std::uint32_t first = 0;
        std::vector<std::uint64_t> counts;
        void add(std::uint32_t bin, std::uint64_t count);
    };

    Store negative_, positive_;
    std::uint64_t zeros_ = 0, count_ = 0, missing_ = 0;
};

/// Counts, ends, sums of x and x² without rounding and a sketch of the quantiles.  All of it is the same to the last
/// bit in whichever order the numbers come and however they are divided into parts.
///
/// x² enters as the two doubles x·x and fma(x, x, -x·x).  They are exact for 2^-484 <= |x| < 2^512; below, each is off
/// by at most 2^-1075, and above the squares are infinite and so is the standard deviation.
class ColumnAccumulator {
public:
    void add(double x);
    void merge(ColumnAccumulator const& other);

    std::uint64_t count() const { return sketch_.count(); }      // without NaN
    std::uint64_t missing() const { return sketch_.missing(); }  // NaN
    double min() const;                                          // NaN without numbers
    double max() const;

    /// Of Σx correctly rounded, over the count; an infinity where the sum is beyond the doubles.
    double mean() const { return sum_.value() / static_cast<double>(count()); }
    /// √((n Σx² - (Σx)²)/(n (n-1))), the difference without rounding: accurate also where sd << |mean|.
    /// @return NaN for less than two numbers and for infinite ones.
    double sd() const;

    /// The k-th smallest number, k from 0 and below `count`: within `QuantileSketch::error` of it, relative, and
    /// between min and max.
    double at_rank(std::uint64_t rank) const;
    /// As `quantile` of the sorted numbers (type 7), between two of `at_rank`.  @param p in [0, 1].
    double quantile(double p) const;
    /// As `quantile_interval` of the sorted numbers, its bounds of `at_rank`.  @param p, level in (0, 1).
    Interval quantile_interval(double p, double level = 0.95) const;
    /// As `histogram` of the sorted numbers; the quartiles of its rule are sketched, and the numbers of one bucket of
    /// the sketch count where its answer for them lies: near an edge they may count beside it, by 2^-10 of their
    /// magnitude.
    Histogram histogram() const;
    Summary summary() const { return {count(), missing(), mean(), sd(), min(), quantile(0.5), max()}; }

    /// Little-endian; the same for the same numbers, however they came together.
    std::vector<std::byte> bytes() const;
    /// Nothing if the bytes are not those of an accumulator.
    static std::optional<ColumnAccumulator> from_bytes(std::span<std::byte const> bytes);

private:
    std::uint64_t finite() const { return count() - negative_infinities_ - positive_infinities_; }
    double finite_quantile(double p) const;

    // Of the finite numbers; +0 for zeros of whatever sign.
    double least_ = std::numeric_limits<double>::infinity(), largest_ = -std::numeric_limits<double>::infinity();
    std::uint64_t negative_infinities_ = 0, positive_infinities_ = 0;
    ExactSum sum_, squares_;
    QuantileSketch sketch_;
};

}  // namespace slideway
