// Brings finished blocks to the disk while the next ones are computed.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "host/driver/block_result.hpp"
#include "host/output/shard_image.hpp"
#include "host/output/shard_store.hpp"

namespace slideway {

/// A thread of its own waits for the disk; computing waits only where the disk is slower.
class ShardWriter {
public:
    /// @param form what a block becomes; of no members if none have ended.  @param join of the store; empty: shards
    /// stay as they are.
    ShardWriter(std::string folder, std::function<ShardImage(BlockResult const&)> form, ShardJoin join = {});
    /// Waits for what `write` was given; an error then has nobody to hear it: call `finish`.
    ~ShardWriter();
    ShardWriter(ShardWriter const&) = delete;
    ShardWriter& operator=(ShardWriter const&) = delete;

    /// Takes a copy of the members that have ended.  One call at a time.  @throws FileError, also of an earlier block.
    void write(BlockResult const& block);
    /// Waits until everything is on the disk.  @throws FileError
    void finish();

private:
    void put_all();
    void stop();

    std::function<ShardImage(BlockResult const&)> const form_;
    ShardStore store_;  // the thread's
    std::mutex mutex_;  // guards the three below
    std::deque<ShardImage> waiting_;
    bool ended_ = false;
    std::exception_ptr failure_;
    std::condition_variable changed_;
    std::thread thread_;
};

}  // namespace slideway
