#include "host/statistics/exact_sum.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include <boost/multiprecision/cpp_int.hpp>

#include "host/base/bytes.hpp"
#include "host/base/numbers.hpp"

namespace slideway {

static_assert(std::is_trivially_copyable_v<ExactSum>);
static_assert(std::numeric_limits<double>::is_iec559);

namespace {

constexpr int fraction_bits = 52;
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << fraction_bits;

/// a + b + carry, the carry replaced by that out.
std::uint64_t add_with_carry(std::uint64_t a, std::uint64_t b, bool& carry) {
    std::uint64_t const sum = a + b, total = sum + carry;
    carry = sum < a || total < sum;
    return total;
}

}  // namespace

void ExactSum::add_at(std::size_t limb, std::uint64_t low, std::uint64_t high) {
    bool carry = false;
    limbs_[limb] = add_with_carry(limbs_[limb], low, carry);
    limbs_[limb + 1] = add_with_carry(limbs_[limb + 1], high, carry);
    for (std::size_t i = limb + 2; carry && i < size; ++i) carry = ++limbs_[i] == 0;
}

void ExactSum::subtract_at(std::size_t limb, std::uint64_t low, std::uint64_t high) {
    bool borrow = limbs_[limb] < low;
    limbs_[limb] -= low;
    std::uint64_t const next = limbs_[limb + 1];
    limbs_[limb + 1] = next - high - borrow;
    borrow = next < high || (borrow && next == high);
    for (std::size_t i = limb + 2; borrow && i < size; ++i) borrow = limbs_[i]-- == 0;
}

void ExactSum::add(double x) {
    auto const bits = std::bit_cast<std::uint64_t>(x);
    bool const negative = (bits >> 63) != 0;
    auto const exponent = static_cast<std::size_t>((bits >> fraction_bits) & 0x7ff);
    std::uint64_t const fraction = bits & (hidden_bit - 1);
    if (exponent == 0x7ff) {
        if (fraction != 0) nan_ = 1;
        if (fraction == 0) (negative ? negative_infinity_ : positive_infinity_) = 1;
        return;
    }
    // Subnormals have the exponent of the least normal and no hidden bit.
    std::uint64_t const significand = exponent == 0 ? fraction : fraction | hidden_bit;
    std::size_t const place = exponent == 0 ? 0 : exponent - 1;
    std::size_t const limb = place / 64, shift = place % 64;
    std::uint64_t const low = significand << shift, high = shift == 0 ? 0 : significand >> (64 - shift);
    if (negative) {
        subtract_at(limb, low, high);
    } else {
        add_at(limb, low, high);
    }
}

void ExactSum::add(ExactSum const& other) {
    bool carry = false;
    for (std::size_t i = 0; i < size; ++i) limbs_[i] = add_with_carry(limbs_[i], other.limbs_[i], carry);
    nan_ |= other.nan_;
    positive_infinity_ |= other.positive_infinity_;
    negative_infinity_ |= other.negative_infinity_;
}

double ExactSum::value() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (nan_ || (positive_infinity_ && negative_infinity_)) return nan;
    if (positive_infinity_) return infinity;
    if (negative_infinity_) return -infinity;

    auto magnitude = limbs_;
    bool const negative = (limbs_.back() >> 63) != 0;
    if (negative) {  // two's complement: invert and add one
        bool carry = true;
        for (std::uint64_t& limb : magnitude) limb = add_with_carry(~limb, 0, carry);
    }
    std::size_t top = size;
    while (top > 0 && magnitude[top - 1] == 0) --top;
    if (top == 0) return 0;
    std::size_t const bits = 64 * top - static_cast<std::size_t>(std::countl_zero(magnitude[top - 1]));
    double const sign = negative ? -1 : 1;
    constexpr std::size_t digits = fraction_bits + 1;
    if (bits <= digits) return sign * std::ldexp(static_cast<double>(magnitude[0]), -1074);

    std::size_t const dropped = bits - digits;
    auto const bit = [&](std::size_t i) { return (magnitude[i / 64] >> (i % 64)) & 1; };
    std::uint64_t significand = 0;
    for (std::size_t i = 0; i < digits; ++i) significand |= bit(dropped + i) << i;
    bool sticky = false;  // anything below the half
    for (std::size_t i = 0; i + 1 < dropped && !sticky; ++i) sticky = bit(i) != 0;
    if (bit(dropped - 1) && (sticky || (significand & 1))) ++significand;
    // 2^53 after a carry is a double too; ldexp overflows to infinity.
    return sign * std::ldexp(static_cast<double>(significand), static_cast<int>(dropped) - 1074);
}

std::vector<std::byte> ExactSum::bytes() const {
    static_assert(byte_count == (size + 1) * sizeof(std::uint64_t));
    std::uint64_t const flags = nan_ | positive_infinity_ << 1 | negative_infinity_ << 2;
    ByteWriter out;
    for (std::uint64_t const limb : limbs_) out.put(limb);
    out.put(flags);
    return out.take();
}

std::optional<ExactSum> ExactSum::from_bytes(std::span<std::byte const> bytes) {
    ExactSum sum;
    std::uint64_t flags = 0;
    if (bytes.size() != byte_count) return std::nullopt;
    std::memcpy(sum.limbs_.data(), bytes.data(), sizeof sum.limbs_);
    std::memcpy(&flags, bytes.data() + sizeof sum.limbs_, sizeof flags);
    if (flags > 7) return std::nullopt;
    sum.nan_ = flags & 1;
    sum.positive_infinity_ = flags >> 1 & 1;
    sum.negative_infinity_ = flags >> 2 & 1;
    return sum;
}

ExactSum::Scaled ExactSum::spread(std::uint64_t n, ExactSum const& sum, ExactSum const& squares) {
    using Integer = boost::multiprecision::cpp_int;
    auto const integer = [](ExactSum const& of) {
        Integer value;
        boost::multiprecision::import_bits(value, of.limbs_.begin(), of.limbs_.end(), 64, false);
        if (of.limbs_.back() >> 63) value -= Integer(1) << (64 * size);  // two's complement
        return value;
    };
    // In units of 2^-2148, the square of those of the sum.
    constexpr int unit = 1074;
    Integer const first = integer(sum);
    Integer const difference = (integer(squares) * n << unit) - first * first;
    if (difference == 0) return {0, 0};
    bool const negative = difference < 0;
    Integer const magnitude = negative ? Integer(-difference) : difference;
    int const bits = static_cast<int>(boost::multiprecision::msb(magnitude)) + 1;
    int const dropped = bits > 64 ? bits - 64 : 0;
    auto const top = static_cast<std::uint64_t>(magnitude >> dropped);
    double const mantissa = std::ldexp(static_cast<double>(top), dropped - bits);
    return {negative ? -mantissa : mantissa, bits - 2 * unit};
}

}  // namespace slideway
