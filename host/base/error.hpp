#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace slideway {

/// The text on one line: control characters, which names of files and of keys may hold, as \xNN.
inline std::string in_one_line(std::string_view text) {
    constexpr char const* digits = "0123456789abcdef";
    std::string line;
    for (std::size_t i = 0; i < text.size(); ++i) {
        auto const byte = static_cast<unsigned char>(text[i]);
        // U+0080 to U+009F are control characters too, in UTF-8 two bytes.
        bool const later = byte >= 0x80 && byte < 0xa0 && i > 0 && text[i - 1] == '\xc2';
        if (byte >= 0x20 && byte != 0x7f && !later)
            line += text[i];
        else
            line += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
    return line;
}

/// A command line or scene that cannot be used.  `what()` is the whole line to print:
/// `scenes/a.toml:12: joint.clearance is 0 m (the joint needs a gap); use a value > 0`.  Exit code 2.
class SceneError : public std::runtime_error {
public:
    explicit SceneError(std::string_view line) : std::runtime_error(in_one_line(line)) {}
};

/// A file that cannot be read or written.  Exit code 4.
class FileError : public std::runtime_error {
public:
    explicit FileError(std::string_view line) : std::runtime_error(in_one_line(line)) {}
};

}  // namespace slideway
