// Every call on files of a small run fails in turn, in every way: the whole sweep of tests/system/failing_calls_test.
#include "tests/system/disk_failures.hpp"

namespace slideway::testing::failing_calls_test {
namespace {

TEST_F(FailingDisk, FullFromAnyCallOnCostsNoResult) { EXPECT_GT(sweep({}, 1, 1), 100); }

TEST_F(FailingDisk, BrokenFromAnyCallOnCostsNoResult) { EXPECT_GT(sweep({.error = "EIO"}, 1, 1), 100); }

TEST_F(FailingDisk, FailingOnceAtAnyCallCostsNoResult) { EXPECT_GT(sweep({.error = "EIO", .once = true}, 1, 1), 100); }

TEST_F(FailingDisk, FullInTheMiddleOfAnyCallCostsNoResult) { EXPECT_GT(sweep({.is_short = true}, 1, 1), 100); }

TEST_F(FailingDisk, GoesOnAfterAnyWriteThatWasShort) {
    EXPECT_GT(sweep({.once = true, .is_short = true, .calls = "write"}, 1, 1), 50);
}

}  // namespace
}  // namespace slideway::testing::failing_calls_test
