#include "host/run/ensemble.hpp"

#include <gtest/gtest.h>

namespace slideway::block_sizes_test {
namespace {

BlockSizes sizes_of(std::size_t lanes) {
    BlockSizes sizes;
    sizes.bounds.lanes = lanes;
    sizes.bounds.least = 8 * lanes;
    sizes.bounds.most = 4096;
    sizes.seconds = 2;
    return sizes;
}

TEST(BlockSizes, AreMultiplesOfTheLanesWithinTheMemory) {
    for (std::size_t const lanes : {1, 2, 4, 8}) {
        for (int const workers : {1, 3, 64, 1000}) {
            for (std::uint64_t const members : {1u, 10u, 1024u, 1000000u}) {
                BlockSizer sizer(sizes_of(lanes), members, workers);
                for (double const seconds : {0.0, 1e-6, 1.0, 1e6}) {
                    sizer.measured(seconds > 0 ? 10 : 0, seconds, 1);
                    for (std::uint64_t left = members; left > 0; left /= 3) {
                        std::uint64_t const size = sizer.next(left);
                        EXPECT_GE(size, lanes);
                        EXPECT_LE(size, 4096u);
                        EXPECT_EQ(size % lanes, 0u) << size;
                    }
                }
            }
        }
    }
}

TEST(BlockSizes, GiveEveryWorkerOfASmallEnsembleItsShare) {
    EXPECT_EQ(BlockSizer(sizes_of(8), 1024, 4).next(1024), 128u);  // two blocks for each worker
    EXPECT_EQ(BlockSizer(sizes_of(8), 256, 2).next(256), 64u);     // eight members for each lane
    EXPECT_EQ(BlockSizer(sizes_of(8), 32, 4).next(32), 8u);        // every worker gets one
    EXPECT_EQ(BlockSizer(sizes_of(8), 8, 4).next(8), 8u);          // lanes are not left half empty
    EXPECT_EQ(BlockSizer(sizes_of(1), 7, 1).next(7), 7u);
}

TEST(BlockSizes, OfALargeEnsembleBeginWithATrial) {
    // 16 blocks of eight members a lane for each worker are there to spare: 16 · 64 · 4 = 4096.
    EXPECT_EQ(BlockSizer(sizes_of(8), 1'000'000, 4).next(1'000'000), 64u);
    EXPECT_EQ(BlockSizer(sizes_of(8), 4096, 4).next(4096), 64u);
    EXPECT_EQ(BlockSizer(sizes_of(8), 4095, 4).next(4095), 512u);
}

TEST(BlockSizes, TakeTheTimeThatABlockShould) {
    BlockSizer sizer(sizes_of(8), 1'000'000, 4);
    sizer.measured(64, 0.128, 1);  // 2 ms a member: 1000 in two seconds
    EXPECT_EQ(sizer.next(1'000'000), 1000u);
    sizer.measured(1000, 4, 1);              // 4 ms: the latest counts
    EXPECT_EQ(sizer.next(1'000'000), 504u);  // 500 in whole packs of eight
    sizer.measured(504, 504e-9, 1);
    EXPECT_EQ(sizer.next(1'000'000), 4096u);  // no more than fit
    sizer.measured(64, 640, 1);
    EXPECT_EQ(sizer.next(1'000'000), 64u);  // no fewer than keep the lanes busy
}

TEST(BlockSizes, AreLargeBesideWhatTheirEndsLeaveIdle) {
    BlockSizer sizer(sizes_of(8), 1'000'000, 4);
    sizer.measured(64, 64, 0.8);  // lanes stood idle for a quarter of 64 members' work, and 40 times that is 640
    EXPECT_EQ(sizer.next(1'000'000), 640u);
    sizer.measured(640, 640, 1);  // the dearest end counts
    EXPECT_EQ(sizer.next(1'000'000), 640u);
    EXPECT_EQ(sizer.next(40), 16u);  // a worker's share at most, in whole packs
    sizer.measured(640, 640, 0.5);   // 640 idle members ask for more than fits the memory
    EXPECT_EQ(sizer.next(1'000'000), 4096u);
}

TEST(BlockSizes, IgnoreAMeasurementOfNothing) {
    BlockSizer sizer(sizes_of(8), 1'000'000, 4);
    sizer.measured(0, 1, 1);
    sizer.measured(64, 0, 1);
    sizer.measured(64, 1, 0);
    EXPECT_EQ(sizer.next(1'000'000), 64u);
}

TEST(BlockSizes, ShrinkTowardsTheEnd) {
    BlockSizer sizer(sizes_of(8), 100'000, 4);
    sizer.measured(64, 64e-6, 1);
    std::uint64_t left = 100'000, before = 4096, blocks_of_the_end = 0;
    while (left > 0) {
        std::uint64_t const size = sizer.next(left);
        EXPECT_LE(size, before);
        // Half of a worker's share of what is left, or as few as keep the lanes busy.
        EXPECT_LE(size, std::max<std::uint64_t>(left / 8 + 8, 64));
        before = size;
        blocks_of_the_end += left <= 1024;
        left -= std::min(left, size);
    }
    EXPECT_GE(blocks_of_the_end, 8u);  // two for each worker at least
    EXPECT_EQ(before, 8u);
}

/// A card: 32 threads go together, and it takes thousands of them to fill it.
BlockSizes sizes_of_card(std::size_t most) {
    BlockSizes sizes;
    sizes.bounds.lanes = 32;
    sizes.bounds.least = 33'792;
    sizes.bounds.most = most;
    sizes.bounds.shared = true;
    sizes.seconds = 10;
    return sizes;
}

TEST(BlockSizes, OfACardFillItWhateverTheWorkers) {
    for (int const workers : {1, 2, 4, 64}) {
        for (std::uint64_t const members : {20'000u, 100'000u, 10'000'000u}) {
            BlockSizer sizer(sizes_of_card(135'168), members, workers);
            // From the first to the last: a small kernel takes as long as one that fills the card.
            for (std::uint64_t left = members; left > 0; left -= std::min(left, sizer.next(left))) {
                EXPECT_EQ(sizer.next(left), 33'792u);
            }
            sizer.measured(33'792, 1e4, 1);
            EXPECT_EQ(sizer.next(members), 33'792u);
            sizer.measured(33'792, 5, 1);
            EXPECT_EQ(sizer.next(members), 67'584u);  // twice the time
            sizer.measured(33'792, 0.1, 1);
            EXPECT_EQ(sizer.next(members), 135'168u);
        }
    }
}

TEST(BlockSizes, NeverExceedTheMemory) {
    for (std::size_t const most : {1, 3, 31, 33, 1000}) {
        for (std::uint64_t const members : {1u, 100u, 1'000'000u}) {
            BlockSizer sizer(sizes_of_card(most), members, 4);
            EXPECT_LE(sizer.next(members), most);
            sizer.measured(most, 1e-9, 0.5);
            EXPECT_LE(sizer.next(members), most);
        }
    }
}

TEST(BlockSizes, AreWhatWasAskedFor) {
    BlockSizes sizes = sizes_of(8);
    sizes.fixed = 37;
    BlockSizer sizer(sizes, 1'000'000, 4);
    EXPECT_EQ(sizer.next(1'000'000), 37u);
    sizer.measured(37, 1000, 1);
    EXPECT_EQ(sizer.next(1), 37u);
}

}  // namespace
}  // namespace slideway::block_sizes_test
