#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "host/study/study_run.hpp"

namespace slideway::run_part_test {
namespace {

RunPart part(std::uint64_t number, std::uint64_t parts) { return {number, parts, true}; }

/// Evenly, completely, disjointly, and in order.
void expect_divided(MemberSet const& members, std::uint64_t parts) {
    std::uint64_t const share = members.count() / parts;
    std::uint64_t larger = 0, done = 0;
    MemberSet all;
    for (std::uint64_t number = 1; number <= parts; ++number) {
        MemberSet const mine = part(number, parts).of(members);
        ASSERT_TRUE(mine.common(all).empty()) << number << '/' << parts << " of " << members.text();
        ASSERT_TRUE(mine.count() == share || mine.count() == share + 1) << number << '/' << parts;
        larger += mine.count() > share;
        if (!mine.empty()) {
            ASSERT_EQ(members.place(mine.ranges().front().first), done);
        }
        done += mine.count();
        all.add(mine);
    }
    ASSERT_EQ(all, members) << parts;
    ASSERT_EQ(larger, members.count() % parts);
}

TEST(RunPart, DividesEveryRange) {
    for (std::uint64_t count = 0; count < 40; ++count) {
        for (std::uint64_t parts = 1; parts < 45; ++parts) expect_divided(MemberSet({7, count}), parts);
    }
}

TEST(RunPart, DividesEverySet) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint64_t> members(random() % 50);
        for (std::uint64_t& m : members) m = random() % 120;
        expect_divided(MemberSet::of(members), 1 + random() % 20);
    }
}

TEST(RunPart, DividesMoreMembersThanAProductHolds) {
    std::uint64_t const most = 18446744073709551615u;  // 2^64 - 1
    MemberSet const all({0, most});
    MemberSet const last = part(4294967295u, 4294967295u).of(all);
    // 2^64 - 1 = (2^32 - 1) (2^32 + 1)
    EXPECT_EQ(last, MemberSet({most - 4294967297u, 4294967297u}));
    EXPECT_EQ(part(2, 3).of(all), MemberSet({most / 3, most / 3}));
}

TEST(RunPart, OfNoArrayIsTheWhole) {
    MemberSet const members({3, 9});
    EXPECT_EQ(RunPart().of(members), members);
    EXPECT_EQ(RunPart().name(), "");
    EXPECT_EQ(part(1, 1).of(members), members);
    EXPECT_EQ(part(1, 1).name(), "1-of-1");
    EXPECT_EQ(part(3, 8).name(), "3-of-8");
}

}  // namespace
}  // namespace slideway::run_part_test
