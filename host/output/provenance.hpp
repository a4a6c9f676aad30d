// Where a result comes from: what a result file says about the program, the build and the run that made it.
#pragma once

#include <cstdint>
#include <string>

namespace slideway {

/// The program as it was built.
struct BuildInfo {
    std::string version;   // "0.1.0"
    std::string commit;    // short name, "-dirty" behind it if tracked files differed; "unknown" without git
    std::string compiler;  // "GNU 12.2.0"
    std::string text() const;  // "slideway 0.1.0, commit 60e6457, GNU 12.2.0": of two alike, members have the same bits
};
BuildInfo const& build_info();

/// One run.
struct Provenance {
    std::string title;
    std::string scene;  // resolved, as TOML
    std::uint64_t seed = 0;
    std::string backend;  // "cpu"
    std::string isa;
    std::string flags;  // of the compiler, for the kernels of that ISA
    int threads = 1;
};

/// Now, or SOURCE_DATE_EPOCH (seconds since 1970) where the environment sets it: `2024-05-01T12:00:00Z`.
std::string creation_time();

}  // namespace slideway
