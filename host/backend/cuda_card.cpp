#include "host/backend/cuda_card.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace slideway {
namespace {

/// Units of a multiprocessor for double precision, from the throughputs that the CUDA programming guide lists by compute capability:
/// 32 or 64 in cards of data centres, few in others.
int double_units(int major, int minor) {
    if (major == 9 || (major == 10 && minor == 0)) return 64;
    if (minor == 0 && major >= 6 && major <= 8) return 32;
    return 2;
}

int count_cards() {
    // Without any driver the runtime would say that it is too old.
    int driver = 0, count = 0;
    if (cudaDriverGetVersion(&driver) == cudaSuccess && driver == 0)
        throw NoDevice("cuda: there is no driver, and so no card; use --backend cpu");
    cudaError_t const error = cudaGetDeviceCount(&count);
    if (error == cudaErrorNoDevice || (error == cudaSuccess && count == 0))
        throw NoDevice("cuda: there is no card; use --backend cpu");
    if (error == cudaSuccess) return count;
    throw DeviceError(fmt::format("cuda: no card can be used: {} ({}); use --backend cpu", cudaGetErrorString(error),
                                  cudaGetErrorName(error)));
}

}  // namespace

void CudaCard::bind() const { require(cudaSetDevice(number), "taking the card"); }

std::uint64_t CudaCard::free_memory() const {
    std::size_t free = 0, total = 0;
    require(cudaMemGetInfo(&free, &total), "asking for its memory");
    return free / static_cast<std::size_t>(sharers);
}

void CudaCard::require(cudaError_t error, std::string const& what) const {
    if (error == cudaSuccess) return;
    throw DeviceError(
        fmt::format("cuda: {}: {} failed: {} ({})", name, what, cudaGetErrorString(error), cudaGetErrorName(error)));
}

CudaCard find_card(CardShare const& share) {
    int const count = count_cards();
    CudaCard card;
    card.number = share.rank % count;
    card.name = fmt::format("card {}", card.number);
    card.sharers = (share.ranks + count - 1) / count;
    cudaDeviceProp properties{};
    card.require(cudaGetDeviceProperties(&properties, card.number), "asking what it is");
    card.name = properties.name;
    card.isa = fmt::format("sm_{}{}", properties.major, properties.minor);
    card.double_units = double_units(properties.major, properties.minor);
    card.multiprocessors = properties.multiProcessorCount;
    card.threads_per_multiprocessor = properties.maxThreadsPerMultiProcessor;
    int kilohertz = 0, watchdog = 0;
    card.require(cudaDeviceGetAttribute(&kilohertz, cudaDevAttrClockRate, card.number), "asking for its clock");
    card.require(cudaDeviceGetAttribute(&watchdog, cudaDevAttrKernelExecTimeout, card.number),
                 "asking for its time limit");
    card.clock = 1e3 * std::max(kilohertz, 1'000);  // some drivers do not tell
    card.has_watchdog = watchdog != 0;
    return card;
}

std::string amount_text(std::uint64_t bytes) {
    auto const amount = static_cast<double>(bytes);
    if (amount < 1e6) return fmt::format("{:.3g} kB", amount / 1e3);
    return amount < 1e9 ? fmt::format("{:.3g} MB", amount / 1e6) : fmt::format("{:.3g} GB", amount / 1e9);
}

}  // namespace slideway
