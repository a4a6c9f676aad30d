#include "host/output/shard_writer.hpp"

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
    ShardImage image = form_(block);
    if (image.members.empty()) return;
    // Few may wait: what does is lost with the process.
    constexpr std::size_t most_waiting = 2;
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return failure_ || waiting_.size() < most_waiting; });
        if (failure_) std::rethrow_exception(failure_);
        waiting_.push_back(std::move(image));
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
        ShardImage const image = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        std::exception_ptr failure;
        try {
            store_.put(image.members, image.bytes);
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
        changed_.notify_all();
    }
}

}  // namespace slideway
