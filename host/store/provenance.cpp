#include "host/store/provenance.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/chrono.h>

#include "host/backend/commit.hpp"
#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway {

namespace {

/// The first value of a key of /proc/cpuinfo; "unknown" without it.
std::string cpu_info(std::string const& key) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        auto const colon = line.find(": ");
        if (colon != std::string::npos && line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) == key) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

/// Piece by piece: a program is larger than many a run.
std::uint64_t checksum_of(std::string const& program) {
    std::ifstream file(program, std::ios::binary);
    Fnv1a hash;
    std::vector<char> piece(1 << 16);
    while (file) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        hash.add(std::string_view(piece.data(), static_cast<std::size_t>(file.gcount())));
    }
    if (!file.eof()) throw FileError(fmt::format("{}: cannot be read", program));
    return hash.value();
}

}  // namespace

std::string build_of(std::string const& commit, std::string const& program) {
    if (!commit.ends_with("-dirty") && commit != "unknown") return commit;
    return fmt::format("{}-{:016x}", commit, checksum_of(program));
}

BuildInfo const& build_info() {
    static BuildInfo const info{SLIDEWAY_VERSION, build_of(SLIDEWAY_COMMIT, "/proc/self/exe"), SLIDEWAY_COMPILER};
    return info;
}

std::string BuildInfo::text() const { return fmt::format("slideway {}, commit {}, {}", version, commit, compiler); }

std::string cpu_name() {
    static std::string const name = fmt::format("{}, family {} model {}", cpu_info("model name"), cpu_info("cpu family"), cpu_info("model"));
    return name;
}

std::string machine_name() { return fmt::format("{} ({} threads)", cpu_name(), std::thread::hardware_concurrency()); }

std::string creation_time() {
    std::time_t seconds = std::time(nullptr);
    if (char const* const text = std::getenv("SOURCE_DATE_EPOCH")) {
        auto const given = parse_number<std::time_t>(text);
        // Beyond the year 9999 ISO 8601 needs an agreement that nobody made.
        if (given && *given >= 0 && *given < 253402300800) seconds = *given;
    }
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

std::vector<DataFile::Attribute> attributes_of(Provenance const& provenance) {
    BuildInfo const& build = build_info();
    std::vector<DataFile::Attribute> attributes{{"Conventions", "CF-1.8"},
                                                {"title", provenance.title},
                                                {"source", "slideway " + build.version},
                                                {"version", build.version},
                                                {"commit", build.commit},
                                                {"compiler", build.compiler},
                                                {"flags", provenance.maker.flags},
                                                {"backend", provenance.maker.backend},
                                                {"isa", provenance.maker.isa},
                                                {"machine", machine_name()},
                                                {"threads", provenance.maker.threads},
                                                {"seed", fmt::format("{}", provenance.seed)},  // CF-1.8 has no 64-bit integers
                                                {"created", creation_time()},
                                                {"scene", provenance.scene}};
    if (!provenance.modules.empty()) attributes.push_back({"modules", provenance.modules});
    // For readers that know no mechanism or law by its name.
    attributes.push_back({"mechanism_meaning", provenance.mechanism});
    if (provenance.law.empty()) return attributes;
    attributes.push_back({"contact_law_meaning", provenance.law});
    attributes.push_back({"contact_law_switches", provenance.law_switches ? 1 : 0});
    return attributes;
}

}  // namespace slideway
