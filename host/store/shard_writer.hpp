// Brings finished blocks to the disk while the next ones are computed.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "host/base/durable_file.hpp"
#include "host/run/block_buffers.hpp"
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

/// A block's results that outlive the buffers they came from; what it gives lives as long as it is.
using KeptBlock = std::function<BlockResult()>;

/// A run that may end before it needs a shard: of one block that is there within `longest`.
struct ShortRun {
    static constexpr std::chrono::milliseconds longest{1000};  // of computing is lost with the process
    std::function<void()> claim;  // the folder, before the first shard; called once, by the writer's thread
    KeptBlock block;              // of a run that came to none
};

/// A thread of its own makes the images of blocks and waits for the disk; computing waits only where that is slower.
/// At most `most_waiting` blocks wait, beside the one that the thread works on: what does is lost with the process.
class ShardWriter {
public:
    static constexpr std::size_t most_waiting = 2;

    /// @param form what a block becomes; of no members if none have ended; called by the
    /// thread, and while it runs nobody else may use netCDF.  @param join of the store; empty: shards
    /// stay as they are.  @param brief nullptr of a run whose folder is claimed
    ShardWriter(std::string folder, std::function<ShardImage(BlockResult const&)> form, ShardJoin join = {}, ShortRun* brief = nullptr);
    /// Waits for what `write` was given; an error then has nobody to hear it: call `finish`.
    ~ShardWriter();
    ShardWriter(ShardWriter const&) = delete;
    ShardWriter& operator=(ShardWriter const&) = delete;

    /// Takes a copy.  One call at a time.  @throws FileError, also of an earlier block.
    void write(BlockResult const& block);
    /// Waits until everything is on the disk, or the only block of a short run in `brief`.  @param whole nothing is left to compute  @throws FileError
    void finish(bool whole = true);

private:
    void put_all();
    void put_next(std::unique_lock<std::mutex>& lock);
    bool stays_short(std::unique_lock<std::mutex>& lock);
    void stop();

    std::function<ShardImage(BlockResult const&)> const form_;
    ShardStore store_;      // the thread's
    ShortRun* const brief_;
    std::mutex mutex_;  // guards what follows
    std::deque<KeptBlock> waiting_;
    bool ended_ = false, whole_ = false;
    std::exception_ptr failure_;
    std::condition_variable changed_;
    std::thread thread_;
};

}  // namespace slideway
