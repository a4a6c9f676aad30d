// One piece of memory that holds a block: what is in it, where, and what comes back.
#include "host/backend/block_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::block_image_test {
namespace {

using testing::BlockPlan;
using testing::OwnedBlock;

constexpr std::byte garbage{0xa5};

/// Memory for an image, with bytes behind it that nobody may touch.
class Memory {
public:
    explicit Memory(std::size_t bytes)
        : bytes_(bytes), start_(static_cast<std::byte*>(::operator new (bytes + guard, std::align_val_t{256}))) {
        std::fill_n(start_, bytes + guard, garbage);
    }
    ~Memory() {
        auto const* const end = start_ + bytes_;
        EXPECT_TRUE(std::all_of(end, end + guard, [](std::byte b) { return b == garbage; }))
            << "written behind the image";
        ::operator delete (start_, std::align_val_t{256});
    }
    Memory(Memory const&) = delete;
    std::byte* data() { return start_; }

private:
    static constexpr std::size_t guard = 4096;
    std::size_t bytes_;
    std::byte* start_;
};

/// An array of a block.
struct Array {
    char const* name;
    void const* at;
    std::size_t bytes;
    std::size_t alignment;
};

template <class T> Array array(char const* name, T const* at, std::size_t count) {
    return {name, at, count * sizeof(T), alignof(T)};
}

std::vector<Array> inputs_of(Block const& b) {
    return {array("inputs", b.inputs, b.members), array("order", b.order, b.members),
            array("sample times", b.sample_times, b.samples), array("clocks", b.clocks, b.members),
            array("directions", b.shadows.directions, b.members * static_cast<std::size_t>(b.shadows.count) * 10)};
}

std::vector<Array> results_of(Block const& b, BlockPlan const& plan) {
    std::size_t const sections = plan.crossings.room > 0 ? plan.crossings.room : plan.stops.sections();
    auto const series = static_cast<std::size_t>(std::popcount(plan.series));
    auto const shadows = static_cast<std::size_t>(plan.shadows.count);
    return {array("records", b.records, b.members),
            array("final states", b.final_states, b.members * 10),
            array("quantities", b.quantity_values, b.members * static_cast<std::size_t>(quantity_columns)),
            array("series", b.series_values, series * b.members * b.samples),
            array("sections", b.section_values, b.section_values ? b.members * sections * 11 : 0),
            array("growths", b.growth_values, b.growth_values ? b.members * plan.stops.growths() * shadows : 0)};
}

/// Blocks with and without each of the arrays that a block may lack.
std::map<std::string, BlockPlan> plans() {
    Parts const parts{Law::conservative, Damping::point, true, false};
    std::map<std::string, BlockPlan> all;
    all["bare"] = testing::sampled_block(5, parts);
    all["bare"].series = 0;
    all["bare"].sample_times.clear();
    all["sampled"] = testing::sampled_block(5, parts);
    all["ordered"] = testing::sampled_block(5, parts);
    all["ordered"].order = {3, 1, 4, 0, 2};
    all["crossings"] = testing::crossing_block(5, parts);
    all["shadowed"] = testing::shadowed_block(5, parts);
    all["shadowed and ordered"] = testing::shadowed_block(7, parts);
    all["shadowed and ordered"].order = {6, 3, 1, 4, 0, 2, 5};
    all["sections"] = testing::shadowed_block(5, parts);
    all["sections"].shadows.count = 0;
    all["single"] = testing::shadowed_block(1, parts);
    return all;
}

TEST(BlockImage, HoldsEveryArrayOnce) {
    for (auto const& [name, plan] : plans()) {
        SCOPED_TRACE(name);
        OwnedBlock owned(plan);
        auto const [total, results_at] = image_size(owned.block);
        Memory memory(total);
        std::byte* const image = memory.data();
        write_image(owned.block, image);
        GridTask const task = task_in(owned.block, plan.parts, image);
        EXPECT_EQ(task.parts, plan.parts);
        EXPECT_EQ(task.block.stop, nullptr);
        EXPECT_EQ(task.state->taken, 0u);
        EXPECT_EQ(task.state->lane_steps_executed, 0u);

        std::vector<std::pair<std::size_t, std::size_t>> taken;
        auto const expect_copies = [&](std::vector<Array> const& from, std::vector<Array> const& copies,
                                       std::size_t begin, std::size_t end) {
            for (std::size_t i = 0; i < from.size(); ++i) {
                SCOPED_TRACE(from[i].name);
                EXPECT_EQ(copies[i].at == nullptr, from[i].at == nullptr);
                if (from[i].at == nullptr || from[i].bytes == 0) continue;
                auto const offset = static_cast<std::size_t>(static_cast<std::byte const*>(copies[i].at) - image);
                EXPECT_GE(offset, begin);
                EXPECT_LE(offset + from[i].bytes, end);
                EXPECT_EQ(offset % from[i].alignment, 0u);
                EXPECT_EQ(std::memcmp(copies[i].at, from[i].at, from[i].bytes), 0);
                taken.push_back({offset, offset + from[i].bytes});
            }
        };
        expect_copies(inputs_of(owned.block), inputs_of(task.block), 0, results_at);
        auto results = results_of(owned.block, plan), copies = results_of(task.block, plan);
        GridState const state;
        results.push_back(array("state", &state, 1));
        copies.push_back(array("state", task.state, 1));
        expect_copies(results, copies, results_at, total);
        std::ranges::sort(taken);
        for (std::size_t i = 1; i < taken.size(); ++i) EXPECT_LE(taken[i - 1].second, taken[i].first);
    }
}

/// What travels back from a card is the end of the image.
void fetch(std::byte* to, std::byte const* from, ImageSize size) {
    std::copy(from + size.results_at, from + size.total, to + size.results_at);
}

TEST(BlockImage, BringsBackWhatARunLeaves) {
    for (auto const& [name, plan] : plans()) {
        SCOPED_TRACE(name);
        auto const instance = find_instance(Isa::scalar, plan.parts);
        auto const run = [&, shadowed = plan.shadows.count > 0](Block& block) {
            shadowed ? instance.run_shadowed(block) : instance.run(block);
        };
        OwnedBlock here(plan), there(plan);
        run(here.block);
        ImageSize const size = image_size(there.block);
        Memory sent(size.total), on_card(size.total);
        write_image(there.block, sent.data());
        std::copy_n(sent.data(), size.total, on_card.data());
        GridTask task = task_in(there.block, plan.parts, on_card.data());
        run(task.block);
        task.state->lane_steps_executed = 17;
        task.state->lane_steps_useful = 16;
        fetch(sent.data(), on_card.data(), size);
        read_results(sent.data(), there.block);
        EXPECT_EQ(difference(here, there), "");
        EXPECT_EQ(there.block.lane_steps_executed, 17u);
        EXPECT_EQ(there.block.lane_steps_useful, 16u);
    }
}

TEST(BlockImage, WhatARunDoesNotWriteKeepsItsValue) {
    for (auto const& [name, plan] : plans()) {
        SCOPED_TRACE(name);
        OwnedBlock before(plan), after(plan);
        ImageSize const size = image_size(after.block);
        Memory sent(size.total), on_card(size.total);
        write_image(after.block, sent.data());
        std::copy_n(sent.data(), size.total, on_card.data());
        fetch(sent.data(), on_card.data(), size);
        read_results(sent.data(), after.block);
        EXPECT_EQ(difference(before, after), "");
    }
}

TEST(BlockImage, PointersAreForWhoSeesTheImageElsewhere) {
    OwnedBlock owned(plans()["shadowed and ordered"]);
    Memory memory(image_size(owned.block).total);
    auto* const elsewhere = reinterpret_cast<std::byte*>(std::uintptr_t(0x7f0000000000));
    GridTask const here = task_in(owned.block, {}, memory.data()), there = task_in(owned.block, {}, elsewhere);
    auto const offset = [](void const* pointer, std::byte const* from) {
        return static_cast<std::byte const*>(pointer) - from;
    };
    EXPECT_EQ(offset(here.block.inputs, memory.data()), offset(there.block.inputs, elsewhere));
    EXPECT_EQ(offset(here.state, memory.data()), offset(there.state, elsewhere));
    EXPECT_EQ(offset(here.block.growth_values, memory.data()), offset(there.block.growth_values, elsewhere));
}

TEST(BlockImage, OfNoMembers) {
    OwnedBlock owned{BlockPlan{}};
    ImageSize const size = image_size(owned.block);
    EXPECT_GE(size.total, size.results_at + sizeof(GridState));
    Memory memory(size.total);
    write_image(owned.block, memory.data());
    GridTask const task = task_in(owned.block, {}, memory.data());
    task.state->lane_steps_executed = 5;
    read_results(memory.data(), owned.block);
    EXPECT_EQ(owned.block.lane_steps_executed, 5u);
}

}  // namespace
}  // namespace slideway::block_image_test
