#include "host/store/shard_writer.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"

namespace slideway {
namespace {

KeptBlock kept(BlockResult const& block) {
    auto const of = [](auto values) { return std::vector(values.begin(), values.end()); };
    return [members = of(block.members), inputs = of(block.inputs), records = of(block.records), states = of(block.final_states),
            quantities = of(block.quantities), series = of(block.series), sections = of(block.sections), growths = of(block.growths), clock = of(block.clock)] {
        return BlockResult{members, inputs, records, states, quantities, series, sections, growths, clock};
    };
}

}  // namespace

void ShardStore::begin_manifest() {
    for (int number = 1; !manifest_; ++number) {
        std::string const path = in_folder(folder_, manifest_name(number));
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored)) continue;
        try {
            manifest_ = std::make_unique<LineFile>(path);
            sync_folder(folder_);
        } catch (FileError const&) {
            // Another rank may have been first.
            if (!manifest_ && std::filesystem::exists(path, ignored)) continue;
            throw;
        }
    }
}

Shard ShardStore::put_as(std::string name, MemberSet const& members, std::vector<std::byte> const& bytes) {
    Shard shard{std::move(name), bytes.size(), fnv1a(bytes), members};
    write_durably(in_folder(folder_, shard.name), bytes);
    begin_manifest();
    manifest_->append(manifest_line(shard));
    return shard;
}

void ShardStore::put(MemberSet const& members, std::vector<std::byte> const& bytes) {
    // Shards of a generation have no member in common, so the first one names it.
    auto const first = [](MemberSet const& of) { return of.ranges().front().first; };
    if (!join_) {
        put_as(fmt::format("{}{:010}.nc", shard_names::members, first(members)), members, bytes);
        return;
    }
    auto const name = [&](MemberSet const& of, std::size_t generation) {
        return fmt::format("{}{:010}-{}.bin", shard_names::statistics, first(of), generation);
    };
    if (generations_.empty()) generations_.emplace_back();
    generations_[0].push_back(put_as(name(members, 0), members, bytes));
    for (std::size_t g = 0; generations_[g].size() == shards_joined; ++g) {
        std::vector<Shard> const parts = std::move(generations_[g]);
        generations_[g].clear();
        if (generations_.size() == g + 1) generations_.emplace_back();
        MemberSet const all = members_of(parts);
        generations_[g + 1].push_back(put_as(name(all, g + 1), all, join_(folder_, parts)));
        for (Shard const& part : parts) remove_file(in_folder(folder_, part.name));
    }
}

ShardWriter::ShardWriter(std::string folder, std::function<ShardImage(BlockResult const&)> form, ShardJoin join, ShortRun* brief)
    : form_(std::move(form)), store_(std::move(folder), std::move(join)), brief_(brief), thread_([this] { put_all(); }) {}

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
    KeptBlock copy = kept(block);  // the room is still there: only this thread takes it
    {
        std::lock_guard const lock(mutex_);
        if (failure_) std::rethrow_exception(failure_);
        waiting_.push_back(std::move(copy));
    }
    changed_.notify_all();
}

void ShardWriter::finish(bool whole) {
    {
        std::lock_guard const lock(mutex_);
        whole_ = whole;
    }
    stop();
    if (failure_) std::rethrow_exception(failure_);
}

/// Waits until a short run has ended, with its block put into `brief_`, or is none.
bool ShardWriter::stays_short(std::unique_lock<std::mutex>& lock) {
    if (brief_ == nullptr) return false;
    changed_.wait_for(lock, ShortRun::longest, [this] { return ended_ || waiting_.size() > 1; });
    if (!whole_ || waiting_.size() != 1) return false;
    brief_->block = std::move(waiting_.front());
    return true;
}

void ShardWriter::put_all() {
    std::unique_lock lock(mutex_);
    if (stays_short(lock)) return;
    try {
        if (brief_ != nullptr) {
            lock.unlock();
            brief_->claim();
            lock.lock();
        }
        for (;;) {
            changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            put_next(lock);
        }
    } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        failure_ = std::current_exception();
        waiting_.clear();
        changed_.notify_all();
    }
}

void ShardWriter::put_next(std::unique_lock<std::mutex>& lock) {
    KeptBlock block = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    ShardImage const image = form_(block());
    block = {};
    if (!image.members.empty()) store_.put(image.members, image.bytes);
    lock.lock();
}

}  // namespace slideway
