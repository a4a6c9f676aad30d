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
#include "host/output/shard_folder.hpp"
#include "host/output/shard_image.hpp"

namespace slideway {

/// A thread of its own waits for the disk; computing waits only where the disk is slower.
class ShardWriter {
public:
    ShardWriter(std::string folder, ResultLayout layout, Provenance provenance);
    /// Waits for what `write` was given; an error then has nobody to hear it: call `finish`.
    ~ShardWriter();
    ShardWriter(ShardWriter const&) = delete;
    ShardWriter& operator=(ShardWriter const&) = delete;

    /// Takes a copy of the members that have ended.  One call at a time.  @throws FileError, also of an earlier block.
    void write(BlockResult const& block, StudyValues const& study);
    /// Waits until everything is on the disk.  @throws FileError
    void finish();

private:
    void put_all();
    void stop();

    std::string const folder_;
    ResultLayout const layout_;
    Provenance const provenance_;
    ShardStore store_;  // the thread's
    std::mutex mutex_;  // guards the three below
    std::deque<ShardImage> waiting_;
    bool ended_ = false;
    std::exception_ptr failure_;
    std::condition_variable changed_;
    std::thread thread_;
};

}  // namespace slideway
