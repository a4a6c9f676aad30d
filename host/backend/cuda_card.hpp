// A card before it has work: what it is, and what its runtime's calls come to.
#pragma once

#include <cstdint>
#include <string>

#include <cuda_runtime_api.h>

#include "host/backend/backend.hpp"

namespace slideway {

struct CudaCard {
    int number = 0;
    std::string name;  // "NVIDIA H100 80GB HBM3"
    std::string isa;   // "sm_90"
    int multiprocessors = 1;
    int threads_per_multiprocessor = 1;
    double clock = 1e9;         // [1/s]
    int double_units = 32;      // of a multiprocessor
    bool has_watchdog = false;  // the driver ends kernels that last
    int sharers = 1;            // processes that take this card

    double peak() const { return 2 * clock * multiprocessors * double_units; }

    /// Makes it the card of the calling thread.
    void bind() const;
    /// Bytes that this process may use.
    std::uint64_t free_memory() const;
    /// @param what was tried: "allocating 3.2 GB"  @throws DeviceError if it failed
    void require(cudaError_t error, std::string const& what) const;
};

/// @throws NoDevice, DeviceError
CudaCard find_card(CardShare const& share);

/// "1.31 kB", "320 MB", "79.2 GB"
std::string amount_text(std::uint64_t bytes);

}  // namespace slideway
