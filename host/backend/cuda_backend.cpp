// Cards that CUDA knows: memory, streams and launches of the kernels in cuda.cu.
//
// Every worker of a run that integrates a block does so on a stream of its own: while one block's results travel back or are put
// down, another's members are integrated.
#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>
#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/backend/block_image.hpp"
#include "host/backend/cuda_kernels.hpp"

namespace slideway {
namespace {

std::string bytes_text(std::uint64_t bytes) {
    auto const amount = static_cast<double>(bytes);
    if (amount < 1e6) return fmt::format("{:.3g} kB", amount / 1e3);
    return amount < 1e9 ? fmt::format("{:.3g} MB", amount / 1e6) : fmt::format("{:.3g} GB", amount / 1e9);
}

/// The kernels that hold the equations of a scene's parts.
CudaKernels kernels_of(Parts const& parts) {
    bool const impacts = parts.damping == Damping::restitution;
    if (parts.law == Law::paper) return impacts ? paper_impact_kernels() : paper_kernels();
    return impacts ? conservative_impact_kernels() : conservative_kernels();
}

/// Units of a multiprocessor for double precision, from the throughputs that the CUDA programming guide lists by compute capability:
/// 32 or 64 in cards of data centres, few in others.
int double_units(int major, int minor) {
    if (major == 9 || (major == 10 && minor == 0)) return 64;
    if (minor == 0 && major >= 6 && major <= 8) return 32;
    return 2;
}

/// What is known of a card before it has work.
struct Card {
    int number = 0;
    std::string name;  // "NVIDIA H100 80GB HBM3"
    std::string isa;   // "sm_90"
    int multiprocessors = 1;
    int threads_per_multiprocessor = 1;
    double clock = 1e9;     // [1/s]
    int double_units = 32;  // of a multiprocessor

    double peak() const { return 2 * clock * multiprocessors * double_units; }

    /// @param what was tried: "allocating 3.2 GB"  @throws DeviceError if it failed
    void require(cudaError_t error, std::string const& what) const {
        if (error == cudaSuccess) return;
        cudaGetLastError();  // or a later launch would report it, unless the card is lost anyway
        throw DeviceError(fmt::format("cuda: {}: {} failed: {} ({})", name, what, cudaGetErrorString(error),
                                      cudaGetErrorName(error)));
    }
};

// Whoever frees cannot be helped if that fails: the first failing call has told why.
struct FreeDevice {
    void operator()(std::byte* memory) const { cudaFree(memory); }
};
struct FreePinned {
    void operator()(void* memory) const { cudaFreeHost(memory); }
};
struct EndStream {
    void operator()(cudaStream_t stream) const { cudaStreamDestroy(stream); }
};
struct EndEvent {
    void operator()(cudaEvent_t event) const { cudaEventDestroy(event); }
};

/// A stream of a card, with room for a block on both sides.  Used by one thread at a time.
class Stream {
public:
    explicit Stream(Card const& card) : card_(card) {
        cudaStream_t stream = nullptr;
        card_.require(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "making a stream");
        stream_.reset(stream);
        cudaEvent_t event = nullptr;
        card_.require(cudaEventCreateWithFlags(&event, cudaEventDisableTiming), "making an event");
        done_.reset(event);
        void* flag = nullptr;
        card_.require(cudaHostAlloc(&flag, sizeof(int), cudaHostAllocMapped), "pinning memory");
        stop_.reset(static_cast<int*>(flag));
    }

    /// A call that failed may have left a kernel at work, and copies of memory that is given back here.
    ~Stream() {
        if (stop_) const_cast<int volatile&>(*stop_) = 1;
        cudaStreamSynchronize(stream_.get());
    }
    Stream(Stream const&) = delete;

    void run(void const* kernel, Parts const& parts, std::size_t most_threads, Block& block) {
        ImageSize const size = image_size(block);
        reserve(size.total);
        write_image(block, host_.get());
        int volatile& stop = *stop_;
        stop = 0;
        GridTask task = task_in(block, parts, device_.get());
        task.block.stop_flag = stop_.get();
        auto const threads = std::min(block.members, most_threads);
        auto const blocks = static_cast<unsigned>((threads + threads_per_block - 1) / threads_per_block);
        std::byte* const results = host_.get() + size.results_at;
        card_.require(cudaMemcpyAsync(device_.get(), host_.get(), size.total, cudaMemcpyHostToDevice, stream_.get()),
                      "sending a block");
        void* arguments[] = {&task};
        card_.require(cudaLaunchKernel(kernel, dim3(blocks), dim3(threads_per_block), arguments, 0, stream_.get()),
                      "starting a kernel");
        card_.require(cudaMemcpyAsync(results, device_.get() + size.results_at, size.total - size.results_at,
                                      cudaMemcpyDeviceToHost, stream_.get()),
                      "fetching a block");
        card_.require(cudaEventRecord(done_.get(), stream_.get()), "marking the end of a block");
        while (!has_ended()) {
            if (block.stop != nullptr && block.stop(block.stop_context)) stop = 1;
        }
        read_results(host_.get(), block);
    }

private:
    void reserve(std::size_t bytes) {
        if (bytes <= room_) return;
        room_ = 0;
        device_.reset();
        host_.reset();
        void* memory = nullptr;
        card_.require(cudaMalloc(&memory, bytes), "allocating " + bytes_text(bytes));
        device_.reset(static_cast<std::byte*>(memory));
        card_.require(cudaHostAlloc(&memory, bytes, cudaHostAllocDefault), "pinning " + bytes_text(bytes));
        host_.reset(static_cast<std::byte*>(memory));
        room_ = bytes;
    }

    /// Asks after a while, so that the worker leaves its core to those that draw members or put results down.
    bool has_ended() const {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        cudaError_t const state = cudaEventQuery(done_.get());
        if (state == cudaErrorNotReady) return false;
        card_.require(state, "integrating a block");
        return true;
    }

    Card const& card_;
    std::unique_ptr<CUstream_st, EndStream> stream_;
    std::unique_ptr<CUevent_st, EndEvent> done_;
    std::unique_ptr<int, FreePinned> stop_;  // the host writes it, the threads read it
    std::unique_ptr<std::byte, FreeDevice> device_;
    std::unique_ptr<std::byte, FreePinned> host_;
    std::size_t room_ = 0;
};

class CudaBackend final : public Backend, public std::enable_shared_from_this<CudaBackend> {
public:
    explicit CudaBackend(Card card) : card_(std::move(card)) {
        bind();
        for (CudaKernels const& kernels :
             {paper_kernels(), paper_impact_kernels(), conservative_kernels(), conservative_impact_kernels()}) {
            for (void const* const kernel : {kernels.members, kernels.shadowed}) load(kernel);
        }
    }

    std::string_view name() const override { return "cuda"; }
    std::string isa() const override { return card_.isa + SLIDEWAY_CUDA_ARITHMETIC; }
    std::string machine() const override { return card_.name; }
    std::string flags() const override { return SLIDEWAY_CUDA_FLAGS; }
    std::size_t lanes() const override { return 32; }
    std::size_t least_block() const override { return threads(kernels_of({}).members); }

    std::size_t largest_block(std::uint64_t bytes_per_member, int workers, std::size_t asked) const override {
        bind();
        std::size_t free = 0, total = 0;
        card_.require(cudaMemGetInfo(&free, &total), "asking for its memory");
        std::size_t const stacks = reserved_bytes();
        std::size_t const usable = free > stacks ? (free - stacks) / 10 * 9 : 0;
        std::size_t const share = usable / static_cast<std::size_t>(workers);
        if (share < bytes_per_member) {
            throw DeviceError(
                fmt::format("cuda: {} has {} free, and the threads' stacks take {}: no room for a member of {} for "
                            "each of {} workers; ask for "
                            "fewer samples or sections, use fewer --threads, or --backend cpu",
                            card_.name, bytes_text(free), bytes_text(stacks), bytes_text(bytes_per_member), workers));
        }
        std::size_t const room = share / bytes_per_member;
        if (asked > room) {
            throw DeviceError(fmt::format(
                "cuda: {} has {} free: room for blocks of {} members for each of {} workers, not of {}; use a "
                "smaller --block-members or fewer --threads",
                card_.name, bytes_text(free), room, workers, asked));
        }
        // Larger blocks would not fill the card better, and a process that is killed loses those in work.
        return asked > 0 ? asked : std::min(room, 4 * least_block());
    }

    /// The threads' stacks, of as many threads as could be resident if they needed few registers.
    std::uint64_t reserved_bytes() const override {
        return stack_ * static_cast<std::uint64_t>(card_.threads_per_multiprocessor) *
               static_cast<std::uint64_t>(card_.multiprocessors);
    }

    /// As if a step took 10,000 operations and the card ran at a twentieth of its peak.
    double seconds_per_step(double members, int) const override {
        double const filled = std::min(1.0, members / static_cast<double>(least_block()));
        return 10'000 / (card_.peak() / 20) / filled;
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        CudaKernels const kernels = kernels_of(parts);
        void const* const kernel = shadows ? kernels.shadowed : kernels.members;
        return [card = shared_from_this(), kernel, parts, most = threads(kernel)](Block& block) {
            card->run(kernel, parts, most, block);
        };
    }

    double peak() const override { return card_.peak(); }

private:
    void run(void const* kernel, Parts const& parts, std::size_t most_threads, Block& block) const {
        if (block.members == 0) return;  // no grid has no threads
        bind();
        std::unique_ptr<Stream> stream = free_stream();
        stream->run(kernel, parts, most_threads, block);
        std::lock_guard const lock(mutex_);
        streams_.push_back(std::move(stream));
    }

    /// Sees that the card can run a kernel, and what stack a thread of it needs.
    void load(void const* kernel) {
        cudaFuncAttributes attributes{};
        cudaError_t const found = cudaFuncGetAttributes(&attributes, kernel);
        if (found == cudaErrorNoKernelImageForDevice || found == cudaErrorInvalidDeviceFunction) {
            cudaGetLastError();
            throw DeviceError(
                fmt::format("cuda: {} is of {}, and this build has kernels for {}; build with "
                            "-DCMAKE_CUDA_ARCHITECTURES={}, or use --backend cpu",
                            card_.name, card_.isa, SLIDEWAY_CUDA_TARGETS, card_.isa.substr(3)));
        }
        card_.require(found, "loading a kernel");
        stack_ = std::max<std::size_t>(stack_, attributes.localSizeBytes);
    }

    /// Each thread has its own current card.
    void bind() const { card_.require(cudaSetDevice(card_.number), "taking the card"); }

    /// Threads of a kernel that are resident at once.
    std::size_t threads(void const* kernel) const {
        bind();
        int blocks = 0;
        card_.require(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, threads_per_block, 0),
                      "asking for the kernel's occupancy");
        return static_cast<std::size_t>(std::max(blocks, 1) * card_.multiprocessors * threads_per_block);
    }

    std::unique_ptr<Stream> free_stream() const {
        {
            std::lock_guard const lock(mutex_);
            if (!streams_.empty()) {
                auto stream = std::move(streams_.back());
                streams_.pop_back();
                return stream;
            }
        }
        return std::make_unique<Stream>(card_);
    }

    Card const card_;
    std::size_t stack_ = 0;  // of a thread [B]
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<Stream>> streams_;  // at rest
};

}  // namespace

bool has_cuda() { return true; }

std::shared_ptr<Backend const> cuda_backend(int rank) {
    // Without any driver the runtime would say that it is too old.
    int driver = 0, count = 0;
    if (cudaDriverGetVersion(&driver) == cudaSuccess && driver == 0)
        throw NoDevice("cuda: there is no driver, and so no card");
    cudaError_t const error = cudaGetDeviceCount(&count);
    if (error != cudaSuccess) cudaGetLastError();
    if (error == cudaErrorNoDevice || (error == cudaSuccess && count == 0)) throw NoDevice("cuda: there is no card");
    if (error != cudaSuccess) {
        throw DeviceError(
            fmt::format("cuda: no card can be used: {} ({})", cudaGetErrorString(error), cudaGetErrorName(error)));
    }
    Card card;
    card.number = rank % count;
    card.name = fmt::format("card {}", card.number);
    cudaDeviceProp properties{};
    card.require(cudaGetDeviceProperties(&properties, card.number), "asking what it is");
    card.name = properties.name;
    card.isa = fmt::format("sm_{}{}", properties.major, properties.minor);
    card.double_units = double_units(properties.major, properties.minor);
    card.multiprocessors = properties.multiProcessorCount;
    card.threads_per_multiprocessor = properties.maxThreadsPerMultiProcessor;
    int kilohertz = 0;
    card.require(cudaDeviceGetAttribute(&kilohertz, cudaDevAttrClockRate, card.number), "asking for its clock");
    card.clock = 1e3 * kilohertz;
    return std::make_shared<CudaBackend>(std::move(card));
}

}  // namespace slideway
