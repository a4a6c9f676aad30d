#include "host/backend/block_image.hpp"

#include <bit>
#include <cstring>
#include <type_traits>

namespace slideway {
namespace {

/// What a block holds beside its members' numbers.
struct Counts {
    std::size_t members, series, shadows, sections, growths;

    explicit Counts(Block const& block)
        : members(block.members),
          series(static_cast<std::size_t>(std::popcount(block.series))),
          shadows(static_cast<std::size_t>(block.shadows.count)),
          sections(block.section_values == nullptr ? 0
                   : block.crossings.room > 0      ? block.crossings.room
                                                   : block.stops.sections()),
          growths(block.growth_values == nullptr ? 0 : block.stops.growths()) {}
};

constexpr std::size_t alignment = 64;

/// Walks over the arrays of a block in the order of an image: `visit(pointer in the block, numbers of it, is a result)`.
template <class Visit> void visit_arrays(Block& block, GridState*& state, Visit const& visit) {
    Counts const n(block);
    visit(block.inputs, n.members, false);
    visit(block.order, n.members, false);
    visit(block.sample_times, block.samples, false);
    visit(block.clocks, n.members, false);
    visit(block.shadows.directions, n.members * n.shadows * state_size, false);
    visit(state, 1, true);
    visit(block.records, n.members, true);
    visit(block.final_states, n.members * state_size, true);
    visit(block.quantity_values, n.members * static_cast<std::size_t>(quantity_columns), true);
    visit(block.series_values, n.series * n.members * block.samples, true);
    visit(block.section_values, n.members * n.sections * (1 + state_size), true);
    visit(block.growth_values, n.members * n.growths * n.shadows, true);
}

/// The same with the place of each in the image; arrays that the block does not have are left out.
template <class Visit> ImageSize visit_places(Block& block, GridState*& state, Visit const& visit) {
    ImageSize size;
    bool in_results = false;
    visit_arrays(block, state, [&](auto& array, std::size_t count, bool is_result) {
        if (is_result && !in_results) {
            in_results = true;
            size.results_at = size.total;
        }
        if (array == nullptr) return;
        using Item = std::remove_cv_t<std::remove_pointer_t<std::remove_reference_t<decltype(array)>>>;
        static_assert(std::is_trivially_copyable_v<Item> && alignof(Item) <= alignment);
        std::size_t const bytes = count * sizeof(Item);
        visit(array, size.total, bytes, is_result);
        size.total += (bytes + alignment - 1) / alignment * alignment;
    });
    return size;
}

}  // namespace

ImageSize image_size(Block const& block) {
    Block copy = block;
    GridState state, *start = &state;
    return visit_places(copy, start, [](auto&, std::size_t, std::size_t, bool) {});
}

void write_image(Block const& block, std::byte* image) {
    Block copy = block;
    GridState state, *start = &state;
    visit_places(copy, start, [image](auto& array, std::size_t at, std::size_t bytes, bool) {
        if (bytes > 0) std::memcpy(image + at, array, bytes);
    });
}

GridTask task_in(Block const& block, Parts const& parts, std::byte* address) {
    GridTask task{block, nullptr, parts};
    GridState state;
    task.state = &state;
    visit_places(task.block, task.state, [address](auto& array, std::size_t at, std::size_t, bool) {
        array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(address + at);
    });
    task.block.stop = nullptr;  // a function of this side
    task.block.stop_context = nullptr;
    return task;
}

void read_results(std::byte const* image, Block& block) {
    GridState state, *end = &state;
    visit_places(block, end, [image](auto& array, std::size_t at, std::size_t bytes, bool is_result) {
        using Pointer = std::remove_reference_t<decltype(array)>;
        if constexpr (!std::is_const_v<std::remove_pointer_t<Pointer>>) {
            if (is_result && bytes > 0) std::memcpy(array, image + at, bytes);
        }
    });
    block.lane_steps_executed = state.lane_steps_executed;
    block.lane_steps_useful = state.lane_steps_useful;
}

}  // namespace slideway
