// What the targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "host/base/error.hpp"

namespace slideway::fuzz {

/// Ends the process, which libFuzzer takes for a crash: the input that led here is kept.
inline void require(bool holds, std::string_view what, std::string_view shown = {}) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %.*s\n%.*s\n", static_cast<int>(what.size()), what.data(), static_cast<int>(shown.size()),
                 shown.data());
    std::abort();
}

/// Whether the work was done; a refusal must be an error of the input, and one clear line.
template <class Work> bool accepted(Work const& work) {
    std::string line;
    try {
        work();
        return true;
    } catch (SceneError const& error) {
        line = error.what();
    } catch (FileError const& error) {
        line = error.what();
    }
    require(!line.empty(), "an error says something");
    for (char const byte : line) {
        auto const code = static_cast<unsigned char>(byte);
        require(code >= 0x20 && code != 0x7f, "an error is one line of printable text", line);
    }
    return false;
}

inline std::string_view text_of(std::uint8_t const* data, std::size_t size) {
    return {reinterpret_cast<char const*>(data), size};
}

/// Takes the first byte off the text: which of several functions it is for.
inline unsigned take_choice(std::string_view& text, unsigned choices) {
    if (text.empty()) return 0;
    unsigned const choice = static_cast<unsigned char>(text.front()) % choices;
    text.remove_prefix(1);
    return choice;
}

/// A folder of this process below that for temporary files, for functions that read files.  libFuzzer ends without leave: scripts/fuzz.sh
/// removes it.
inline std::filesystem::path const& folder() {
    static std::filesystem::path const path = [] {
        auto const own = std::filesystem::temp_directory_path() / ("slideway_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(own);
        return own;
    }();
    return path;
}

inline void write_file(std::filesystem::path const& path, std::string_view text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace slideway::fuzz
