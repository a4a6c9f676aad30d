#include "host/sampling/random.hpp"

#include <Random123/philox.h>

#include "host/base/fnv1a.hpp"

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

}  // namespace slideway
