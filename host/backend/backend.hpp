// What integrates blocks of members: this processor, with one of its instruction sets, or a card.  The kernels are compiled once per
// instruction set and once for cards, and a scene picks its instance once, before the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "host/backend/kernel_tables.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// A card or processor that cannot be used, or a call of a card's runtime that failed.  `what()` is the whole line to print.  Exit code 4.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// There is no card, or no module with code for one.
class NoDevice : public DeviceError {
public:
    using DeviceError::DeviceError;
};

/// Integrates a block to its end; may be called by several threads at once.  @throws DeviceError; the block's results are then void
using BlockKernel = std::function<void(Block&)>;

/// What a run asks of a backend.
struct BlockDemand {
    Parts parts;                         // of the scene
    bool shadows = false;                // members have some beside them
    std::uint64_t bytes_per_member = 1;  // of a block's arrays
    int workers = 1;                     // that have a block each at once
    std::size_t asked = 0;               // members of a block, if the user says how many
};

/// Which blocks suit a backend.
struct BlockBounds {
    std::size_t lanes = 1;       // sizes are multiples of, where there is room
    std::size_t least = 8;       // members; fewer would leave much of the machine idle
    std::size_t most = 4096;     // more find no room, or are of no use
    bool shared = false;         // one machine has the blocks of all workers, and could fill itself with any of them
    std::uint64_t reserved = 0;  // bytes of a card that are taken whatever its blocks are
};

/// From several threads.
class Backend {
public:
    virtual ~Backend() = default;
    virtual std::string_view name() const = 0;  // "cpu", "cuda": as --backend knows it
    virtual std::string isa() const = 0;        // "avx512", "sm_90"; see arithmetic_of (host/store/run_identity.hpp)
    virtual std::string machine() const = 0;    // "avx512, 8 lanes"; "NVIDIA H100 80GB HBM3, sm_90"
    virtual std::string flags() const = 0;      // compiler flags of the kernels
    /// How many of the threads that a user allows are of use.
    virtual int workers(int threads) const = 0;
    /// @throws DeviceError if there is no room for a block of as many members as are asked for, or of a single one
    virtual BlockBounds bounds(BlockDemand const& demand) const = 0;
    /// Time [s] for one step of one member where workers integrate so many: no more than a rough guess.
    virtual double seconds_per_step(double members, int workers) const = 0;
    /// The instance for a scene's parts.  @param shadows members have some beside them
    virtual BlockKernel kernel(Parts const& parts, bool shadows) const = 0;
    /// Operations in double precision per second at most, a fused multiply-add being two; 0 of the processor, whose peak is
    /// measured (bench/fma_peak.hpp).
    virtual double peak() const = 0;
    /// Why nobody should take it unasked; "" if there is nothing to say against it.
    virtual std::string objection() const = 0;
};

/// scalar is one member at a time, the reference whose bits all others meet, and runs on every machine: scalar_libm is how it was compiled
/// for those of x86-64 without AVX2 and FMA, where the C library has to multiply and add with one rounding.
enum class Isa { scalar, scalar_libm, avx2, avx512, neon };

std::string_view name_of(Isa isa);
int lanes_of(Isa isa);
bool processor_has(Isa isa);  // this machine's has the instructions that kernels of it are compiled to
bool is_built(Isa isa);       // this program has kernels for it
bool is_supported(Isa isa);   // and they run on this machine
Isa best_isa();               // the widest that is supported
Isa best_isa(Parts const& parts);  // and, of modules, has their kernels
std::span<Isa const> all_isas();
std::span<Isa const> built_isas();
/// scalar_libm for scalar where this machine needs it, otherwise the same.
Isa compiled_isa(Isa isa);
std::string flags_of(Isa isa);  // compiler flags the unit was built with

/// @param isa built.  Every combination of parts exists for every instruction set, but for dampings that a law does not have.
/// @param shadows members with shadows are to run: of rigid contacts these are other kernels than those that run others
/// @throws std::invalid_argument for what there is not; DeviceError where kernels are a module that cannot be had (kernel_modules.hpp)
KernelInstance find_instance(Isa isa, Parts const& parts, bool shadows = false);

/// @throws DeviceError if the instruction set is not supported
std::shared_ptr<Backend const> cpu_backend(Isa isa);

/// Processes of this machine share its cards in turn.
struct CardShare {
    int rank = 0;   // of this process among them
    int ranks = 1;  // how many they are
};

/// A card of this machine.  Nothing happens on it before it is asked for bounds or a kernel.
/// @throws NoDevice, also without the module that has the kernels for cards (cuda_module.hpp); DeviceError if there is a card, or a
/// module, that cannot be used
std::shared_ptr<Backend const> cuda_backend(CardShare const& share = {});

}  // namespace slideway
