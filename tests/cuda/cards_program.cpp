// Work for a simulated card, whose runtime reads once per process how it is to behave (tests/support/simulated_cuda/simulation.hpp).
// cards_program blocks WORKERS BLOCKS ATTEMPTS [RANK] | endless | memory WORKERS SAMPLES [MEMBERS] | card RANK
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <cuda_runtime_api.h>

#include "host/backend/backend.hpp"
#include "host/backend/block_image.hpp"
#include "kernels/laws/list.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway {
namespace {

using testing::BlockPlan;
using testing::OwnedBlock;

/// Runs one worker per thread.  @return the first failure, or what all went well with
std::string at_once(int workers, std::string const& otherwise, auto const& work) {
    std::mutex mutex;
    std::string outcome = otherwise;
    std::vector<std::thread> threads;
    for (int worker = 0; worker < workers; ++worker) {
        threads.emplace_back([&] {
            std::string told;
            try {
                told = work();
            } catch (DeviceError const& error) {
                told = error.what();
            }
            std::lock_guard const lock(mutex);
            if (!told.empty() && outcome == otherwise) outcome = told;
        });
    }
    for (std::thread& thread : threads) thread.join();
    return outcome;
}

/// The first plain, the next with shadows, and so on.
std::vector<BlockPlan> block_plans(int count) {
    std::vector<BlockPlan> plans;
    for (int i = 0; i < count; ++i) {
        auto const all = testing::all_parts();
        Parts const parts = all[static_cast<std::size_t>(13 * i) % all.size()];
        auto& plan =
            plans.emplace_back(i % 2 == 0 ? testing::sampled_block(4, parts) : testing::shadowed_block(3, parts));
        plan.settings.end_time = 2e-3;
        for (MemberClock& clock : plan.clocks) clock.end = 2e-3, clock.first_stop = clock.period = 2e-4;
        while (plan.sample_times.back() > 2e-3) plan.sample_times.pop_back();
    }
    return plans;
}

BlockKernel kernel_of(Backend const& backend, BlockPlan const& plan) {
    return backend.kernel(plan.parts, plan.shadows.count > 0);
}

/// Of the calling thread.
int current_device() {
    int device = -1;
    cudaGetDevice(&device);
    return device;
}

std::string integrate_blocks(int workers, int blocks, int rank) {
    auto const card = cuda_backend({rank, 1});
    card->bounds({{}, false, 1000, workers, 0});
    auto const plans = block_plans(blocks);
    std::vector<BlockKernel> kernels;  // by one thread, as the driver does
    for (BlockPlan const& plan : plans) kernels.push_back(kernel_of(*card, plan));
    int const device = current_device();
    return at_once(workers, "same bits", [&] {
        for (std::size_t i = 0; i < plans.size(); ++i) {
            OwnedBlock here(plans[i]), there(plans[i]);
            kernel_of(*cpu_backend(Isa::scalar), plans[i])(here.block);
            kernels[i](there.block);
            if (auto const difference = testing::difference(there, here); !difference.empty()) return difference;
            if (current_device() != device) return std::string("on another card");
        }
        return std::string();
    });
}

/// A block that ends only if it is told to, which nobody does.
std::string integrate_without_end() {
    auto plan = testing::sampled_block(3, {Law::conservative, Damping::point, true, false});
    plan.settings.end_time = 1e5;
    plan.settings.stiff_max_step = 1e-4;  // a slider at rest has an hour of them
    plan.settings.max_steps = 1'000'000'000'000;
    OwnedBlock block(plan);
    kernel_of(*cuda_backend(), plan)(block.block);
    return "ended";
}

/// Blocks as large as the card says that they may be, all at once.  @param asked members of a block, 0: as many as fit
std::string fill_memory(int workers, int samples, std::size_t asked) {
    BlockPlan plan;
    plan.series = testing::state_selection;
    plan.settings.end_time = 1e-5;
    for (int i = 0; i < samples; ++i) plan.sample_times.push_back(1e-5 * i / samples);
    plan.members = testing::scattered_starts(100);
    std::size_t const bytes = image_size(OwnedBlock(plan).block).total / 100 + 1;
    auto const card = cuda_backend();
    std::size_t const most = card->bounds({{}, false, bytes, workers, asked}).most, members = asked > 0 ? asked : most;
    std::printf("%zu members of %zu bytes\n", members, bytes);
    plan.members = testing::scattered_starts(members);
    return at_once(workers, "fits", [&] {
        OwnedBlock block(plan);
        card->kernel({}, false)(block.block);
        return std::string(block.record(members - 1).status == Status::finished ? "" : "not finished");
    });
}

std::string card_of(int rank) {
    auto const card = cuda_backend({rank, 1});
    card->bounds({});
    return "card " + std::to_string(current_device());
}

template <class Work> void tell(Work const& work) {
    std::string told;
    try {
        told = work();
    } catch (DeviceError const& error) {
        told = error.what();
    }
    std::puts(told.c_str());
}

int run(std::vector<std::string> const& words) {
    auto const number = [&](std::size_t i) { return std::atoi(words.at(i).c_str()); };
    if (words.at(0) == "blocks") {
        int const rank = words.size() > 4 ? number(4) : 0;
        for (int i = 0; i < number(3); ++i) tell([&] { return integrate_blocks(number(1), number(2), rank); });
    } else if (words[0] == "endless") {
        tell(integrate_without_end);
    } else if (words[0] == "memory") {
        auto const asked = static_cast<std::size_t>(words.size() > 3 ? number(3) : 0);
        tell([&] { return fill_memory(number(1), number(2), asked); });
    } else if (words[0] == "card") {
        tell([&] { return card_of(number(1)); });
    } else {
        return 2;
    }
    return 0;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    try {
        return slideway::run({argv + 1, argv + argc});
    } catch (std::exception const& error) {
        std::fprintf(stderr, "cards_program: %s\n", error.what());
        return 1;
    }
}
