#include "host/backend/cuda_stream.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "host/backend/block_image.hpp"
#include "host/backend/cuda_kernels.hpp"

namespace slideway {

CudaStream::CudaStream(CudaCard const& card) : card_(card) {
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
CudaStream::~CudaStream() {
    if (stop_) const_cast<int volatile&>(*stop_) = 1;
    cudaStreamSynchronize(stream_.get());
}

void CudaStream::run(void const* kernel, Parts const& parts, std::size_t most_threads, Block& block) {
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
        if (block.stop != nullptr && block.stop(block.stop_context, 0)) stop = 1;
    }
    read_results(host_.get(), block);
}

void CudaStream::reserve(std::size_t bytes) {
    if (bytes <= room_) return;
    room_ = 0;
    device_.reset();
    host_.reset();
    void* memory = nullptr;
    card_.require(cudaMalloc(&memory, bytes), "allocating " + amount_text(bytes));
    device_.reset(static_cast<std::byte*>(memory));
    card_.require(cudaHostAlloc(&memory, bytes, cudaHostAllocDefault), "pinning " + amount_text(bytes));
    host_.reset(static_cast<std::byte*>(memory));
    room_ = bytes;
}

/// Asks after a while, so that the worker leaves its core to those that draw members or put results down.
bool CudaStream::has_ended() const {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    cudaError_t const state = cudaEventQuery(done_.get());
    if (state == cudaErrorNotReady) return false;
    card_.require(state, "integrating a block");
    return true;
}

}  // namespace slideway
