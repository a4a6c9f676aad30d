// Kernels as the compiler's host code registers them, and their launches.
#include <cxxabi.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "kernels/grid_task.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/simulated_cuda/simulation.hpp"

namespace slideway::simulated_cuda {

namespace {

/// Code of one unit for one architecture: for this card and later ones of its family, or an assembler's text for all later ones.
struct Image {
    bool is_text = false;
    int architecture = 0;

    bool runs_on(int card) const { return architecture <= card && (is_text || architecture / 10 == card / 10); }
};

struct Unit {
    std::vector<Image> images;

    /// @return nullptr if the card can run none
    Image const* chosen() const {
        Image const* best = nullptr;
        for (Image const& image : images) {
            if (!image.runs_on(settings().architecture)) continue;
            if (best == nullptr || image.architecture > best->architecture) best = &image;
        }
        return best;
    }
};

struct Kernel {
    Unit const* unit = nullptr;
    std::string name;  // as C++ has it
};

struct Registry {
    std::mutex mutex;
    std::map<void const*, Kernel> kernels;  // by the address of the host's stub
};

Registry& registry() {
    static auto& r = *new Registry;
    return r;
}

template <class Value> Value value_at(std::byte const* address) {
    Value value;
    std::memcpy(&value, address, sizeof value);
    return value;
}

/// The images in what `fatbinary` packs: a header of its own size and the length of the rest, then per image one with the kind (1: text),
/// its own size, the image's size and the architecture.  Nvidia does not document it; found so in what release 13.0 makes.
std::vector<Image> images_in(std::byte const* fat) {
    std::vector<Image> images;
    if (value_at<std::uint32_t>(fat) != 0xba55ed50u) misuse("the code for cards is of an unknown format");
    std::byte const* at = fat + value_at<std::uint16_t>(fat + 6);
    std::byte const* const end = at + value_at<std::uint64_t>(fat + 8);
    while (at < end) {
        bool const is_text = value_at<std::uint16_t>(at) == 1;
        images.push_back({is_text, value_at<std::int32_t>(at + 28)});
        at += value_at<std::uint32_t>(at + 4) + value_at<std::uint64_t>(at + 8);
    }
    return images;
}

std::string demangled(char const* name) {
    int status = 0;
    std::unique_ptr<char, void (*)(void*)> const text(abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free);
    return status == 0 ? text.get() : name;
}

Kernel const* kernel_at(void const* stub) {
    std::lock_guard const lock(registry().mutex);
    auto const found = registry().kernels.find(stub);
    return found == registry().kernels.end() ? nullptr : &found->second;
}

/// @return what is wrong with a function for this card
cudaError_t state_of(Kernel const* kernel) {
    if (kernel == nullptr) return cudaErrorInvalidDeviceFunction;
    return kernel->unit->chosen() == nullptr ? cudaErrorNoKernelImageForDevice : cudaSuccess;
}

/// Ends the program if the scene's parts are not among those that the kernel was compiled for.
void check_instance(std::string const& kernel, Parts const& parts) {
#define SLIDEWAY_NAME(name, Type) #Type,
    constexpr char const* laws[] = {SLIDEWAY_LAWS(SLIDEWAY_NAME)};
#undef SLIDEWAY_NAME
    char const* const law = laws[static_cast<int>(parts.law)];
    if (kernel.find(law) == kernel.npos) misuse("a scene with " + std::string(law) + " was given to " + kernel);
    if (parts.mechanism != Mechanism::slider_crank || kernel.find("CrankAndRod") == kernel.npos) {
        misuse("a scene of another mechanism was given to " + kernel);
    }
}

bool is_shadowed(std::string const& kernel) {
    if (kernel.find("integrate_members<") == kernel.npos) misuse("no simulation of " + kernel);
    return kernel.find("Shadowed<") != kernel.npos;
}

void run(GridTask const& task, bool shadowed, std::uint64_t threads, int device) {
    if (cudaError_t const code = count("kernel"); code != cudaSuccess) lose_card(code);
    {
        // A card that another stream loses from here on keeps its memory as it is until this is over.
        Access const access(device);
        if (card_error() == cudaSuccess) return run_grid(task, shadowed, threads);
    }
    spoil_device(device);
}

cudaError_t launch(void const* stub, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream) {
    Kernel const* const kernel = kernel_at(stub);
    if (cudaError_t const state = state_of(kernel); state != cudaSuccess) return state;
    std::uint64_t const blocks = std::uint64_t(grid.x) * grid.y * grid.z;
    std::uint64_t const threads = std::uint64_t(block.x) * block.y * block.z;
    if (blocks == 0 || threads == 0 || threads > 1024) return cudaErrorInvalidConfiguration;
    if (threads > most_block_threads) return cudaErrorLaunchOutOfResources;
    if (shared > (48 << 10)) return cudaErrorInvalidValue;
    auto const& task = *static_cast<GridTask const*>(arguments[0]);
    bool const shadowed = is_shadowed(kernel->name);
    check_instance(kernel->name, task.parts);
    int const device = current_device();
    check_task(task, device);
    // Arguments are read at the launch: the caller's may be gone when the stream comes to it.
    return enqueue(stream, device, [=] { run(task, shadowed, blocks * threads, device); });
}

struct Shape {
    dim3 grid, block;
    std::size_t shared;
    cudaStream_t stream;
};
thread_local std::vector<Shape> shapes;  // of the launches that a thread is about to make

}  // namespace

}  // namespace slideway::simulated_cuda

using namespace slideway::simulated_cuda;

cudaError_t cudaLaunchKernel(void const* stub, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                             cudaStream_t stream) {
    return call("cudaLaunchKernel", [&] { return launch(stub, grid, block, arguments, shared, stream); });
}

cudaError_t cudaFuncGetAttributes(cudaFuncAttributes* out, void const* stub) {
    return call("cudaFuncGetAttributes", [&] {
        Kernel const* const kernel = kernel_at(stub);
        if (cudaError_t const state = state_of(kernel); state != cudaSuccess) return state;
        *out = {};
        out->maxThreadsPerBlock = most_block_threads;
        out->numRegs = 255;
        out->localSizeBytes = 12000;
        out->binaryVersion = out->ptxVersion = kernel->unit->chosen()->architecture;
        return cudaSuccess;
    });
}

cudaError_t cudaOccupancyMaxActiveBlocksPerMultiprocessorWithFlags(int* blocks, void const* stub, int threads,
                                                                   std::size_t, unsigned) {
    return call("cudaOccupancyMaxActiveBlocksPerMultiprocessor", [&] {
        if (cudaError_t const state = state_of(kernel_at(stub)); state != cudaSuccess) return state;
        if (threads <= 0) return cudaErrorInvalidValue;
        *blocks = most_block_threads / ((threads + 31) / 32 * 32);  // registers are given to whole warps
        return cudaSuccess;
    });
}

cudaError_t cudaOccupancyMaxActiveBlocksPerMultiprocessor(int* blocks, void const* stub, int threads,
                                                          std::size_t shared) {
    return cudaOccupancyMaxActiveBlocksPerMultiprocessorWithFlags(blocks, stub, threads, shared, 0);
}

// ---- what the compiler's host code calls; declared in headers that only nvcc can read ----

extern "C" {

void** __cudaRegisterFatBinary(void* wrapper) {
    // magic, version, the images, a name
    auto const fat = value_at<std::byte const*>(static_cast<std::byte const*>(wrapper) + 8);
    return reinterpret_cast<void**>(new Unit{images_in(fat)});
}

void __cudaRegisterFatBinaryEnd(void**) {}

// Objects that are destroyed later may still ask for its kernels.
void __cudaUnregisterFatBinary(void**) {}

char __cudaInitModule(void**) { return 1; }

void __cudaRegisterFunction(void** unit, char const* stub, char*, char const* name, int, uint3*, uint3*, dim3*, dim3*,
                            int*) {
    std::lock_guard const lock(registry().mutex);
    registry().kernels[stub] = {reinterpret_cast<Unit const*>(unit), demangled(name)};
}

// Kernels are run as the host's code, which has the host's variables.
void __cudaRegisterVar(void**, char*, char*, char const*, int, std::size_t, int, int) {}

unsigned __cudaPushCallConfiguration(dim3 grid, dim3 block, std::size_t shared, cudaStream_t stream) {
    shapes.push_back({grid, block, shared, stream});
    return 0;
}

cudaError_t __cudaPopCallConfiguration(dim3* grid, dim3* block, std::size_t* shared, void* stream) {
    if (shapes.empty()) misuse("a launch without a shape");
    Shape const shape = shapes.back();
    shapes.pop_back();
    *grid = shape.grid, *block = shape.block, *shared = shape.shared;
    *static_cast<cudaStream_t*>(stream) = shape.stream;
    return cudaSuccess;
}

cudaError_t __cudaGetKernel(cudaKernel_t* kernel, void const* stub) {
    *kernel = static_cast<cudaKernel_t>(const_cast<void*>(stub));
    return cudaSuccess;
}

cudaError_t __cudaLaunchKernel(cudaKernel_t kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                               cudaStream_t stream) {
    return cudaLaunchKernel(kernel, grid, block, arguments, shared, stream);
}

}  // extern "C"
