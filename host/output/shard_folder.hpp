// Where a run keeps what is finished until all of it is: immutable shards and what they belong to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/driver/member_set.hpp"
#include "host/output/durable_file.hpp"
#include "host/output/run_identity.hpp"

namespace slideway {

namespace shard_names {
inline constexpr std::string_view identity = "run.toml", manifest = "manifest-", shard = "members-", lock = "lock";
}

/// A result file of some members of the run.  It never changes.
struct Shard {
    std::string name;  // in the folder
    std::uint64_t bytes;
    std::uint64_t checksum;  // Fnv1a of the file
    MemberSet members;
};

/// `run.toml`    the identity: a scene file, with the rest as comments
/// `members-*.nc`    the shards
/// `manifest-*.txt`  one line per shard, written once the shard is on the disk; each line has a checksum of its own, so that a
///                   torn one is told.  Every process that writes has a manifest of its own.
/// `lock*`       held by the processes that write
class ShardFolder {
public:
    /// An existing one, to read.  @throws FileError if it is none.
    explicit ShardFolder(std::string path);

    /// Whether there is such a folder with an identity.
    static bool exists(std::string const& path);

    std::string const& path() const { return path_; }
    RunIdentity const& identity() const { return identity_; }
    /// What the manifests list, by first member; `read` tells whether a file is what it was.
    std::vector<Shard> listed() const;
    /// Those that are: reads them all.  @param damaged the others, but for those whose members or whose name another one
    /// has by now
    std::vector<Shard> intact(std::vector<Shard>& damaged) const;
    /// @throws FileError if the file is not what the manifest says.
    std::vector<std::byte> read(Shard const& shard) const;


private:
    std::vector<Shard> all() const;

    std::string path_;
    RunIdentity identity_;
};

/// Names of the files in a folder, sorted.  @throws FileError
std::vector<std::string> names_in(std::string const& folder);

/// Members of shards together.
MemberSet members_of(std::vector<Shard> const& shards);

/// Puts shards into a folder.  From one thread.
class ShardStore {
public:
    explicit ShardStore(std::string folder) : folder_(std::move(folder)) {}
    /// On the disk when it returns.  @throws FileError
    void put(MemberSet const& members, std::vector<std::byte> const& bytes);

private:
    std::string const folder_;
    std::unique_ptr<LineFile> manifest_;  // made with the first shard
};

}  // namespace slideway
