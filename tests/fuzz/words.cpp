// The words of a command line, one a line, up to the arguments of a command; nothing runs.
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/commands/commands.hpp"
#include "tests/fuzz/fuzz.hpp"

// A program with one instruction set and without kernels, which would take minutes to compile here: the command line asks for their names alone.
namespace slideway {
namespace {
constexpr std::array isas = {Isa::scalar, Isa::avx512};
}
std::string_view name_of(Isa isa) { return isa == Isa::scalar ? "scalar" : "avx512"; }
bool is_built(Isa isa) { return isa == Isa::scalar; }
bool is_supported(Isa isa) { return is_built(isa); }
Isa best_isa() { return Isa::scalar; }
std::span<Isa const> all_isas() { return isas; }
std::span<Isa const> built_isas() { return std::span(isas).first(1); }
std::shared_ptr<Backend const> cpu_backend(Isa) { return nullptr; }
int default_threads() { return 1; }
}  // namespace slideway

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
