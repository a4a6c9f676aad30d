// A CUDA runtime without a card: the module for cards, linked with this in place of libcudart, runs the host's side of a CUDA backend for
// true, and threads of the processor take the part of the card.  It is stricter than a card: a misuse that a card lets pass, or takes
// time to punish, ends the program with a line.  What the environment says:
//
// SIMULATED_CUDA_DEVICES          cards; 1 without it; 0: none is found; -1: the driver is too old
// SIMULATED_CUDA_ARCH             their compute capability, 90 without it
// SIMULATED_CUDA_MULTIPROCESSORS  of each card, 4 without it
// SIMULATED_CUDA_MEMORY           of each card [B], 1 GiB without it
// SIMULATED_CUDA_DELAY            most time that the start of an operation in a stream is put off [µs], 0 without it
// SIMULATED_CUDA_FAIL             <function>:<n>[:<code>]: its n-th call, from 1, returns the code (cudaErrorUnknown without it).
//                                 `kernel` is no function but the run of a kernel: from the n-th on the card is lost
// SIMULATED_CUDA_COUNTS           a file, written at exit: a line per function and for `kernel`, name and calls
// SIMULATED_CUDA_WATCHDOG         1: kernels are said to be ended when they last
// SIMULATED_CUDA_LEAKS            1: at exit a line per kind of what was not given back
#pragma once

#include <cuda_runtime_api.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace slideway {
struct GridTask;
}

namespace slideway::simulated_cuda {

struct Settings {
    int devices = 1;
    int watchdog = 0;
    int architecture = 90;
    int multiprocessors = 4;
    std::size_t memory = std::size_t(1) << 30;  // [B]
    std::uint64_t delay = 0;                    // [µs]
    std::string counts;
    bool tells_leaks = false;
};
Settings const& settings();

/// Ends the program: its own fault, not one of a card.
[[noreturn]] void misuse(std::string const& what);

// ---- faults.cpp: what calls return ----

/// Counts a call, or the run of a kernel.  @return the code that it is told to fail with
cudaError_t count(char const* function);
/// What every call returns as there is no card, or as the card is lost.
cudaError_t card_error();
/// From now on the card is of no use.
void lose_card(cudaError_t code);
/// Keeps a failure for cudaGetLastError.  @return it
cudaError_t keep(cudaError_t code);

/// A call of the runtime.
template <class Body> cudaError_t call(char const* function, Body const& body) {
    cudaError_t code = count(function);
    if (code == cudaSuccess) code = card_error();
    if (code == cudaSuccess) code = body();
    return keep(code);
}

/// A call that gives something back.  That is done in any case, so that only what is never given back is a leak.
template <class Body> cudaError_t give_back(char const* function, Body const& body) {
    cudaError_t const told = count(function), card = card_error(), done = body();
    return keep(told != cudaSuccess ? told : card != cudaSuccess ? card : done);
}

// ---- device.cpp ----

/// Threads of a block at most, by the registers that a kernel takes.
inline constexpr int most_block_threads = 256;
inline constexpr int any_device = -1;
/// Of the calling thread; each starts with the first card.
int current_device();

// ---- memory.cpp ----

/// Whether bytes of the memory of a card lie within one allocation of a card; its end does for none.
bool is_device_memory(void const* address, std::size_t bytes, int device);
bool is_pinned_memory(void const* address, std::size_t bytes);
/// The card whose memory that is; it must be some.
int device_of(void const* address);
/// Fills memory of a card with what nobody can take for a result.
void spoil_device(int device);
void tell_memory_leaks();

/// While it lives, the memory of a card may be touched; at other times that is a segmentation fault.
class Access {
public:
    explicit Access(int device);
    ~Access();
    Access(Access const&) = delete;
    Access& operator=(Access const&) = delete;

private:
    int device_;
};

// ---- streams.cpp ----

/// Puts an operation at the end of a stream, which must be one of the device.
cudaError_t enqueue(cudaStream_t stream, int device, std::function<void()> operation);
/// Until all is done that streams hold now.
void finish_work();
void tell_stream_leaks();

// ---- grid.cpp ----

/// Ends the program unless all that the task points to is memory that the card sees.
void check_task(GridTask const& task, int device);
/// What the threads of a grid do.
void run_grid(GridTask task, bool shadowed, std::uint64_t threads);

}  // namespace slideway::simulated_cuda
