#include "host/run/member_queue.hpp"

#include <algorithm>

namespace slideway {

Stretch LocalQueue::take(std::uint64_t wanted, std::uint64_t) {
    std::lock_guard const lock(mutex_);
    Stretch const stretch{taken_, std::min(wanted, places_ - taken_)};
    taken_ += stretch.count;
    return stretch;
}

void LocalQueue::abandon() {
    std::lock_guard const lock(mutex_);
    taken_ = places_;
}

std::uint64_t LocalQueue::left() const {
    std::lock_guard const lock(mutex_);
    return places_ - taken_;
}

}  // namespace slideway
