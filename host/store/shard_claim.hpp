// The right to write into a folder of shards, and to remove it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/base/file_lock.hpp"
#include "host/store/run_identity.hpp"
#include "host/store/result_view.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {

/// Held by the process that runs the whole, or by each of those that run a part of it, which write side by side.
class ShardClaim {
public:
    struct Wanted {
        RunIdentity identity;
        MemberSet mine;    // what this process, with its ranks, is to run
        std::string part;  // "3-of-8"; "" for the whole run
        bool resume = false;
        /// Texts of the tables that the scene reads, by the names of the copies that are kept beside the identity.
        std::map<std::string, std::shared_ptr<std::string const>> tables = {};
    };
    /// Makes the folder or goes on with it.  @throws SceneError if it holds finished members of another identity, or of these and
    /// `resume` is not set, or shards of which nothing says what they belong to; FileError if another process works on them.
    ShardClaim(std::string folder, Wanted const& wanted);
    ShardClaim(ShardClaim const&) = delete;
    ShardClaim& operator=(ShardClaim const&) = delete;

    /// Of `mine`, finished before.
    MemberSet const& done() const { return done_; }
    /// Shards that are not what was written: they were put aside, and their members are to run again.
    std::vector<DamagedShard> const& damaged() const { return damaged_; }

    /// The file of the identity that was damaged, and is whole again; "" where none was.
    std::string const& mended() const { return mended_; }

    /// When the result stands elsewhere: removes what belongs to the run.  What is not ours stays, also under a name that a shard could
    /// have, and so does the folder then; a folder that OUT.nc.shards is but a link to stays too, empty.
    /// @return the names of what stays  @throws FileError
    std::vector<std::string> remove_folder();
    /// Ends what a process that was killed in `remove_folder` began.  @throws FileError, also if another process works there
    static void remove_remains(std::string const& folder);
    /// Removes the shards of a result that stands, which a process left that was killed between both.  @throws as `remove_remains`
    static void remove_merged(std::string const& folder);
    /// That no process works in the folder of the shards of a result.  @throws FileError, which says that one writes `result`
    static void require_nobody(std::string const& folder, std::string const& result);

private:
    /// Of a folder without identity, to clear it.
    explicit ShardClaim(std::string folder);
    void begin(Wanted const& wanted);
    void require_alone(Wanted const& wanted);
    void require_one_division(std::string const& part) const;
    void put_aside(std::vector<DamagedShard> const& damaged, MemberSet const& mine);
    void take_over(Wanted const& wanted);
    void write_tables(Wanted const& wanted) const;
    void remove_content(bool all_tables);

    std::string const folder_;
    std::optional<std::vector<std::string>> tables_;  // copies that the run keeps there; none: of any name
    std::optional<FileLock> whole_, part_;
    MemberSet done_;
    std::vector<DamagedShard> damaged_;
    std::string mended_;
};

// Whether a result holds all that a run was to compute, so that the shards it was made of may go.

/// What tells the run of a result from another, in words: "study.seed was 1, is 2"; "" where it is that run.
std::string difference(ResultReader const& result, RunIdentity const& identity);

/// Why a result is not all that a run was to compute: it is gone, damaged, of another run or not complete; "" where it is.  Reads all of it.
std::string why_not_finished(std::string const& result, RunIdentity const& identity);

/// What a user hears of a folder of shards of which a result was made: that it is no longer needed, if the result is there, sealed and
/// complete, or that it still is, and why.  No other words of the program let anybody remove anything (tests/structure looks for them).
/// @param names_scene words before these name the scene in the folder
std::string words_on_need(ShardFolder const& folder, std::string const& result, bool names_scene);

}  // namespace slideway
