// Where a run keeps what is finished until all of it is: immutable shards and what they belong to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/run/member_set.hpp"
#include "host/store/run_identity.hpp"

namespace slideway {

namespace shard_names {
inline constexpr std::string_view identity = "run.toml", manifest = "manifest-", lock = "lock";
/// The same again: whichever is whole counts.
inline constexpr std::string_view identity_copy = "run-copy.toml";
/// What the identity is called once the result stands elsewhere, while the folder is cleared.
inline constexpr std::string_view finished = "finished.toml";
inline constexpr std::string_view members = "members-", statistics = "statistics-";  // what shards begin with
inline constexpr std::string_view damaged = "damaged-";  // before the name of one that is put aside
inline constexpr std::string_view table = ".table.csv";  // what copies of the scene's tables end with (copy_of_table), for whom the originals are out of reach
}  // namespace shard_names

enum class ShardFile {
    foreign,
    identity,  // run.toml, its copy, finished.toml
    content,   // shards, manifests, what is damaged, tables: of worth only beside the identity
    lock
};

/// By the exact forms of the names that a run gives; a temporary file `.tmp` is of the kind of the one that it was to become.
/// A name that is merely alike (`members-of-the-board.nc`) is foreign.
ShardFile kind_of(std::string_view name);

/// A result file of some members of the run, or their statistics.  It never changes.
struct Shard {
    std::string name;  // in the folder
    std::uint64_t bytes;
    std::uint64_t checksum;  // Fnv1a of the file
    MemberSet members;
};

/// A shard that is to be: of the members of a block that have ended; those that were cut short are not in it.
struct ShardImage {
    MemberSet members;
    std::vector<std::byte> bytes;  // empty if none have ended
};

/// One that is not what was written, and so does not count; or a manifest with lines that cannot be read, and so without their members.
struct DamagedShard {
    Shard shard;
    bool is_gone;  // there is no such file
    bool is_manifest = false;
    std::string words() const { return is_gone ? "is gone" : is_manifest ? "is damaged: not all of its lines can be read" : "is not what was written"; }
};

/// One shard.  @throws FileError if the file is not what the manifest says.
std::vector<std::byte> read_shard(std::string const& folder, Shard const& shard);

/// `run.toml`    the identity: a scene file, with the rest as comments; `run-copy.toml` the same again
/// `members-*.nc`    the shards, or `statistics-*.bin` where members are not stored
/// `manifest-*.txt`  one line per shard, written once the shard is on the disk; each line has a checksum of its own, so that a
///                   torn one is told.  Every process that writes has a manifest of its own.
/// `damaged-*`   shards that were not what had been written, put aside
/// `study.table.csv`, `load.*.table.csv`   copies of the tables that the scene reads
/// `finished.toml`   the identity once the result stands elsewhere: the rest is to be removed
/// `lock*`       held by the processes that write
class ShardFolder {
public:
    /// An existing one, to read.  @throws FileError if it is none, or if neither file of the identity is whole.
    explicit ShardFolder(std::string path);

    /// Whether there is such a folder with an identity.  @throws FileError if that cannot be told
    static bool exists(std::string const& path);

    std::string const& path() const { return path_; }
    RunIdentity const& identity() const { return identity_; }
    /// The file of the identity that is damaged or gone, so that the other counts; "" where none is.
    std::string const& damaged_identity() const { return damaged_; }
    /// Makes both what they should be, for those who write into the folder.  @throws FileError
    void mend() const;
    /// What the manifests list, by first member; `read` tells whether a file is what it was.  @throws FileError if a file
    /// cannot be looked at
    std::vector<Shard> listed() const;
    /// Those that are: reads them all.  @param damaged the others, but for those whose members or whose name another one
    /// has by now; and damaged manifests, as long as members are missing  @throws FileError if one cannot be read, which says nothing of what it holds
    std::vector<Shard> intact(std::vector<DamagedShard>& damaged) const;
    /// @throws FileError if the file is not what the manifest says.
    std::vector<std::byte> read(Shard const& shard) const { return read_shard(path_, shard); }

private:
    std::string path_;
    RunIdentity identity_;
    std::string damaged_;
};

/// Writes both files of the identity; what was there before is none at any time.  @throws FileError
void write_identity(std::string const& folder, RunIdentity const& identity);

/// Names of the files in a folder, sorted.  @throws FileError
std::vector<std::string> names_in(std::string const& folder);

/// Names of the shards that the manifests in a folder list, sorted; also of a folder without identity.  @throws FileError
std::vector<std::string> listed_names(std::string const& folder);

/// Members of shards together.
MemberSet members_of(std::vector<Shard> const& shards);

std::string manifest_name(int number);
/// Without its end.
std::string manifest_line(Shard const& shard);

}  // namespace slideway
