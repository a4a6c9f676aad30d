// Where a result comes from: what it says about the program, the build and the run that made it; and whether another run computes the same.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/run/member_set.hpp"
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

// What a run computes, and whether another one computes the same.

/// Of the tables that a scene reads something each, by the keys that name them: study.table, load.plunger.table.
using OfTables = std::map<std::string, std::string>;

/// What a run computes, and with which program: two runs whose identities agree give every member the same bits.
struct RunIdentity {
    std::string program;     // version, commit and compiler
    std::string arithmetic;  // `arithmetic_of` the instruction set
    MemberSet members;       // of the whole run, also where parts of it run elsewhere
    std::string scene;       // resolved, as TOML, `portable_scene`
    OfTables tables = {};    // `paths_of_tables` of the scene before: where they lay is no part of what is computed

    /// In words, or "": "joint.clearance was 0.0001, is 0.0002".  @param earlier what is continued
    std::string difference(RunIdentity const& earlier) const;
};

/// "fused" where a multiplication and an addition that the kernels name are rounded once, "contracted" where the compiler joined others
/// too; by the name of an instruction set.  Only a build that asks for it contracts those of cards ("sm_90-fmad"): all others agree,
/// processors and cards.
std::string arithmetic_of(std::string_view isa);

/// The paths of the files of tables in a resolved scene, quoted as they are there.
OfTables paths_of_tables(std::string const& scene);
/// What tells each from another: "3 rows, FNV-1a 0123456789abcdef", as the comment beside the path says.
OfTables contents_of_tables(std::string const& scene);
/// A resolved scene with other paths.  The comments beside them, with rows and checksums of the tables, stay.
std::string with_tables(std::string const& scene, OfTables const& quoted);
/// What the copy of a table is called beside the identity of a run.
std::string copy_of_table(std::string_view key);
/// The scene with these copies, wherever its tables lay: what a study that was moved has in common with the former.
std::string portable_scene(std::string const& scene);

/// A scene file that starts with the rest as comments, and with a checksum of what follows it.
std::string identity_text(RunIdentity const& identity);
/// The other way.  @param path of the text, for messages.  @throws FileError if it is no such text, or damaged; one without a
/// checksum is of an earlier version.
RunIdentity parse_identity(std::string const& text, std::string const& path);

}  // namespace slideway
