#include "host/store/shard_writer.hpp"

#include <optional>
#include <utility>

namespace slideway {

ShardWriter::ShardWriter(std::string folder, std::function<ShardImage(BlockResult const&)> form, ShardJoin join)
    : form_(std::move(form)), store_(std::move(folder), std::move(join)), thread_([this] { put_all(); }) {}

ShardWriter::~ShardWriter() { stop(); }

void ShardWriter::stop() {
    if (!thread_.joinable()) return;
    {
        std::lock_guard const lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void ShardWriter::write(BlockResult const& block) {
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return failure_ || waiting_.size() < most_waiting; });
        if (failure_) std::rethrow_exception(failure_);
    }
    BlockCopy copy(block);  // the room is still there: only this thread takes it
    {
        std::lock_guard const lock(mutex_);
        if (failure_) std::rethrow_exception(failure_);
        waiting_.push_back(std::move(copy));
    }
    changed_.notify_all();
}

void ShardWriter::finish() {
    stop();
    if (failure_) std::rethrow_exception(failure_);
}

void ShardWriter::put_all() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        std::optional<BlockCopy> block(std::move(waiting_.front()));
        waiting_.pop_front();
        changed_.notify_all();
        lock.unlock();
        std::exception_ptr failure;
        try {
            ShardImage const image = form_(block->view());
            block.reset();
            if (!image.members.empty()) store_.put(image.members, image.bytes);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure) {
            failure_ = failure;
            waiting_.clear();
            changed_.notify_all();
            return;
        }
    }
}

}  // namespace slideway
