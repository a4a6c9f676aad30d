// What a card says of itself.
#include <cstdio>
#include <utility>

#include "tests/support/simulated_cuda/simulation.hpp"

namespace slideway::simulated_cuda {

namespace {

thread_local int device_in_use = 0;

bool exists(int device) { return device >= 0 && device < settings().devices; }

cudaDeviceProp properties() {
    cudaDeviceProp p{};
    std::snprintf(p.name, sizeof p.name, "simulated GPU");
    p.totalGlobalMem = settings().memory;
    p.major = settings().architecture / 10;
    p.minor = settings().architecture % 10;
    p.multiProcessorCount = settings().multiprocessors;
    p.warpSize = 32;
    p.maxThreadsPerBlock = 1024;
    p.maxThreadsDim[0] = p.maxThreadsDim[1] = 1024;
    p.maxThreadsDim[2] = 64;
    p.maxGridSize[0] = 2147483647;
    p.maxGridSize[1] = p.maxGridSize[2] = 65535;
    p.maxThreadsPerMultiProcessor = 2048;
    p.maxBlocksPerMultiProcessor = 32;
    p.regsPerBlock = p.regsPerMultiprocessor = 65536;
    p.sharedMemPerBlock = 48 << 10;
    p.sharedMemPerMultiprocessor = 228 << 10;
    p.totalConstMem = 64 << 10;
    p.l2CacheSize = 50 << 20;
    p.memoryBusWidth = 5120;
    p.concurrentKernels = p.canMapHostMemory = p.unifiedAddressing = 1;
    p.asyncEngineCount = 3;
    return p;
}

}  // namespace

int current_device() { return device_in_use; }

}  // namespace slideway::simulated_cuda

using namespace slideway::simulated_cuda;

// Versions can be asked for without a card.
cudaError_t cudaDriverGetVersion(int* version) {
    *version = settings().devices < 0 ? CUDART_VERSION - 1000 : settings().devices == 0 ? 0 : CUDART_VERSION;
    return keep(count("cudaDriverGetVersion"));
}

cudaError_t cudaRuntimeGetVersion(int* version) {
    *version = CUDART_VERSION;
    return keep(count("cudaRuntimeGetVersion"));
}

cudaError_t cudaGetDeviceCount(int* devices) {
    *devices = 0;
    return call("cudaGetDeviceCount", [&] { return *devices = settings().devices, cudaSuccess; });
}

cudaError_t cudaSetDevice(int device) {
    return call("cudaSetDevice", [&] {
        if (!exists(device)) return cudaErrorInvalidDevice;
        device_in_use = device;
        return cudaSuccess;
    });
}

cudaError_t cudaGetDevice(int* device) {
    return call("cudaGetDevice", [&] { return *device = device_in_use, cudaSuccess; });
}

cudaError_t cudaGetDeviceProperties(cudaDeviceProp* out, int device) {
    return call("cudaGetDeviceProperties", [&] {
        if (!exists(device)) return cudaErrorInvalidDevice;
        *out = properties();
        return cudaSuccess;
    });
}

cudaError_t cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int device) {
    return call("cudaDeviceGetAttribute", [&] {
        if (!exists(device)) return cudaErrorInvalidDevice;
        cudaDeviceProp const p = properties();
        std::pair<cudaDeviceAttr, int> const known[] = {
            {cudaDevAttrComputeCapabilityMajor, p.major},
            {cudaDevAttrComputeCapabilityMinor, p.minor},
            {cudaDevAttrMultiProcessorCount, p.multiProcessorCount},
            {cudaDevAttrWarpSize, p.warpSize},
            {cudaDevAttrMaxThreadsPerBlock, p.maxThreadsPerBlock},
            {cudaDevAttrMaxThreadsPerMultiProcessor, p.maxThreadsPerMultiProcessor},
            {cudaDevAttrMaxBlocksPerMultiprocessor, p.maxBlocksPerMultiProcessor},
            {cudaDevAttrMaxRegistersPerBlock, p.regsPerBlock},
            {cudaDevAttrMaxRegistersPerMultiprocessor, p.regsPerMultiprocessor},
            {cudaDevAttrMaxGridDimX, p.maxGridSize[0]},
            {cudaDevAttrL2CacheSize, p.l2CacheSize},
            {cudaDevAttrAsyncEngineCount, p.asyncEngineCount},
            {cudaDevAttrConcurrentKernels, p.concurrentKernels},
            {cudaDevAttrCanMapHostMemory, p.canMapHostMemory},
            {cudaDevAttrUnifiedAddressing, p.unifiedAddressing},
            {cudaDevAttrKernelExecTimeout, settings().watchdog},
            {cudaDevAttrComputeMode, cudaComputeModeDefault},
            {cudaDevAttrClockRate, 1'500'000},  // [kHz]
        };
        for (auto const& [key, number] : known) {
            if (key == attribute) return *value = number, cudaSuccess;
        }
        misuse("attribute " + std::to_string(attribute) + " of the card is not simulated");
    });
}
