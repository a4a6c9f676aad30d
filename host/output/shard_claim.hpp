// The right to write into a folder of shards.
#pragma once

#include <string>
#include <vector>

#include "host/output/shard_folder.hpp"

namespace slideway {

/// Held by the process that runs the whole, or by each of those that run a part of it, which write side by side.
class ShardClaim {
public:
    struct Wanted {
        RunIdentity identity;
        MemberSet mine;    // what this process, with its ranks, is to run
        std::string part;  // "3-of-8"; "" for the whole run
        bool resume = false;
    };
    /// Makes the folder or goes on with it.  @throws SceneError if it holds finished members of another identity, or of these and
    /// `resume` is not set; FileError if another process works on them.
    ShardClaim(std::string folder, Wanted const& wanted);
    ~ShardClaim();
    ShardClaim(ShardClaim const&) = delete;
    ShardClaim& operator=(ShardClaim const&) = delete;

    /// Of `mine`, finished before.
    MemberSet const& done() const { return done_; }
    /// Shards that are not what was written; their members are to run again.
    std::vector<std::string> const& damaged() const { return damaged_; }

    /// When the result stands elsewhere: removes what belongs to the run.  What is not ours stays, and so does the folder then.
    /// @throws FileError
    void remove_folder();
    /// Ends what a process that was killed in `remove_folder` began.  @throws FileError, also if another process works there
    static void remove_remains(std::string const& folder);

private:
    /// Of a folder without identity, to clear it.
    explicit ShardClaim(std::string folder);
    void begin(Wanted const& wanted);
    void require_alone(Wanted const& wanted);
    void remove_damaged(std::vector<Shard> const& damaged, MemberSet const& mine);
    void remove_shards();
    void release();

    std::string const folder_;
    int whole_ = -1, part_ = -1;  // locks
    MemberSet done_;
    std::vector<std::string> damaged_;
};

}  // namespace slideway
