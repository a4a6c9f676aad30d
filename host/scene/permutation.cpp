#include "host/scene/permutation.hpp"

#include <bit>
#include <stdexcept>

namespace slideway {
namespace {

// Four would do for large sizes (Luby & Rackoff 1988).  Halves of one or two bits mix slowly: over the keys, the orders of 2 … 8 indices
// are equally likely to within what 1e5 keys can tell from this number on.
constexpr std::uint64_t rounds = 16;

std::uint64_t mask_of(int bits) { return bits == 0 ? 0 : ~std::uint64_t(0) >> (64 - bits); }

}  // namespace

Permutation::Permutation(std::uint64_t size, StreamKey const& key) : size_(size), key_(key) {
    int const bits = size > 1 ? std::bit_width(size - 1) : 0;
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
    if (size_ == 1) return 0;
    do {
        index = shuffle(index);
    } while (index >= size_);
    return index;
}

}  // namespace slideway
