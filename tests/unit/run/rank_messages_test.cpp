#include <cstring>
#include <new>

#include <gtest/gtest.h>

#include "host/backend/backend.hpp"
#include "host/base/error.hpp"
#include "host/run/rank_messages.hpp"

namespace slideway::rank_messages_test {
namespace {

EnsembleTotals totals_of(double seconds) {
    EnsembleTotals totals;
    totals.ended[static_cast<std::size_t>(Status::finished)] = 3;
    totals.steps_accepted = 7;
    totals.seconds = seconds;
    return totals;
}

TEST(RankMessages, SumWhatAllRanksCameTo) {
    EnsembleTotals const sum = sum_of({to_bytes(totals_of(1.5)), to_bytes(totals_of(4)), to_bytes(totals_of(2))});
    EXPECT_EQ(sum.done(), 9u);
    EXPECT_EQ(sum.steps_accepted, 21u);
    EXPECT_EQ(sum.seconds, 4);
}

/// The exit code at rank 0 is that of the error, whichever rank had it.
TEST(ErrorsOfRanks, AreOfTheirKindAtRankZero) {
    auto const again = [](auto const& error) { throw_again(to_bytes(std::make_exception_ptr(error))); };
    auto const expect_same = [&](auto const& error) {
        try {
            again(error);
            ADD_FAILURE();
        } catch (std::decay_t<decltype(error)> const& found) {
            EXPECT_EQ(typeid(found), typeid(error));
            EXPECT_STREQ(found.what(), error.what());
        }
    };
    expect_same(SceneError("s.toml:3: joint.clearance is 0"));
    expect_same(FileError("o.nc: disk full"));
    expect_same(DeviceError("cuda: the card is gone"));
    expect_same(std::bad_alloc());
    expect_same(std::runtime_error("no idea"));
    EXPECT_THROW(again(NoDevice("cuda: none")), DeviceError);
}

TEST(RankMessages, OfAnotherProgramAreRefused) {
    std::string const totals = to_bytes(totals_of(1));
    for (std::string const& bytes : {std::string(), std::string("+"), totals.substr(0, totals.size() - 1), totals + '+', std::string("s"), std::string("?what"),
                                     to_bytes(totals_of(-1))})
        EXPECT_THROW(sum_of({totals, bytes}), SceneError) << bytes;
    EnsembleTotals stopped = totals_of(1);
    stopped.stopped = static_cast<StopReason>(77);
    EXPECT_THROW(sum_of({to_bytes(stopped)}), SceneError);
}

TEST(RankMessages, ErrorsAreOneLine) {
    try {
        throw_again("sa\nb\x7f");
    } catch (SceneError const& error) {
        EXPECT_STREQ(error.what(), "a b ");
    }
}

TEST(RankMessages, AnInvitationReadsAsItWasWritten) {
    MemberSet todo({0, 16});
    todo.add({40, 24});
    for (Invitation const& invitation : {Invitation{"avx2", 48, todo}, Invitation{"sm_90", 0, {}}}) EXPECT_EQ(read_invitation(to_text(invitation)), invitation);
    EXPECT_EQ(to_text({"avx2", 48, todo}), "avx2 48 0-15,40-63");
    for (char const* const text : {"", "avx2", "avx2 48", " 48 0-15", "avx2 x 0-15", "avx2 48 15-0", "avx2 48 0-15 more"})
        EXPECT_THROW(read_invitation(text), SceneError) << text;
}

TEST(RankMessages, QuestionsThatNoRankAsksAreRefused) {
    for (Question const& question : {Question{}, Question{1, 2, Ask::abandon}, Question{0, message_limit, Ask::end}}) EXPECT_NO_THROW(require_sound(question));
    EXPECT_THROW(require_sound({0, message_limit + 1, Ask::end}), SceneError);
    EXPECT_THROW(require_sound({0, 0, static_cast<Ask>(3)}), SceneError);
}

}  // namespace
}  // namespace slideway::rank_messages_test
