// What a run computes, and whether another one computes the same.
#pragma once

#include <string>

#include "host/driver/member_set.hpp"

namespace slideway {

/// What a run computes, and with which program: two runs whose identities agree give every member the same bits.
struct RunIdentity {
    std::string program;  // version, commit and compiler
    MemberSet members;    // of the whole run, also where parts of it run elsewhere
    std::string scene;    // resolved, as TOML

    /// In words, or "": "joint.clearance was 0.0001, is 0.0002".  @param earlier what is continued
    std::string difference(RunIdentity const& earlier) const;
};

/// A scene file that starts with the rest as comments.
std::string identity_text(RunIdentity const& identity);
/// The other way.  @param path of the text, for messages.  @throws FileError if it is no such text.
RunIdentity parse_identity(std::string const& text, std::string const& path);

}  // namespace slideway
