// Which members work together.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "kernels/lanes/roster.hpp"

namespace slideway::roster_test {
namespace {

constexpr int width = 4, seats = 16;
using TestRoster = Roster<seats, width>;
using Kind = TestRoster::Kind;

std::vector<int> chosen_of(TestRoster const& roster) {
    int chosen[width];
    int const count = roster.choose(chosen);
    return {chosen, chosen + count};
}

TEST(Roster, OfNobodyChoosesNobody) { EXPECT_TRUE(chosen_of(TestRoster()).empty()); }

TEST(Roster, TakesASingleMemberFromAnySeat) {
    for (int seat = 0; seat < seats; ++seat) {
        TestRoster roster;
        roster[seat] = {Kind::stiff, 0b101, 0.3};
        EXPECT_EQ(chosen_of(roster), std::vector{seat});
    }
}

TEST(Roster, LeadsWithTheMemberFurthestBehind) {
    TestRoster roster;
    for (int seat = 0; seat < seats; ++seat) roster[seat] = {Kind::explicit_pair, 0, 1.0 + (seat * 7) % seats};
    EXPECT_EQ(chosen_of(roster)[0], 0);
    roster[11].share = 0.5;
    EXPECT_EQ(chosen_of(roster)[0], 11);
}

TEST(Roster, PairsMembersThatTouchAlike) {
    TestRoster roster;
    for (int seat = 0; seat < seats; ++seat) {
        roster[seat] = {Kind::explicit_pair, seat % 3 == 0 ? 0xf0f0u : 0x0f0fu, seat == 6 ? 0.0 : 1.0};
    }
    auto const chosen = chosen_of(roster);
    ASSERT_EQ(chosen.size(), 4u);
    EXPECT_EQ(chosen[0], 6);
    for (int const seat : chosen) EXPECT_EQ(roster[seat].pattern, 0xf0f0u);
}

TEST(Roster, FillsUpWithTheNearestPatterns) {
    TestRoster roster;
    roster[0] = {Kind::explicit_pair, 0b0000, 0};
    roster[1] = {Kind::explicit_pair, 0b1111, 1};  // four contacts more
    roster[2] = {Kind::explicit_pair, 0b0001, 1};
    roster[3] = {Kind::explicit_pair, 0b0111, 1};
    roster[4] = {Kind::explicit_pair, 0b0011, 1};
    roster[5] = {Kind::explicit_pair, 0b0000, 1};
    auto const chosen = chosen_of(roster);
    EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()), (std::set{0, 5, 2, 4}));
}

TEST(Roster, NeverMixesKinds) {
    TestRoster roster;
    for (int seat = 0; seat < seats; ++seat) {
        roster[seat] = {seat % 2 == 0 ? Kind::stiff : Kind::explicit_pair, 0, seat == 3 ? 0.0 : 1.0};
    }
    for (int const seat : chosen_of(roster)) EXPECT_EQ(roster[seat].kind, Kind::explicit_pair);
}

TEST(Roster, PrefersAKindThatFillsAPack) {
    TestRoster roster;
    roster[0] = {Kind::stiff, 0, 0.0};  // furthest behind, but alone
    for (int seat = 1; seat < 6; ++seat) roster[seat] = {Kind::explicit_pair, 0, 1.0};
    EXPECT_EQ(chosen_of(roster).size(), 4u);
    EXPECT_EQ(roster[chosen_of(roster)[0]].kind, Kind::explicit_pair);
    // Where no kind does, the largest goes first.
    for (int seat = 3; seat < 6; ++seat) roster[seat] = {};
    EXPECT_EQ(chosen_of(roster), (std::vector{1, 2}));
}

TEST(Roster, ChoosesDistinctMembersOfOneKindAndAsManyAsThereAre) {
    std::mt19937 random(5);
    for (int round = 0; round < 20'000; ++round) {
        TestRoster roster;
        int of_kind[4] = {};
        for (int seat = 0; seat < seats; ++seat) {
            auto const kind = static_cast<Kind>(random() % 4);
            std::uint32_t const pattern = round % 2 == 0 ? 1u << (random() % 4) : static_cast<std::uint32_t>(random());
            roster[seat] = {kind, pattern, static_cast<double>(random() % 5)};
            ++of_kind[static_cast<int>(kind)];
        }
        auto const chosen = chosen_of(roster);
        ASSERT_FALSE(chosen.empty());
        auto const kind = roster[chosen[0]].kind;
        ASSERT_NE(kind, Kind::none);
        EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), chosen.size());
        for (int const seat : chosen) EXPECT_EQ(roster[seat].kind, kind);
        EXPECT_EQ(static_cast<int>(chosen.size()), std::min(width, of_kind[static_cast<int>(kind)]));
        int const most = std::max({of_kind[1], of_kind[2], of_kind[3]});
        EXPECT_TRUE(of_kind[static_cast<int>(kind)] >= std::min(width, most)) << "a fuller pack was to be had";
        // Nobody left out differs from the leader by less than one who was taken.
        auto const distance = [&](int seat) {
            return __builtin_popcount(roster[seat].pattern ^ roster[chosen[0]].pattern);
        };
        int farthest = 0;
        for (int const seat : chosen) farthest = std::max(farthest, distance(seat));
        for (int seat = 0; seat < seats; ++seat) {
            bool const taken = std::find(chosen.begin(), chosen.end(), seat) != chosen.end();
            if (!taken && roster[seat].kind == kind) {
                EXPECT_GE(distance(seat), farthest);
            }
        }
    }
}

}  // namespace
}  // namespace slideway::roster_test
