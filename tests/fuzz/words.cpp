// The words of a command line, one a line, up to the arguments of a command; nothing runs.
#include <algorithm>
#include <string>
#include <vector>

#include "host/commands/commands.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway {
int default_threads() { return 1; }
}

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view rest = fuzz::text_of(data, size);
    std::vector<std::string> words{"slideway"};
    while (!rest.empty()) {
        auto const end = std::min(rest.find('\n'), rest.size());
        std::string_view const word = rest.substr(0, end);
        words.emplace_back(word.substr(0, word.find('\0')));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    fuzz::accepted([&] { cli::parse_arguments(static_cast<int>(words.size()), pointers.data()); });
    for (std::string const& word : words) fuzz::require(!cli::shell_quoted(word).empty(), "a word for a shell is not empty", word);
    return 0;
}
