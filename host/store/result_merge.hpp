// Blocks of members to shards, and these to one result file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/base/durable_file.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/run_identity.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {

/// A member of the merged file is the same to the last bit in whichever shard it came.  Members without a shard have status not_run,
/// NaN and no sections.
struct ResultMerge {
    ResultLayout layout;  // its section_rows follow from the shards
    Provenance provenance;
    std::string completeness;  // an attribute: "complete", "12 of 100 members not run"
    /// What is concluded from the members and added to the file; may be empty.
    std::function<void(DataFile& file)> conclude;
    /// Called now and then; what it throws ends the merge and leaves no file.  May be empty.
    std::function<void()> pause;
    Existing existing = Existing::replaced;  // of a file of the same name

    void may_pause() const {
        if (pause) pause();
    }
};

/// A shard as a merge reads it.
struct MergedShard {
    MemberSet members;
    std::function<std::unique_ptr<DataFile>()> open;
};

/// @param layout of the run; its members do not count.  @param name of the file, for messages.  @throws FileError
ShardImage shard_image(std::string const& name, ResultLayout const& layout, Provenance const& provenance, BlockResult const& block);
/// The same in memory, without provenance.
MergedShard memory_shard(std::string const& name, ResultLayout const& layout, BlockResult const& block);

/// The members of the shards, in order, into an empty file.
void write_merged(DataFile& file, std::vector<MergedShard> const& shards, ResultMerge& merge);

/// Writes `path`.part, which becomes `path` when it is whole: a former file stays until then.
/// @throws FileError, also if another process writes the same file, or somebody else's `path`.part is there; if only the renaming failed,
/// `path`.part stays.
void merge_shards(std::vector<MergedShard> const& shards, ResultMerge merge, std::string const& path);

/// The same of shards in a folder, of which one at a time is in memory.
void merge_shards(ShardFolder const& folder, std::vector<Shard> const& shards, ResultMerge merge, std::string const& path);

/// @throws FileError where files that no merge left have the names that a result has while it is written: `.part`, `.part.lock`
void require_room_beside(std::string const& path);

/// The same for what `write` puts into the file: adds completeness and seals it.
void write_result(std::string const& path, std::string const& completeness, std::function<void(NetcdfFile& file)> const& write,
                  Existing existing = Existing::replaced);

/// Removes the lock of a process that was killed when its file was whole.  @throws FileError, also if another writes it
void remove_merge_lock(std::string const& path);

}  // namespace slideway
