// Cards that CUDA knows, as a backend.
//
// Every worker of a run that integrates a block does so on a stream of its own: while one block's results travel back or are put
// down, another's members are integrated.
#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/backend/cuda_kernels.hpp"
#include "host/backend/cuda_module.hpp"
#include "host/backend/cuda_stream.hpp"

namespace slideway {
namespace {

void const* kernel_for(bool shadows) {
    CudaKernels const kernels = cuda_kernels();
    return shadows ? kernels.shadowed : kernels.members;
}

class CudaBackend final : public Backend, public std::enable_shared_from_this<CudaBackend> {
public:
    explicit CudaBackend(CudaCard card) : card_(std::move(card)) {}

    std::string_view name() const override { return "cuda"; }
    std::string isa() const override { return card_.isa + SLIDEWAY_CUDA_ARITHMETIC; }
    std::string machine() const override { return card_.name + ", " + card_.isa; }
    std::string flags() const override { return SLIDEWAY_CUDA_FLAGS; }

    /// While the block of one is integrated, the next ones are drawn and sent, and the last ones come back.
    int workers(int threads) const override { return std::min(threads, 4); }

    BlockBounds bounds(BlockDemand const& demand) const override {
        card_.bind();
        void const* const kernel = kernel_for(demand.shadows);
        BlockBounds bounds;
        bounds.lanes = 32;
        bounds.shared = true;
        // The threads' stacks, of as many threads as could be resident if they needed few registers.
        bounds.reserved = stack_of(kernel) * static_cast<std::uint64_t>(card_.threads_per_multiprocessor) *
                          static_cast<std::uint64_t>(card_.multiprocessors);
        bounds.least = resident_threads(kernel);
        std::size_t const room = room_for(demand, bounds.reserved);
        // Larger blocks would not fill the card better, and a process that is killed loses those in work.  The host has their arrays
        // too, and some of them twice.
        constexpr std::uint64_t memory = 256'000'000;
        std::uint64_t const of_use = std::min<std::uint64_t>(4 * bounds.least, memory / demand.bytes_per_member);
        bounds.most = std::clamp<std::size_t>(of_use, 1, room);
        return bounds;
    }

    /// As if a step took 10,000 operations and the card ran at a twentieth of its peak.
    double seconds_per_step(double members, int) const override {
        constexpr double resident = 256;  // threads of a multiprocessor, with all registers that a thread may have
        double const filled = std::min(1.0, members / (resident * card_.multiprocessors));
        return 10'000 / (card_.peak() / 20) / filled;
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        if (parts.rigid) throw DeviceError("cuda: there is no code for rigid contacts; use --backend cpu");
        card_.bind();
        void const* const kernel = kernel_for(shadows);
        stack_of(kernel);  // that it is there
        return [card = shared_from_this(), kernel, parts, most = resident_threads(kernel)](Block& block) {
            card->run(kernel, parts, most, block);
        };
    }

    double peak() const override { return card_.peak(); }

    std::string objection() const override {
        if (!card_.has_watchdog) return {};
        return card_.name + " drives a display, and its driver ends kernels that last";
    }

private:
    void run(void const* kernel, Parts const& parts, std::size_t most_threads, Block& block) const {
        if (block.members == 0) return;  // no grid has no threads
        card_.bind();
        std::unique_ptr<CudaStream> stream = free_stream();
        stream->run(kernel, parts, most_threads, block);
        std::lock_guard const lock(mutex_);
        streams_.push_back(std::move(stream));
    }

    /// Members of a block that find room beside those of the other workers.
    std::size_t room_for(BlockDemand const& demand, std::uint64_t stacks) const {
        std::uint64_t const free = card_.free_memory();
        std::string const has = fmt::format("cuda: {} has {} free{}", card_.name, amount_text(free),
                                            card_.sharers > 1 ? " for each process" : "");
        std::uint64_t const usable = free > stacks ? (free - stacks) / 10 * 9 : 0;
        std::size_t const room = usable / static_cast<std::uint64_t>(demand.workers) / demand.bytes_per_member;
        if (room == 0) {
            throw DeviceError(fmt::format(
                "{}, and the threads' stacks take {}: no room for a member of {} for each of {} workers; ask for "
                "fewer samples or sections, use fewer --threads, or --backend cpu",
                has, amount_text(stacks), amount_text(demand.bytes_per_member), demand.workers));
        }
        if (demand.asked <= room) return room;
        throw DeviceError(
            fmt::format("{}, and the threads' stacks take {}: room for blocks of {} members for each of {} workers, "
                        "not of {}; use a smaller "
                        "--block-members, fewer --threads, or --backend cpu",
                        has, amount_text(stacks), room, demand.workers, demand.asked));
    }

    /// Of a thread [B].  @throws DeviceError if the card cannot run the kernel
    std::uint64_t stack_of(void const* kernel) const {
        cudaFuncAttributes attributes{};
        cudaError_t const found = cudaFuncGetAttributes(&attributes, kernel);
        if (found == cudaErrorNoKernelImageForDevice || found == cudaErrorInvalidDeviceFunction) {
            throw DeviceError(
                fmt::format("cuda: {} is of {}, and this build has kernels for {}; build with "
                            "-DCMAKE_CUDA_ARCHITECTURES={}, or use --backend cpu",
                            card_.name, card_.isa, SLIDEWAY_CUDA_TARGETS, card_.isa.substr(3)));
        }
        card_.require(found, "loading a kernel");
        return attributes.localSizeBytes;
    }

    /// Threads of a kernel that the card runs at once.
    std::size_t resident_threads(void const* kernel) const {
        int blocks = 0;
        card_.require(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, threads_per_block, 0),
                      "asking for the kernel's occupancy");
        return static_cast<std::size_t>(std::max(blocks, 1) * card_.multiprocessors * threads_per_block);
    }

    std::unique_ptr<CudaStream> free_stream() const {
        {
            std::lock_guard const lock(mutex_);
            if (!streams_.empty()) {
                auto stream = std::move(streams_.back());
                streams_.pop_back();
                return stream;
            }
        }
        return std::make_unique<CudaStream>(card_);
    }

    CudaCard const card_;
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<CudaStream>> streams_;  // at rest
};

}  // namespace

std::shared_ptr<Backend const> open_card(CardShare const& share) {
    return std::make_shared<CudaBackend>(find_card(share));
}

}  // namespace slideway
