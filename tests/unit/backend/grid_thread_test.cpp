// The threads of a grid, each a thread of the processor that runs the lane program of the kernels for cards: neither who takes which
// member nor how the equations are chosen must show beside the processor's own instance.
#include "kernels/grid_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <numeric>
#include <thread>

#include "kernels/laws/list.hpp"
#include "tests/support/grid_cranks/grid_cranks.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::grid_thread_test {
namespace {

using testing::BlockPlan;
using testing::difference;
using testing::Left;
using testing::OwnedBlock;

class GridThread : public ::testing::Test {
protected:
    void SetUp() override {
        if (compiled_isa(Isa::scalar) != Isa::scalar) GTEST_SKIP() << "this machine has no fused multiply-add";
    }
};

bool has_shadows(BlockPlan const& plan) { return plan.shadows.count > 0; }

/// The processor's program, which integrates the block alone.
void run_alone(OwnedBlock& owned) {
    auto const instance = find_instance(Isa::scalar, owned.plan().parts);
    has_shadows(owned.plan()) ? instance.run_shadowed(owned.block) : instance.run(owned.block);
}

GridState run_grid(OwnedBlock& owned, int threads) {
    GridState state;
    GridTask const task{owned.block, &state, owned.plan().parts};
    std::latch start(threads);
    std::vector<std::thread> grid;
    for (int i = 0; i < threads; ++i) {
        grid.emplace_back([&] {
            start.arrive_and_wait();
            testing::run_grid_thread(task, has_shadows(owned.plan()));
        });
    }
    for (std::thread& thread : grid) thread.join();
    return state;
}

/// Runs a block alone, and another with its plan by the threads of a grid.
void expect_as_alone(OwnedBlock& alone, int threads) {
    BlockPlan const& plan = alone.plan();
    SCOPED_TRACE(testing::name_of(plan.parts) + ", " + std::to_string(threads) + " threads");
    OwnedBlock shared(plan);
    run_alone(alone);
    GridState const state = run_grid(shared, threads);
    EXPECT_EQ(difference(shared, alone), "");
    EXPECT_EQ(state.lane_steps_executed, alone.block.lane_steps_executed);
    EXPECT_EQ(state.lane_steps_useful, alone.block.lane_steps_useful);
    // Each thread asks once more than it gets.
    EXPECT_EQ(state.taken, plan.members.size() + static_cast<std::size_t>(threads));
}

TEST_F(GridThread, GivesTheBitsOfAProgramAlone) {
    double onsets = 0;
    for (Parts const& parts : testing::all_parts()) {
        OwnedBlock block(testing::sampled_block(7, parts));
        expect_as_alone(block, 3);
        onsets += block.value(0, Quantity::contact_onsets);
    }
    EXPECT_GT(onsets, 24) << "the members must meet the way";
}

TEST_F(GridThread, GivesTheShadowsOfAProgramAlone) {
    for (Parts const& parts : testing::all_parts()) {
        OwnedBlock block(testing::shadowed_block(5, parts));
        expect_as_alone(block, 3);
        // The last rows of the table are those of forces, which the plan does not ask for.
        int const of_forces = quantity_columns - quantity_column(Quantity::peak_face_force);
        for (Left const& left : block.left_by(0)) {
            EXPECT_EQ(std::ranges::count(left.numbers, testing::untouched), std::string_view(left.name) == "quantities" ? of_forces : 0) << left.name;
        }
    }
}

TEST_F(GridThread, GivesTheCrossingsOfAProgramAlone) {
    using enum CrossingPlan::On;
    for (auto const on : {state, gap_y, gap_z}) {
        std::uint64_t crossings = 0;
        for (Parts const& parts : testing::all_parts()) {
            auto plan = testing::crossing_block(5, parts);
            plan.crossings.on = on;
            if (on != state) plan.crossings.level = 1e-4;  // m, of a slider in the middle of the way
            OwnedBlock block(plan);
            expect_as_alone(block, 3);
            for (std::size_t i = 0; i < plan.members.size(); ++i) crossings += block.record(i).crossings;
        }
        EXPECT_GT(crossings, 24u);
    }
}

TEST_F(GridThread, GivesTheHeldContactsOfAProgramAlone) {
    for (Parts const& parts : testing::all_parts()) {
        if (parts.law != Law::paper || parts.damping == Damping::restitution) continue;
        for (auto plan : {testing::sampled_block(5, parts), testing::shadowed_block(5, parts)}) {
            OwnedBlock passed(plan);
            plan.settings.locate_modes = true;
            OwnedBlock held(plan);
            expect_as_alone(held, 3);
            run_alone(passed);
            EXPECT_NE(difference(passed, held), "") << "contacts must change";
        }
    }
}

TEST_F(GridThread, AreAsManyAsYouLike) {
    auto const plan = testing::sampled_block(13, {Law::conservative, Damping::rate, true, false});
    for (int const threads : {1, 2, 13, 40}) {
        OwnedBlock block(plan);
        expect_as_alone(block, threads);
    }
    OwnedBlock lone(testing::sampled_block(1, plan.parts));
    expect_as_alone(lone, 5);
    GridState state;
    OwnedBlock empty{BlockPlan{}};
    testing::run_grid_thread({empty.block, &state, {}}, false);
    EXPECT_EQ(state.lane_steps_executed, 0u);
}

/// These programs look at what kernels expect of their callers.
TEST_F(GridThread, EndsWithThePlaceOfABlockThatIsNotWhole) {
    using Flaw = void (*)(Block&);
    auto const plan = testing::shadowed_block(1, {Law::conservative, Damping::rate, true, false});
    std::pair<Flaw, char const*> const flaws[] = {{[](Block& b) { b.records = nullptr; }, "records"},
                                                  {[](Block& b) { b.settings.rtol = 0; }, "rtol"},
                                                  {[](Block& b) { b.clocks = nullptr; }, "clocks"},
                                                  {[](Block& b) { b.shadows.count = most_shadows + 1; }, "most_shadows"}};
    for (auto const& [flaw, name] : flaws) {
        OwnedBlock owned(plan);
        flaw(owned.block);
        GridState state;
        EXPECT_DEATH(testing::run_grid_thread({owned.block, &state, plan.parts}, true), std::string("integrate.hpp:[0-9]+: expected: .*") + name);
    }
}

TEST_F(GridThread, HandsEveryMemberToOneThread) {
    constexpr std::size_t members = 20'000;
    Block block;
    block.members = members;
    GridState state;
    std::vector<std::atomic<int>> visits(members);
    auto const visit = [&](Block& mine) {
        for (std::uint64_t place; (place = fetch_add(*mine.taken, 1)) < members;) {
            ++visits[place];
            mine.lane_steps_executed += 3;
            mine.lane_steps_useful += 2;
        }
    };
    std::vector<std::thread> grid;
    for (int i = 0; i < 8; ++i) grid.emplace_back([&] { run_thread({block, &state, {}}, visit); });
    for (std::thread& thread : grid) thread.join();
    EXPECT_TRUE(std::ranges::all_of(visits, [](auto const& count) { return count == 1; }));
    EXPECT_EQ(state.lane_steps_executed, 3 * members);
    EXPECT_EQ(state.lane_steps_useful, 2 * members);
}

TEST_F(GridThread, TakesMembersInTheBlocksOrder) {
    auto plan = testing::sampled_block(9, {Law::paper, Damping::point, true, false});
    plan.settings.end_time = 2e-3;
    plan.order = {4, 0, 8, 2, 6, 1, 3, 7, 5};
    OwnedBlock owned(plan);
    struct Ends {
        OwnedBlock const& owned;
        std::vector<std::uint32_t> in_turn;
    } ends{owned, {}};
    owned.block.stop = [](void const* context, double) {
        auto& seen = *static_cast<Ends*>(const_cast<void*>(context));
        for (std::uint32_t i = 0; i < seen.owned.block.members; ++i) {
            bool const is_new = std::ranges::find(seen.in_turn, i) == seen.in_turn.end();
            if (is_new && seen.owned.record(i).status != Status::not_run) seen.in_turn.push_back(i);
        }
        return false;
    };
    owned.block.stop_context = &ends;
    run_grid(owned, 1);
    owned.block.stop(&ends, 0);
    EXPECT_EQ(ends.in_turn, plan.order);
    OwnedBlock alone(plan), shared(plan);
    run_alone(alone);
    run_grid(shared, 4);
    EXPECT_EQ(difference(shared, alone), "");
}

TEST_F(GridThread, AFailingMemberChangesNoNeighbour) {
    Parts const parts{Law::conservative, Damping::point, true, true};
    auto const good = testing::sampled_block(10, parts);
    OwnedBlock alone(good);
    run_alone(alone);
    auto plan = good;
    auto lost = good.members[0], apart = good.members[1];
    lost.vy = NAN;
    apart.y = 1.0;  // beyond the rod's reach
    plan.members.insert(plan.members.begin() + 3, lost);
    plan.members.insert(plan.members.begin() + 7, apart);
    OwnedBlock shared(plan);
    run_grid(shared, 3);
    EXPECT_EQ(shared.record(3).status, Status::nonfinite);
    EXPECT_EQ(shared.record(7).status, Status::geometry);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(difference(alone, i, shared, i + (i < 3 ? 0 : i < 6 ? 1 : 2)), "");
    }

    // Half of the members spend their steps.
    std::vector<std::uint64_t> steps;
    for (std::size_t i = 0; i < 10; ++i)
        steps.push_back(alone.record(i).steps_accepted + alone.record(i).steps_rejected);
    auto sorted = steps;
    std::ranges::sort(sorted);
    auto few = good;
    few.settings.max_steps = sorted[5];
    OwnedBlock short_runs(few);
    run_grid(short_runs, 3);
    for (std::size_t i = 0; i < 10; ++i) {
        if (steps[i] > sorted[5]) {
            EXPECT_EQ(short_runs.record(i).status, Status::max_steps) << i;
        } else if (steps[i] < sorted[5]) {
            EXPECT_EQ(difference(alone, i, short_runs, i), "");
        }
    }
}

TEST_F(GridThread, AStopLeavesNoMemberHalfWritten) {
    constexpr std::array<std::string_view, 3> on_the_way = {"series", "sections", "growths"};
    for (bool const shadowed : {false, true}) {
        Parts const parts{Law::paper, Damping::point, true, false};
        auto const plan = shadowed ? testing::shadowed_block(30, parts) : testing::crossing_block(30, parts);
        OwnedBlock alone(plan), stopped(plan);
        run_alone(alone);
        // A thread that has asked often raises the flag of all.
        struct Flag {
            std::atomic<int> asked = 0;
            int raised = 0;
        } flag;
        stopped.block.stop_flag = &flag.raised;
        stopped.block.stop_context = &flag;
        stopped.block.stop = [](void const* context, double) {
            auto& mine = *static_cast<Flag*>(const_cast<void*>(context));
            if (++mine.asked == 120) std::atomic_ref(mine.raised).store(1);
            return false;
        };
        run_grid(stopped, 3);
        int ended = 0, begun = 0, untouched = 0;
        for (std::size_t i = 0; i < plan.members.size(); ++i) {
            if (stopped.record(i).status != Status::not_run) {
                ++ended;
                EXPECT_EQ(difference(stopped, i, alone, i), "");
                continue;
            }
            auto const left = stopped.left_by(i);
            bool const is_begun = std::isnan(left[3].numbers[0]);
            ++(is_begun ? begun : untouched);
            for (auto const& [name, numbers] : left) {
                bool const is_series = std::ranges::find(on_the_way, name) != on_the_way.end();
                double const expected = is_begun && is_series ? NAN : testing::untouched;
                if (std::string_view(name) == "record") {
                    EXPECT_EQ(std::ranges::count(numbers, 0.0), std::ptrdiff_t(numbers.size()) - 1)
                        << "after the status";
                    continue;
                }
                EXPECT_TRUE(std::ranges::all_of(numbers, [&](double x) { return testing::same_number(x, expected); }))
                    << name << " of member " << i;
            }
        }
        EXPECT_GT(ended, 0);
        EXPECT_GT(begun, 0);
        EXPECT_LE(begun, 3);
        EXPECT_GT(untouched, 0);
    }
}

}  // namespace
}  // namespace slideway::grid_thread_test
