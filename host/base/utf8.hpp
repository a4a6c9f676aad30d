// Characters of UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace slideway {

/// Length of the character that begins at `at`, or 0 if none does: neither overlong forms nor surrogates are any (RFC 3629).
inline std::size_t character_length(std::string_view text, std::size_t at) {
    auto const byte = static_cast<unsigned char>(text[at]);
    if (byte < 0x80) return 1;
    std::size_t const length = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
    if (byte < 0xc2 || byte > 0xf4 || at + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((static_cast<unsigned char>(text[at + k]) & 0xc0u) != 0x80u) return 0;
    }
    auto const second = static_cast<unsigned char>(text[at + 1]);
    bool const overlong = (byte == 0xe0 && second < 0xa0) || (byte == 0xf0 && second < 0x90);
    bool const no_character = (byte == 0xed && second >= 0xa0) || (byte == 0xf4 && second >= 0x90);  // surrogates; end
    return overlong || no_character ? 0 : length;
}

/// The code point of a whole character.
inline std::uint32_t code_point(std::string_view character) {
    auto const first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first;
    std::uint32_t code = first & (0xffu >> (character.size() + 1));
    for (char const byte : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(byte) & 0x3fu);
    return code;
}

}  // namespace slideway
