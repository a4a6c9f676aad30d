#include "tests/system/kills.hpp"

namespace slideway::testing {
namespace {

TEST_F(KilledRun, GoesOnAfterTwoHundredKills) { kill_and_resume(200, {"--threads", "2", "--block-members", "8"}); }

}  // namespace
}  // namespace slideway::testing
