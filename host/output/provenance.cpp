#include "host/output/provenance.hpp"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <system_error>

#include <fmt/chrono.h>

#include "host/output/commit.hpp"
#include "host/output/durable_file.hpp"
#include "host/scene/fnv1a.hpp"

namespace slideway {

std::string build_of(std::string const& commit, std::string const& program) {
    if (!commit.ends_with("-dirty") && commit != "unknown") return commit;
    return fmt::format("{}-{:016x}", commit, fnv1a(read_bytes(program)));
}

BuildInfo const& build_info() {
    static BuildInfo const info{SLIDEWAY_VERSION, build_of(SLIDEWAY_COMMIT, "/proc/self/exe"), SLIDEWAY_COMPILER};
    return info;
}

std::string BuildInfo::text() const { return fmt::format("slideway {}, commit {}, {}", version, commit, compiler); }

std::string creation_time() {
    std::time_t seconds = std::time(nullptr);
    if (char const* const text = std::getenv("SOURCE_DATE_EPOCH")) {
        std::time_t given = 0;
        char const* const end = text + std::strlen(text);
        auto const [stop, error] = std::from_chars(text, end, given);
        // Beyond the year 9999 ISO 8601 needs an agreement that nobody made.
        if (error == std::errc{} && stop == end && given >= 0 && given < 253402300800) seconds = given;
    }
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

}  // namespace slideway
