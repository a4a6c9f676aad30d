#include "host/run/shared_block.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "kernels/laws/list.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::shared_block_test {
namespace {

/// What threads did to a block: who took which member.
struct Seen {
    std::mutex mutex;
    std::multiset<std::uint64_t> members;
    std::set<std::thread::id> threads;
    std::vector<std::size_t> seats;
};

/// Takes members as a pack of lanes does: as many as it has seats for at once, then one by one.
BlockKernel taking(Seen& seen) {
    return [&](Block& block) {
        {
            std::lock_guard const lock(seen.mutex);
            seen.threads.insert(std::this_thread::get_id());
            seen.seats.push_back(block.seats);
        }
        std::uint64_t own = 0;
        for (;;) {
            std::uint64_t const place = block.taken != nullptr ? __atomic_fetch_add(block.taken, 1, __ATOMIC_RELAXED) : own++;
            if (place >= block.members) break;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
            std::lock_guard const lock(seen.mutex);
            seen.members.insert(place);
            block.lane_steps_executed += 2;
            block.lane_steps_useful += 1;
        }
    };
}

Block block_of(std::size_t members) {
    Block block;
    block.members = members;
    return block;
}

/// Never given up.
bool run_shared(BlockKernel const& kernel, int threads, std::size_t lanes, Block& block) {
    return SharedBlockKernel(kernel, threads, lanes, {1e9, 1e9}).run(block);
}

TEST(SharedBlock, GivesEveryMemberToOneThread) {
    Seen seen;
    auto block = block_of(40);
    run_shared(taking(seen), 3, 8, block);
    EXPECT_EQ(seen.members.size(), 40u);
    EXPECT_EQ(std::set(seen.members.begin(), seen.members.end()).size(), 40u);
    EXPECT_EQ(seen.threads.size(), 3u);
    EXPECT_EQ(block.lane_steps_executed, 80u);
    EXPECT_EQ(block.lane_steps_useful, 40u);
}

TEST(SharedBlock, FillsPacksBeforeItTakesThreads) {
    for (std::size_t const members : {1, 8}) {
        Seen seen;
        auto block = block_of(members);
        run_shared(taking(seen), 4, 8, block);
        EXPECT_EQ(seen.threads.size(), 1u) << members;
        EXPECT_EQ(seen.members.size(), members);
    }
    Seen seen;
    auto block = block_of(17);
    run_shared(taking(seen), 4, 8, block);
    EXPECT_EQ(seen.seats, std::vector<std::size_t>(3, 8)) << "three packs, one for each";
}

TEST(SharedBlock, NoThreadBeginsWithMoreThanItsShare) {
    Seen seen;
    auto block = block_of(100);
    run_shared(taking(seen), 2, 8, block);
    EXPECT_EQ(seen.seats, std::vector<std::size_t>(2, 56)) << "thirteen packs, seven for each";
}

TEST(SharedBlock, IsStoppedForAllWithWhatAllCovered) {
    std::atomic<double> most = 0;
    auto block = block_of(100);
    struct Context {
        std::atomic<double>* most;
    } const context{&most};
    block.stop_context = &context;
    block.stop = [](void const* c, double covered) {
        auto& largest = *static_cast<Context const*>(c)->most;
        if (covered > largest) largest = covered;
        return covered >= 5;
    };
    std::atomic<int> ended = 0;
    BlockKernel const kernel = [&](Block& part) {
        // Each covers three of its own at most: five are reached by both together alone.
        double covered = 0;
        auto const until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!part.stop(part.stop_context, covered) && std::chrono::steady_clock::now() < until) {
            covered = std::min(covered + 0.5, 3.0);
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        }
        if (std::chrono::steady_clock::now() < until) ++ended;
    };
    run_shared(kernel, 2, 8, block);
    EXPECT_EQ(ended, 2);
    EXPECT_GE(most.load(), 5);
}

/// Covers `rate` members a second until it is told to stop, or all are.
BlockKernel covering(double rate) {
    return [=](Block& part) {
        auto const begin = std::chrono::steady_clock::now();
        for (double covered = 0; covered < 40;) {
            covered = rate * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            if (part.stop(part.stop_context, std::min(covered, 40.0))) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    };
}

TEST(SharedBlock, IsGivenUpWhereItWouldTakeLong) {
    auto block = block_of(80);
    auto const begin = std::chrono::steady_clock::now();
    // 80 members at 2 · 4 a second: ten seconds.
    EXPECT_TRUE(SharedBlockKernel(covering(4), 2, 8, {0.1, 5}).run(block));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_FALSE(SharedBlockKernel(covering(200), 2, 8, {0.1, 5}).run(block)) << "half a second";
}

TEST(SharedBlock, ThrowsOnWhatOneThreadThrewAndEndsTheOthers) {
    std::atomic<bool> thrown = false;
    BlockKernel const kernel = [&](Block& part) {
        if (!thrown.exchange(true)) throw std::runtime_error("a kernel's");
        while (!part.stop(part.stop_context, 0)) std::this_thread::yield();
    };
    auto block = block_of(64);
    EXPECT_THROW(run_shared(kernel, 2, 8, block), std::runtime_error);
}

TEST(SharedBlock, GivesMembersTheBitsThatTheyHaveAlone) {
    auto const plan = testing::sampled_block(70, {Law::conservative, Damping::rate, true, true});
    for (Isa const isa : {Isa::scalar, best_isa()}) {
        testing::OwnedBlock alone(plan), shared(plan);
        auto const kernel = cpu_backend(isa)->kernel(plan.parts, false);
        kernel(alone.block);
        run_shared(kernel, 3, static_cast<std::size_t>(lanes_of(isa)), shared.block);
        for (std::size_t i = 0; i < plan.members.size(); ++i) {
            EXPECT_EQ(difference(shared, i, alone, i), "") << name_of(isa) << ", member " << i;
        }
        EXPECT_EQ(shared.block.lane_steps_useful, alone.block.lane_steps_useful);
    }
}

}  // namespace
}  // namespace slideway::shared_block_test
