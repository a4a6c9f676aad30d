#include "host/run/member_queue.hpp"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::member_queue_test {
namespace {

TEST(LocalQueue, GivesEachPlaceOnceHoweverManyThreadsTake) {
    constexpr std::uint64_t places = 20011;
    for (int const threads : {1, 2, 8}) {
        LocalQueue queue(places);
        std::vector<std::vector<Stretch>> taken(static_cast<std::size_t>(threads));
        std::vector<std::thread> team;
        for (int t = 0; t < threads; ++t) {
            team.emplace_back([&queue, &mine = taken[static_cast<std::size_t>(t)], wanted = 1 + t % 3] {
                for (;;) {
                    Stretch const stretch = queue.take(static_cast<std::uint64_t>(wanted), 0);
                    if (stretch.count == 0) return;
                    mine.push_back(stretch);
                }
            });
        }
        for (std::thread& thread : team) thread.join();
        std::vector<int> times(places, 0);
        for (auto const& mine : taken) {
            for (Stretch const& stretch : mine) {
                for (std::uint64_t i = 0; i < stretch.count; ++i) ++times.at(stretch.first + i);
            }
        }
        EXPECT_EQ(times, std::vector<int>(places, 1));
        EXPECT_EQ(queue.left(), 0u);
    }
}

TEST(LocalQueue, GivesNoMoreThanThereAre) {
    LocalQueue queue(10);
    EXPECT_EQ(queue.left(), 10u);
    Stretch const most = queue.take(8, 0), rest = queue.take(8, 0), none = queue.take(8, 0);
    EXPECT_EQ(most.first, 0u);
    EXPECT_EQ(most.count, 8u);
    EXPECT_EQ(rest.first, 8u);
    EXPECT_EQ(rest.count, 2u);
    EXPECT_EQ(none.count, 0u);
    EXPECT_EQ(LocalQueue(0).take(1, 0).count, 0u);
}

TEST(LocalQueue, GivesNothingOnceItIsAbandoned) {
    LocalQueue queue(10);
    queue.take(3, 0);
    queue.abandon();
    EXPECT_EQ(queue.left(), 0u);
    EXPECT_EQ(queue.take(1, 0).count, 0u);
}

}  // namespace
}  // namespace slideway::member_queue_test
