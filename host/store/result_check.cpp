#include "host/store/result_check.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "host/base/apart.hpp"
#include "host/base/error.hpp"
#include "host/run/ranks.hpp"
#include "host/store/result_view.hpp"

namespace slideway {
namespace {

constexpr std::string_view error_mark = "error ";

constexpr char const* what_to_do = "copy it again, or run its scene again";

/// Ten times what an intact file takes, and more.
ApartLimits limits_of(std::string const& path) {
    std::error_code error;
    auto const size = std::filesystem::file_size(path, error);
    std::uint64_t const bytes = error ? 0 : size;
    constexpr std::uint64_t seconds = 5, bytes_a_second = 10'000'000, memory = std::uint64_t{1} << 30;
    return {seconds + bytes / bytes_a_second, memory + 2 * bytes};
}

/// What somebody looks for in a file; its words come back.
std::string look_apart(std::string const& path, std::function<std::string(ResultReader const&)> const& look) {
    std::error_code ignored;
    auto const kind = std::filesystem::status(path, ignored).type();
    using Type = std::filesystem::file_type;
    if (kind == Type::fifo || kind == Type::socket || kind == Type::character || kind == Type::block) {
        throw FileError(path + ": is a device or a pipe; give the name of a result file");
    }
    // A process that has begun MPI may not be forked (its network's memory is registered): the ranks of a job look for themselves.
    auto const launch = find_launch([](char const* name) -> char const* { return std::getenv(name); });
    if (launch && launch->count != 1) return look(ResultReader(path));
    auto const work = [&] {
        try {
            return look(ResultReader(path));
        } catch (FileError const& error) {
            return fmt::format("{}{}", error_mark, error.what());
        }
    };
    ApartOutcome const outcome = run_apart(work, limits_of(path));
    if (outcome.answer) {
        if (outcome.answer->starts_with(error_mark)) throw FileError(outcome.answer->substr(error_mark.size()));
        return *outcome.answer;
    }
    std::string const how = outcome.signal == SIGXCPU  ? "does not come to an end with it"
                            : outcome.signal == 0 ? "runs out of memory"
                                                  : fmt::format("crashes on it ({})", strsignal(outcome.signal));
    throw FileError(fmt::format("{}: is damaged so badly that the HDF5 library {}; {}", path, how, what_to_do));
}

}  // namespace

SealCheck check_result(std::string const& path) {
    std::istringstream words(look_apart(path, [](ResultReader const& results) {
        SealCheck seal = results.check();
        // What stands in the place of a hash may be anything.
        for (std::string* const stored : {&seal.payload, &seal.metadata}) std::replace(stored->begin(), stored->end(), '\n', '?');
        return fmt::format("{}\n{}\n{}\n{}\n{}\n", seal.version, seal.payload, seal.metadata, seal.payload_found, seal.metadata_found);
    }));
    SealCheck seal;
    words >> seal.version;
    words.ignore();
    for (std::string* const hash : {&seal.payload, &seal.metadata, &seal.payload_found, &seal.metadata_found}) std::getline(words, *hash);
    return seal;
}

void require_intact(std::string const& path) {
    std::string const damage = check_result(path).damage();
    if (!damage.empty()) throw FileError(fmt::format("{}: {}; the file is damaged or was edited, see slideway info", path, damage));
}

bool is_result_file(std::string const& path) {
    try {
        look_apart(path, [](ResultReader const&) { return std::string(); });
        return true;
    } catch (FileError const&) {
        return false;
    }
}

}  // namespace slideway
