// Text of others on a terminal: nothing in it is obeyed.
#include "host/base/text.hpp"

#include <gtest/gtest.h>

#include "host/commands/commands.hpp"

namespace slideway::shown_test {
namespace {

TEST(ShownText, HasControlCharactersAsEscapes) {
    EXPECT_EQ(shown("a\nb\r\t\x1b[1m\x7f"), "a\\u000ab\\u000d\\u0009\\u001b[1m\\u007f");
    EXPECT_EQ(shown("\u0080 \u0085 \u009b2J \u009f"), "\\u0080 \\u0085 \\u009b2J \\u009f");
    EXPECT_EQ(shown(std::string_view("\0", 1)), "\\u0000");
}

/// Those of UAX #9, and the separators of lines and paragraphs.
TEST(ShownText, HasWhatTurnsItsDirectionAsEscapes) {
    EXPECT_EQ(shown("\u202ecn.eno\u202c"), "\\u202ecn.eno\\u202c");
    EXPECT_EQ(shown("\u061c\u200e\u200f\u202a\u202b\u202d\u2066\u2067\u2068\u2069"),
              "\\u061c\\u200e\\u200f\\u202a\\u202b\\u202d\\u2066\\u2067\\u2068\\u2069");
    EXPECT_EQ(shown("\u2028\u2029"), "\\u2028\\u2029");
}

/// A terminal that takes bytes for characters of Latin-1 obeys 0x9b.
TEST(ShownText, HasBytesThatAreNoUtf8AsEscapes) {
    EXPECT_EQ(shown("\x9b" "2J"), "\\x9b2J");
    EXPECT_EQ(shown("\xff\xc2"), "\\xff\\xc2");
    EXPECT_EQ(shown("\xe2\x80"), "\\xe2\\x80") << "a character that is cut off";
    EXPECT_EQ(shown("\xc0\x9b"), "\\xc0\\x9b") << "an overlong form";
}

TEST(ShownText, KeepsAllOtherCharacters) {
    for (std::string const text : {"", "mü € 𝛿 \u00a0 \u200d", "\\u009b", "العربية", "a b"}) {
        EXPECT_EQ(shown(text), text);
        EXPECT_TRUE(is_plain(text));
    }
    EXPECT_FALSE(is_plain("a\nb"));
}

TEST(ShownText, IsShownAgainAsItIs) {
    std::string const once = shown("a\x1b\u202e\xff\n");
    EXPECT_EQ(shown(once), once);
    EXPECT_EQ(shown_lines(once), once);
}

TEST(ShownText, OfSeveralLinesKeepsThem) { EXPECT_EQ(shown_lines("a\tb\nc\rd\u009b\n"), "a\tb\nc\\u000dd\\u009b\n"); }

TEST(ShownText, IsCutWhereItIsLong) {
    EXPECT_EQ(shown("aaaaaaaaaa", 4), "aaaaa...");
    EXPECT_EQ(shown("aaaa", 4), "aaaa");
    EXPECT_EQ(shown("\u009b\u009b", 4), "\\u009b...");
}

/// Of a command that a user copies from a terminal: bash reads the same bytes back.
TEST(ShownText, IsQuotedForAShellWithoutWhatATerminalObeys) {
    EXPECT_EQ(cli::shell_quoted("a b"), "'a b'");
    EXPECT_EQ(cli::shell_quoted("a\u009b'\\.toml"), "$'a\\302\\233\\047\\134.toml'");
    EXPECT_EQ(cli::shell_quoted("\u202e"), "$'\\342\\200\\256'");
    EXPECT_EQ(cli::shell_quoted("é"), "'é'");
}

}  // namespace
}  // namespace slideway::shown_test
