// Puts shards into a folder.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/base/durable_file.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {

/// The bytes of one shard that stands for several, whose members differ.  Files that are no longer what was written
/// throw FileError.
using ShardJoin = std::function<std::vector<std::byte>(std::string const& folder, std::span<Shard const> shards)>;

/// From one thread.
///
/// With a `join`, files do not grow in number with the blocks: `shards_joined` shards of a generation become one of the
/// next.  That one is on the disk and in the manifest, under a name of its own, before the first of the others is
/// removed.  So whatever ends the process, each member is in a shard that is listed: where two hold it, the later line
/// of the manifest counts.
class ShardStore {
public:
    static constexpr std::size_t shards_joined = 64;

    /// @param join empty: shards are result files and stay as they are.
    explicit ShardStore(std::string folder, ShardJoin join = {}) : folder_(std::move(folder)), join_(std::move(join)) {}
    /// On the disk when it returns.  @throws FileError
    void put(MemberSet const& members, std::vector<std::byte> const& bytes);

private:
    Shard put_as(std::string name, MemberSet const& members, std::vector<std::byte> const& bytes);
    void begin_manifest();

    std::string const folder_;
    ShardJoin const join_;
    std::unique_ptr<LineFile> manifest_;           // made with the first shard
    std::vector<std::vector<Shard>> generations_;  // those that this store has put and not joined
};

}  // namespace slideway
