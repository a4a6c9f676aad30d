#include "host/base/memory_room.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>

#include <sys/resource.h>
#include <unistd.h>

namespace slideway {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t soft_limit(decltype(RLIMIT_AS) what) {
    rlimit limit{};
    return getrlimit(what, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

}  // namespace

std::uint64_t mapped_bytes() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_room() {
    std::uint64_t const limit = soft_limit(RLIMIT_AS);
    return limit == unlimited ? unlimited : limit - std::min(limit, mapped_bytes());
}

std::uint64_t bytes_of_threads(int threads) {
    constexpr std::uint64_t least_stack = 2 << 20, most_stack = 64 << 20, beside = 16 << 20;
    std::uint64_t const stack = soft_limit(RLIMIT_STACK);
    return static_cast<std::uint64_t>(threads) * (beside + (stack == unlimited ? least_stack : std::min(stack, most_stack)));
}

void require_memory(std::uint64_t bytes) {
    if (memory_room() < bytes) throw std::bad_alloc();
}

}  // namespace slideway
