// Who works on which part of a run: threads and ranks take stretches of it until none is left.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

namespace slideway {

/// Places [first, first + count) among the members of a run.
struct Stretch {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

/// From any thread.
class MemberQueue {
public:
    virtual ~MemberQueue() = default;
    /// The next places, `wanted` (> 0) of them at most; none when all are taken or the run was abandoned.
    /// @param finished members that the caller finished since its last call; for the progress of all.
    virtual Stretch take(std::uint64_t wanted, std::uint64_t finished) = 0;
    /// Nobody, on no rank, gets another place.
    virtual void abandon() = 0;
    /// Places that nobody has taken, as far as is known here.
    virtual std::uint64_t left() const = 0;
};

/// The queue of a single process.
class LocalQueue final : public MemberQueue {
public:
    explicit LocalQueue(std::uint64_t places) : places_(places) {}
    Stretch take(std::uint64_t wanted, std::uint64_t) override {
        std::lock_guard const lock(mutex_);
        Stretch const stretch{taken_, std::min(wanted, places_ - taken_)};
        taken_ += stretch.count;
        return stretch;
    }
    void abandon() override {
        std::lock_guard const lock(mutex_);
        taken_ = places_;
    }
    std::uint64_t left() const override {
        std::lock_guard const lock(mutex_);
        return places_ - taken_;
    }

private:
    mutable std::mutex mutex_;
    std::uint64_t places_, taken_ = 0;
};

}  // namespace slideway
