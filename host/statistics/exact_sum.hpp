// A sum of doubles without rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace slideway {

/// Sum of up to 2^64 doubles as a fixed-point number over the whole range of doubles; it does not depend on the order
/// in which they come, nor on how they are divided into partial sums.  Plain bytes: may be copied between processes.
/// Source: Kulisch (2013), Computer Arithmetic and Validity, 8 (the long accumulator).
///
/// Bit 64·i + j of the two's complement number `limbs_` counts 2^(64 i + j - 1074), the least subnormal.  A NaN, or
/// infinities of both signs, make the sum NaN; one sign of infinity makes it that infinity.
class ExactSum {
public:
    void add(double x);
    void add(ExactSum const& other);

    /// The double nearest to the exact sum, ties to even; an infinity from 2^1024 - 2^970 on, as for any rounding to
    /// nearest.  The sum of nothing, and of zeros of whatever sign, is +0.
    double value() const;

    friend bool operator==(ExactSum const&, ExactSum const&) = default;

private:
    // 2098 bits of doubles, 64 for carries, a sign.
    static constexpr std::size_t size = 34;
    void add_at(std::size_t limb, std::uint64_t low, std::uint64_t high);
    void subtract_at(std::size_t limb, std::uint64_t low, std::uint64_t high);

    std::array<std::uint64_t, size> limbs_{};
    std::uint8_t nan_ = 0, positive_infinity_ = 0, negative_infinity_ = 0;
};

}  // namespace slideway
