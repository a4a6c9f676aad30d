// Every call on files but those that write numbers fails in turn, and every so manieth of these.  The slow tests let
// every call fail.
#include "tests/system/disk_failures.hpp"

namespace slideway::testing::failing_calls_test {
namespace {

constexpr char const* rare_calls = "open,sync,rename,link,truncate,mkdir,unlink";

TEST_F(FailingDisk, FullFromAnyOtherCallOnCostsNoResult) { EXPECT_GT(sweep({.calls = rare_calls}, 1, 1), 20); }

TEST_F(FailingDisk, FailingOnceAtAnyOtherCallCostsNoResult) {
    EXPECT_GT(sweep({.error = "EIO", .once = true, .calls = rare_calls}, 1, 1), 20);
}

TEST_F(FailingDisk, FullFromAWriteOnCostsNoResult) { EXPECT_GT(sweep({.calls = "write"}, 1, 7), 10); }

TEST_F(FailingDisk, FailingOnceAtAWriteCostsNoResult) {
    EXPECT_GT(sweep({.error = "EIO", .once = true, .calls = "write"}, 3, 7), 10);
}

TEST_F(FailingDisk, FullInTheMiddleOfAWriteCostsNoResult) {
    EXPECT_GT(sweep({.is_short = true, .calls = "write"}, 5, 7), 10);
}

TEST_F(FailingDisk, GoesOnAfterAWriteThatWasShort) {
    EXPECT_GT(sweep({.once = true, .is_short = true, .calls = "write"}, 2, 5), 10);
}

/// Of one block, which goes into shards where no result can be made of it.
TEST_F(FailingDisk, AtAnyCallCostsNoShortRun) {
    options_ = "--threads 1";
    EXPECT_GT(sweep({.calls = rare_calls}, 1, 1), 5);
    EXPECT_GT(sweep({.error = "EIO", .once = true, .calls = rare_calls}, 1, 1), 5);
    EXPECT_GT(sweep({.error = "EIO", .once = true, .calls = "write"}, 1, 11), 3);
}

}  // namespace
}  // namespace slideway::testing::failing_calls_test
