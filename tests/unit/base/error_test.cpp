#include "host/base/error.hpp"

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::error_test {
namespace {

TEST(Errors, AreOneLineWhateverIsInThem) {
    EXPECT_STREQ(SceneError("a\nb\r\x1b[1m\x7f.toml: no").what(), "a\\x0ab\\x0d\\x1b[1m\\x7f.toml: no");
    EXPECT_STREQ(FileError("\t").what(), "\\x09");
}

TEST(Errors, KeepOtherCharacters) {
    EXPECT_STREQ(SceneError("mü \xc2\xa0 \xe2\x82\xac \xff").what(), "mü \xc2\xa0 \xe2\x82\xac \xff");
    EXPECT_STREQ(FileError("\xc2\x9b").what(), "\xc2\\x9b") << "U+009B begins a sequence of a terminal";
}

TEST(Errors, OfUnitsShowWhatStandsThere) {
    try {
        testing::scene_of("schema = 1\n[joint]\nclearance = \"1 \\u0001m\"\n");
        FAIL();
    } catch (SceneError const& error) {
        EXPECT_NE(std::string(error.what()).find("no unit \"\\x01m\""), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace slideway::error_test
