// Quantiles of more numbers than one wants to keep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace slideway {

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

}  // namespace slideway
