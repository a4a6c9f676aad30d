#include "host/base/error.hpp"

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::error_test {
namespace {

TEST(Errors, AreOneLineWhateverIsInThem) {
    EXPECT_STREQ(SceneError("a\nb\r\x1b[1m\x7f.toml: no").what(), "a\\u000ab\\u000d\\u001b[1m\\u007f.toml: no");
    EXPECT_STREQ(FileError("\t").what(), "\\u0009");
}

TEST(Errors, KeepOtherCharacters) {
    EXPECT_STREQ(SceneError("mü \xc2\xa0 \xe2\x82\xac").what(), "mü \xc2\xa0 \xe2\x82\xac");
}

TEST(Errors, OfUnitsShowWhatStandsThere) {
    try {
        testing::scene_of("schema = 1\n[joint]\nclearance = \"1 \\u0001m\"\n");
        FAIL();
    } catch (SceneError const& error) {
        EXPECT_NE(std::string(error.what()).find("no unit \"\\u0001m\""), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace slideway::error_test
