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

#include "host/backend/instance_table.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// A card that cannot be used, or a call of its runtime that failed.  `what()` is the whole line to print.  Exit code 4.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// There is no card, or no code for one.
class NoDevice : public DeviceError {
public:
    using DeviceError::DeviceError;
};

/// Integrates a block to its end; may be called by several threads at once.  @throws DeviceError; the block's results are then void
using BlockKernel = std::function<void(Block&)>;

/// From several threads.
class Backend {
public:
    virtual ~Backend() = default;
    virtual std::string_view name() const = 0;    // "cpu", "cuda": as --backend knows it
    virtual std::string isa() const = 0;          // "avx512", "sm_90"; see arithmetic_of (host/output/run_identity.hpp)
    virtual std::string machine() const = 0;      // "NVIDIA H100 80GB HBM3"; "" for the processor
    virtual std::string flags() const = 0;        // compiler flags of the kernels
    virtual std::size_t lanes() const = 0;        // that one instruction serves: blocks are multiples of it
    virtual std::size_t least_block() const = 0;  // smaller ones would leave much of the machine idle
    /// Members of the largest block that suits this machine and finds room in its memory.
    /// @param bytes_per_member of a block's arrays  @param workers that have a block each at once  @param asked what the user wants, 0:
    /// whatever suits  @throws DeviceError if there is no room for so many, or not for a single one
    virtual std::size_t largest_block(std::uint64_t bytes_per_member, int workers, std::size_t asked) const = 0;
    /// Bytes of a card that are taken whatever its blocks are; 0 of the processor.
    virtual std::uint64_t reserved_bytes() const = 0;
    /// Time [s] for one step of one member where workers integrate so many: no more than a rough guess.
    virtual double seconds_per_step(double members, int workers) const = 0;
    /// The instance for a scene's parts.  @param shadows members have some beside them
    virtual BlockKernel kernel(Parts const& parts, bool shadows) const = 0;
    /// Operations in double precision [1/s] by its data sheet, a fused multiply-add being two; 0 where nothing says so.
    virtual double peak() const = 0;
};

/// scalar is one member at a time with fused multiply-add; sse2 runs on every x86-64 machine and has no FMA, so its
/// bits differ from the others', which all agree.
enum class Isa { scalar, sse2, avx2, avx512 };

std::string_view name_of(Isa isa);
int lanes_of(Isa isa);
bool is_supported(Isa isa);  // by this machine
Isa best_isa();              // the widest that this machine supports
std::span<Isa const> all_isas();
std::string flags_of(Isa isa);  // compiler flags the unit was built with

/// @throws std::out_of_range never: every combination of parts exists for every ISA.
KernelInstance find_instance(Isa isa, Parts const& parts);

std::shared_ptr<Backend const> cpu_backend(Isa isa);

/// Whether this build has code for cards at all.
bool has_cuda();
/// A card of this machine.  @param rank of this process among those of the machine, which share its cards in turn
/// @throws NoDevice; DeviceError if there is one that cannot be used
std::shared_ptr<Backend const> cuda_backend(int rank);

}  // namespace slideway
