// Blocks on their way to a card and back.
#pragma once

#include <cstddef>
#include <memory>

#include <cuda_runtime_api.h>

#include "host/backend/cuda_card.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// A stream of a card, with room for a block on both sides.  Used by one thread at a time, whose card that is.
class CudaStream {
public:
    explicit CudaStream(CudaCard const& card);
    ~CudaStream();
    CudaStream(CudaStream const&) = delete;

    /// Integrates a block to its end, or to the stop that it asks for.
    /// @param kernel a function of one GridTask  @param most_threads that are resident at once  @throws DeviceError
    void run(void const* kernel, Parts const& parts, std::size_t most_threads, Block& block);

private:
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

    void reserve(std::size_t bytes);
    bool has_ended() const;

    CudaCard const& card_;
    std::unique_ptr<CUstream_st, EndStream> stream_;
    std::unique_ptr<CUevent_st, EndEvent> done_;
    std::unique_ptr<int, FreePinned> stop_;  // the host writes it, the threads read it
    std::unique_ptr<std::byte, FreeDevice> device_;
    std::unique_ptr<std::byte, FreePinned> host_;
    std::size_t room_ = 0;
};

}  // namespace slideway
