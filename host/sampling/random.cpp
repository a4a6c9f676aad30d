#include "host/sampling/random.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <Random123/philox.h>

#include "host/base/bytes.hpp"

namespace slideway {

std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key) {
    r123::Philox4x64 const generator;  // ten rounds are its default
    r123::Philox4x64::ctr_type const c = {{counter[0], counter[1], counter[2], counter[3]}};
    r123::Philox4x64::key_type const k = {{key[0], key[1]}};
    auto const words = generator(c, k);
    return {words[0], words[1], words[2], words[3]};
}

std::uint64_t name_hash(std::string_view name) { return fnv1a(name); }

std::array<std::uint64_t, 4> StreamKey::words(Stream stream, std::uint64_t index, std::uint64_t sub) const {
    return philox({index, static_cast<std::uint64_t>(stream), sub, 0}, {seed, name});
}

double StreamKey::uniform(Stream stream, std::uint64_t index) const { return unit_fraction(words(stream, index)[0]); }

double unit_fraction(std::uint64_t word) {
    // 52 bits and a half: (2^53 − ½)·2^-53 would round to 1, (2^52 − ½)·2^-52 is a double below it.
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
}

namespace {

// Four would do for large sizes (Luby & Rackoff, SIAM J. Comput. 17 (1988) 373).  Halves of one and two bits mix
// slowly: even after sixteen rounds some orders of five indices are likelier than others, so small sizes walk a larger
// domain.
constexpr std::uint64_t rounds = 12;
constexpr int least_bits = 6;

std::uint64_t mask_of(int bits) { return ~std::uint64_t(0) >> (64 - bits); }

}  // namespace

Permutation::Permutation(std::uint64_t size, StreamKey const& key) : size_(size), key_(key) {
    int const bits = std::max(least_bits, static_cast<int>(std::bit_width(size == 0 ? 0 : size - 1)));
    right_bits_ = bits - bits / 2;
    left_mask_ = mask_of(bits / 2);
    right_mask_ = mask_of(right_bits_);
}

std::uint64_t Permutation::shuffle(std::uint64_t index) const {
    std::uint64_t left = index >> right_bits_ & left_mask_;
    std::uint64_t right = index & right_mask_;
    for (std::uint64_t round = 0; round < rounds; round += 2) {
        left ^= key_.words(Stream::permutation, right, round)[0] & left_mask_;
        right ^= key_.words(Stream::permutation, left, round + 1)[0] & right_mask_;
    }
    return left << right_bits_ | right;
}

std::uint64_t Permutation::operator()(std::uint64_t index) const {
    if (index >= size_) throw std::out_of_range("Permutation: index beyond its size");
    do {
        index = shuffle(index);
    } while (index >= size_);
    return index;
}

}  // namespace slideway
