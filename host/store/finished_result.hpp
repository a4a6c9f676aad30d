// Whether a result holds all that a run was to compute, so that the shards it was made of may go.
#pragma once

#include <string>

#include "host/store/result_view.hpp"
#include "host/store/run_identity.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {

/// What tells the run of a result from another, in words: "study.seed was 1, is 2"; "" where it is that run.
std::string difference(ResultReader const& result, RunIdentity const& identity);

/// Why a result is not all that a run was to compute: it is gone, damaged, of another run or not complete; "" where it is.  Reads all of it.
std::string why_not_finished(std::string const& result, RunIdentity const& identity);

/// What a user hears of a folder of shards of which a result was made: that it is no longer needed, if the result is there, sealed and
/// complete, or that it still is, and why.  No other words of the program let anybody remove anything (tests/structure looks for them).
/// @param names_scene words before these name the scene in the folder
std::string words_on_need(ShardFolder const& folder, std::string const& result, bool names_scene);

}  // namespace slideway
