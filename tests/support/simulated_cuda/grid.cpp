// The threads of a grid: each runs the lane program of the kernels, compiled for the processor.
#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "host/backend/backend.hpp"
#include "tests/support/grid_cranks/grid_cranks.hpp"
#include "tests/support/simulated_cuda/simulation.hpp"

namespace slideway::simulated_cuda {

namespace {

// More than the processor has cores, that the queue of members is contended; a grid's other threads find it empty.
constexpr std::uint64_t most_threads = 32;

}  // namespace

void check_task(GridTask const& task, int device) {
    Block const& b = task.block;
    std::pair<char const*, void const*> const pointers[] = {
        {"state", task.state},
        {"order", b.order},
        {"sample_times", b.samples > 0 ? b.sample_times : nullptr},
        {"clocks", b.clocks},
        {"directions", b.shadows.count > 0 ? b.shadows.directions : nullptr},
        {"inputs", b.inputs},
        {"records", b.records},
        {"final_states", b.final_states},
        {"quantity_values", b.quantity_values},
        {"series_values", b.series_values},
        {"section_values", b.section_values},
        {"growth_values", b.growth_values},
    };
    if (task.state == nullptr) misuse("the task of a grid has no state");
    auto const* const stop = const_cast<int const*>(b.stop_flag);
    if (stop != nullptr && !is_pinned_memory(stop, sizeof *stop)) {
        misuse("the stop_flag of a grid is not pinned memory of the host, which both see");
    }
    for (auto const& [name, address] : pointers) {
        if (address == nullptr || is_device_memory(address, 0, device) || is_pinned_memory(address, 0)) continue;
        misuse(std::string(name) + " of a block on the card points to memory that the card does not see");
    }
}

void run_grid(GridTask task, bool shadowed, std::uint64_t threads) {
    task.block.stop = nullptr;  // a card can ask nobody
    if (!processor_has(Isa::scalar)) misuse("this machine has no fused multiply-add");
    std::atomic<std::uint64_t> next = 0;
    std::vector<std::thread> workers;
    for (std::uint64_t i = 0; i < std::min(threads, most_threads); ++i) {
        workers.emplace_back([&] {
            while (next.fetch_add(1) < threads) testing::run_grid_thread(task, shadowed);
        });
    }
    for (std::thread& worker : workers) worker.join();
}

}  // namespace slideway::simulated_cuda
