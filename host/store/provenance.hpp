// Where a result comes from: what a result file says about the program, the build and the run that made it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/store/data_file.hpp"

namespace slideway {

/// The program as it was built.
struct BuildInfo {
    std::string version;  // "0.1.0"
    /// Short name, "-dirty" behind it if tracked files differed; "unknown" without git.  Of the latter two there are many, which
    /// a checksum of the program tells apart: "60e6457-dirty-1f83d9abfb41bd6b".
    std::string commit;
    std::string compiler;      // "GNU 12.2.0"
    std::string text() const;  // "slideway 0.1.0, commit 60e6457, GNU 12.2.0": of two alike, members have the same bits
};
BuildInfo const& build_info();

/// The commit as a `BuildInfo` names it.  @param program path of the executable  @throws FileError if it must be read and cannot
std::string build_of(std::string const& commit, std::string const& program);

/// With what members were computed.
struct Maker {
    std::string backend;  // "cpu", "cuda"
    std::string isa;      // "avx512", "sm_90"
    std::string flags;    // of the compiler, for the kernels of that ISA
    int threads = 1;
};

/// One run.
struct Provenance {
    std::string title;
    std::string scene;  // resolved, as TOML
    std::string mechanism;      // what it is, in words
    std::string law;            // the same of the contact law; empty of a mechanism that has no choice of them
    bool law_switches = false;  // LawInfo::switches
    std::string modules;        // which of them are modules, their sources and compilers; empty of the tree's
    std::uint64_t seed = 0;
    Maker maker;
};

/// As a result file says it.
std::vector<DataFile::Attribute> attributes_of(Provenance const& provenance);

std::string cpu_name();      // "AMD EPYC, family 26 model 2", as the kernel names it; "unknown" for what it does not
std::string machine_name();  // that and its threads

/// Now, or SOURCE_DATE_EPOCH (seconds since 1970) where the environment sets it: `2024-05-01T12:00:00Z`.
std::string creation_time();

}  // namespace slideway
