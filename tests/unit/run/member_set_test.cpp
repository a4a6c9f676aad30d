// Sets of members against std::set, over universes small enough to try much.
#include "host/run/member_set.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace slideway::member_set_test {
namespace {

using Plain = std::set<std::uint64_t>;

MemberSet set_of(Plain const& members) {
    std::vector<std::uint64_t> const list(members.begin(), members.end());
    return MemberSet::of(list);
}

Plain plain_of(MemberSet const& set) {
    Plain members;
    for (MemberRange const& range : set.ranges()) {
        for (std::uint64_t m = range.first; m < range.end(); ++m) members.insert(m);
    }
    return members;
}

/// Ascending, none empty, with a gap between any two: so equal sets have equal ranges.
void expect_canonical(MemberSet const& set) {
    std::uint64_t least = 0;
    for (MemberRange const& range : set.ranges()) {
        EXPECT_GT(range.count, 0u);
        EXPECT_GE(range.first, least);
        least = range.end() + 1;
    }
}

/// The set whose members are the bits of a number.
Plain bits(unsigned number) {
    Plain members;
    for (unsigned bit = 0; bit < 8; ++bit) {
        if ((number >> bit & 1) != 0) members.insert(bit);
    }
    return members;
}

TEST(MemberSet, TakesAnyRangeIntoAnySet) {
    for (unsigned number = 0; number < 256; ++number) {
        for (std::uint64_t first = 0; first < 9; ++first) {
            for (std::uint64_t count = 0; count < 4; ++count) {
                Plain expected = bits(number);
                for (std::uint64_t m = first; m < first + count; ++m) expected.insert(m);
                MemberSet set = set_of(bits(number));
                set.add({first, count});
                expect_canonical(set);
                EXPECT_EQ(plain_of(set), expected) << number << ' ' << first << ' ' << count;
                EXPECT_EQ(set, set_of(expected));
            }
        }
    }
}

TEST(MemberSet, UnitesIntersectsAndSubtractsAnyTwoSets) {
    for (unsigned a = 0; a < 256; ++a) {
        for (unsigned b = 0; b < 256; ++b) {
            MemberSet const one = set_of(bits(a)), other = set_of(bits(b));
            MemberSet both = one;
            both.add(other);
            ASSERT_EQ(plain_of(both), bits(a | b));
            ASSERT_EQ(plain_of(one.without(other)), bits(a & ~b));
            ASSERT_EQ(plain_of(one.common(other)), bits(a & b));
            ASSERT_EQ(one.overlaps(other), (a & b) != 0);
            for (MemberSet const& set : {both, one.without(other), one.common(other)}) expect_canonical(set);
        }
    }
}

TEST(MemberSet, CountsFindsAndPlacesItsMembers) {
    for (unsigned number = 0; number < 256; ++number) {
        Plain const plain = bits(number);
        MemberSet const set = set_of(plain);
        EXPECT_EQ(set.count(), plain.size());
        EXPECT_EQ(set.empty(), plain.empty());
        for (std::uint64_t m = 0; m < 10; ++m) {
            EXPECT_EQ(set.contains(m), plain.contains(m));
            EXPECT_EQ(set.place(m), static_cast<std::uint64_t>(std::distance(plain.begin(), plain.lower_bound(m))));
        }
        std::vector<std::uint64_t> const all(plain.begin(), plain.end());
        for (std::uint64_t offset = 0; offset < 10; ++offset) {
            for (std::uint64_t count = 0; count < 10; ++count) {
                auto const from = std::min<std::size_t>(offset, all.size()),
                           to = std::min<std::size_t>(from + count, all.size());
                EXPECT_EQ(set.members(offset, count),
                          std::vector<std::uint64_t>(all.begin() + static_cast<std::ptrdiff_t>(from),
                                                     all.begin() + static_cast<std::ptrdiff_t>(to)));
            }
        }
    }
}

TEST(MemberSet, IsTheSameWhateverTheOrderOfItsMembers) {
    std::vector<std::uint64_t> members(200);
    std::mt19937_64 random(7);
    for (std::uint64_t& m : members) m = random() % 300;
    MemberSet const sorted = set_of(Plain(members.begin(), members.end()));
    EXPECT_EQ(MemberSet::of(members), sorted);
    MemberSet grown;
    for (std::uint64_t const m : members) grown.add({m, 1});
    EXPECT_EQ(grown, sorted);
}

TEST(MemberSet, HoldsTrillionsInOneRange) {
    std::uint64_t const many = 3'000'000'000'000;
    MemberSet set({0, many});
    EXPECT_EQ(set.ranges().size(), 1u);
    set = set.without(MemberSet({many / 2, 10}));
    EXPECT_EQ(set.count(), many - 10);
    EXPECT_EQ(set.members(many / 2, 1), std::vector<std::uint64_t>{many / 2 + 10});
    EXPECT_EQ(set.place(many), many - 10);
}

TEST(MemberSet, HasATextThatReadsBack) {
    EXPECT_EQ(MemberSet().text(), "");
    EXPECT_EQ(MemberSet({7, 1}).text(), "7");
    MemberSet set({0, 512});
    set.add({600, 1});
    set.add({700, 100});
    EXPECT_EQ(set.text(), "0-511,600,700-799");
    for (unsigned number = 0; number < 256; ++number) {
        MemberSet const any = set_of(bits(number));
        auto const back = MemberSet::parse(any.text());
        ASSERT_TRUE(back.has_value()) << any.text();
        EXPECT_EQ(*back, any);
    }
}

TEST(MemberSet, RefusesWhatIsNoText) {
    for (char const* const text : {"x",
                                   "1-",
                                   "-",
                                   "-1",
                                   "1--2",
                                   "3-2",
                                   ",",
                                   "1,",
                                   ",1",
                                   "1,,2",
                                   "1 ,2",
                                   " 1",
                                   "1 ",
                                   "+1",
                                   "1;2",
                                   "0x10",
                                   "1.5",
                                   "1-2-3",
                                   "1e3",
                                   "99999999999999999999",
                                   "0-99999999999999999999"}) {
        EXPECT_FALSE(MemberSet::parse(text).has_value()) << text;
    }
}

TEST(MemberSet, RefusesAMemberBehindWhichThereIsNoNumber) {
    // 2^64 - 1: the end of its range would be 2^64.
    for (char const* const text : {"18446744073709551615", "0-18446744073709551615", "5,7-18446744073709551615"}) {
        EXPECT_FALSE(MemberSet::parse(text).has_value()) << text;
    }
    auto const last = MemberSet::parse("0-18446744073709551614");
    ASSERT_TRUE(last.has_value());
    EXPECT_EQ(last->count(), 18446744073709551615u);
}

}  // namespace
}  // namespace slideway::member_set_test
