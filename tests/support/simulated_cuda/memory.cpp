// Memory of cards and of the host, and who may touch it when.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>

#include "tests/support/simulated_cuda/simulation.hpp"

namespace slideway::simulated_cuda {

namespace {

constexpr std::size_t alignment = 256;  // [B], of a card's memory
// Pages stay unused until somebody writes them: a card's memory may be larger than the machine's.
constexpr std::size_t most_spoiled = std::size_t(16) << 20;  // [B], at each end of an allocation
constexpr int garbage = 0xff;                                // NaN, and counts beyond all bounds

struct Allocation {
    std::size_t bytes = 0;
    std::byte* pages = nullptr;
    std::size_t page_bytes = 0;  // without the page behind, which is never accessible
    int device = any_device;     // of memory of the host
};

struct Device {
    std::size_t used = 0;  // [B]
    int operations = 0;    // that touch its memory now
};

using Allocations = std::map<std::byte*, Allocation>;

struct Memory {
    std::mutex mutex;
    Allocations of_cards, pinned;
    std::map<int, Device> devices;
    std::condition_variable quiet;  // no operation touches some card's memory any more
};

Memory& memory() {
    static auto& m = *new Memory;
    return m;
}

std::size_t rounded_up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

Allocation const* find(Allocations const& all, void const* address, std::size_t bytes) {
    auto* const first = const_cast<std::byte*>(static_cast<std::byte const*>(address));
    auto const next = all.upper_bound(first);
    if (next == all.begin()) return nullptr;
    auto const& [begin, allocation] = *std::prev(next);
    auto const offset = static_cast<std::size_t>(first - begin);
    return offset <= allocation.bytes && bytes <= allocation.bytes - offset ? &allocation : nullptr;
}

void spoil(std::byte* begin, std::size_t bytes) {
    std::size_t const part = std::min(bytes, most_spoiled);
    std::memset(begin, garbage, part);
    std::memset(begin + bytes - part, garbage, part);
}

void permit(Allocation const& a, bool access) {
    if (mprotect(a.pages, a.page_bytes, access ? PROT_READ | PROT_WRITE : PROT_NONE) != 0) {
        misuse("mprotect failed: the machine lacks memory");
    }
}

void permit_all(int device, bool access) {
    for (auto const& [begin, a] : memory().of_cards) {
        if (a.device == device) permit(a, access);
    }
}

/// Ends where its last page ends, so that the first write behind it is a fault.
cudaError_t allocate(void** address, std::size_t bytes) {
    *address = nullptr;
    if (bytes == 0) return cudaSuccess;
    int const id = current_device();
    auto const page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    std::lock_guard const lock(memory().mutex);
    Device& device = memory().devices[id];
    if (bytes > settings().memory || rounded_up(bytes, alignment) > settings().memory - device.used) {
        return cudaErrorMemoryAllocation;
    }
    std::size_t const size = rounded_up(bytes, alignment), page_bytes = rounded_up(size, page);
    int const flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    void* const pages = mmap(nullptr, page_bytes + page, PROT_NONE, flags, -1, 0);
    if (pages == MAP_FAILED) return cudaErrorMemoryAllocation;
    Allocation const a{bytes, static_cast<std::byte*>(pages), page_bytes, id};
    std::byte* const begin = a.pages + page_bytes - size;
    permit(a, true);
    spoil(begin, bytes);
    permit(a, device.operations > 0);
    device.used += size;
    memory().of_cards.emplace(begin, a);
    *address = begin;
    return cudaSuccess;
}

cudaError_t release(void* address) {
    finish_work();  // as a card does
    std::lock_guard const lock(memory().mutex);
    auto const node = memory().of_cards.extract(static_cast<std::byte*>(address));
    if (node.empty()) misuse("cudaFree of what cudaMalloc did not return, or a second one");
    Allocation const& a = node.mapped();
    memory().devices[a.device].used -= rounded_up(a.bytes, alignment);
    munmap(a.pages, a.page_bytes + static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
    return cudaSuccess;
}

/// The memory of a card that one side of a copy must be, or pinned memory of the host.
void check_side(char const* side, bool is_on_card, void const* address, std::size_t bytes) {
    if (is_on_card ? is_device_memory(address, bytes, any_device) : is_pinned_memory(address, bytes)) return;
    std::string const wanted = is_on_card ? "memory of a card" : "pinned memory of the host";
    misuse("a copy of " + std::to_string(bytes) + " bytes: its " + side + " does not lie within " + wanted);
}

void copy(void* to, void const* from, std::size_t bytes, int device) {
    Access const access(device);
    std::memcpy(to, from, bytes);
}

void tell_leaks(char const* kind, Allocations const& all) {
    std::size_t bytes = 0;
    for (auto const& [begin, a] : all) bytes += a.bytes;
    if (!all.empty()) std::fprintf(stderr, "simulated CUDA: %zu %s, %zu bytes, not freed\n", all.size(), kind, bytes);
}

}  // namespace

bool is_device_memory(void const* address, std::size_t bytes, int device) {
    std::lock_guard const lock(memory().mutex);
    Allocation const* const a = find(memory().of_cards, address, bytes);
    return a != nullptr && (device == any_device || a->device == device);
}

bool is_pinned_memory(void const* address, std::size_t bytes) {
    std::lock_guard const lock(memory().mutex);
    return find(memory().pinned, address, bytes) != nullptr;
}

int device_of(void const* address) {
    std::lock_guard const lock(memory().mutex);
    return find(memory().of_cards, address, 0)->device;
}

void spoil_device(int device) {
    std::unique_lock lock(memory().mutex);
    // A real card ends all its kernels; here they would follow what is written below.
    memory().quiet.wait(lock, [device] { return memory().devices[device].operations == 0; });
    permit_all(device, true);
    for (auto const& [begin, a] : memory().of_cards) {
        if (a.device == device) spoil(begin, a.bytes);
    }
    permit_all(device, false);
}

void tell_memory_leaks() {
    std::lock_guard const lock(memory().mutex);
    tell_leaks("device allocations", memory().of_cards);
    tell_leaks("pinned allocations", memory().pinned);
}

Access::Access(int device) : device_(device) {
    std::lock_guard const lock(memory().mutex);
    if (memory().devices[device_].operations++ == 0) permit_all(device_, true);
}

Access::~Access() {
    std::lock_guard const lock(memory().mutex);
    if (--memory().devices[device_].operations > 0) return;
    permit_all(device_, false);
    memory().quiet.notify_all();
}

}  // namespace slideway::simulated_cuda

using namespace slideway::simulated_cuda;

cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total) {
    return call("cudaMemGetInfo", [&] {
        std::lock_guard const lock(memory().mutex);
        *total = settings().memory;
        *free = *total - memory().devices[current_device()].used;
        return cudaSuccess;
    });
}

cudaError_t cudaMalloc(void** address, std::size_t bytes) {
    return call("cudaMalloc", [&] { return allocate(address, bytes); });
}

cudaError_t cudaFree(void* address) {
    return give_back("cudaFree", [&] { return address == nullptr ? cudaSuccess : release(address); });
}

// The allocator's own memory, so that a sanitizer sees where it ends.
cudaError_t cudaHostAlloc(void** address, std::size_t bytes, unsigned) {
    return call("cudaHostAlloc", [&] {
        *address = nullptr;
        if (bytes == 0) return cudaSuccess;
        if (posix_memalign(address, 4096, bytes) != 0) return cudaErrorMemoryAllocation;
        spoil(static_cast<std::byte*>(*address), bytes);
        std::lock_guard const lock(memory().mutex);
        memory().pinned.emplace(static_cast<std::byte*>(*address), Allocation{bytes});
        return cudaSuccess;
    });
}

cudaError_t cudaFreeHost(void* address) {
    return give_back("cudaFreeHost", [&] {
        if (address == nullptr) return cudaSuccess;
        finish_work();
        std::lock_guard const lock(memory().mutex);
        if (memory().pinned.erase(static_cast<std::byte*>(address)) == 0) {
            misuse("cudaFreeHost of what cudaHostAlloc did not return, or a second one");
        }
        std::free(address);
        return cudaSuccess;
    });
}

cudaError_t cudaMemcpyAsync(void* to, void const* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t handle) {
    return call("cudaMemcpyAsync", [&] {
        if (kind != cudaMemcpyHostToDevice && kind != cudaMemcpyDeviceToHost)
            misuse("copies of this kind are not simulated");
        bool const upwards = kind == cudaMemcpyHostToDevice;
        check_side("source", !upwards, from, bytes);
        check_side("target", upwards, to, bytes);
        int const device = device_of(upwards ? to : from);
        return enqueue(handle, any_device, [=] { copy(to, from, bytes, device); });
    });
}
