// What a run computes, and whether another one computes the same.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "host/run/member_set.hpp"

namespace slideway {

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
