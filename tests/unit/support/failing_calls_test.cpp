// The tool of cli_failing_calls_test: calls that are told to fail do so, others do not.
#include "tests/support/failing_calls.hpp"

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/mpirun.hpp"

namespace slideway::testing::failing_calls_test {
namespace {

class FailingCalls : public ::testing::Test {
protected:
    FailingCalls()
        : folder_(std::filesystem::temp_directory_path() / ("slideway_failing_" + std::to_string(getpid()))) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_ / "disk");
        std::filesystem::create_directories(folder_ / "elsewhere");
    }
    ~FailingCalls() override { std::filesystem::remove_all(folder_); }

    /// Commands of a shell in disk/ there, which opens and writes files itself.
    ShellOutcome commands(std::string const& text, std::uint64_t at = 0, DiskFailure const& failure = {}) {
        std::filesystem::remove(folder_ / "count");
        auto const outcome =
            run_shell(folder_ / "elsewhere", "cd ../disk; " +
                                                 with_failing_calls(folder_ / "disk", folder_ / "count", at, failure) +
                                                 "sh -c '" + text + "'");
        counts_ = call_counts(folder_ / "count");
        return outcome;
    }
    std::string text(char const* name) const {
        std::ifstream in(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    bool exists(char const* name) const { return std::filesystem::exists(folder_ / name); }
    CallCounts counts() const { return counts_; }

private:
    std::filesystem::path folder_;
    CallCounts counts_;
};

TEST_F(FailingCalls, AreCountedUnderTheirFolderAlone) {
    EXPECT_EQ(commands("echo abcdef >f; echo x >>f; read y <f; echo z >../elsewhere/g").code, 0);
    EXPECT_EQ(counts().counted, 4u);  // two are opened to write, two written
    EXPECT_EQ(counts().failed, 0u);
    EXPECT_EQ(text("disk/f"), "abcdef\nx\n");
    EXPECT_EQ(text("elsewhere/g"), "z\n");
}

TEST_F(FailingCalls, FailWithTheirErrorFromThenOnOrOnce) {
    // The calls: open a, write a, open b, write b.
    std::string const two = "echo a >a || :; echo b >b || :";
    auto const full = commands(two, 2);
    EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
    EXPECT_EQ(text("disk/a"), "");
    EXPECT_FALSE(exists("disk/b"));
    EXPECT_EQ(counts().failed, counts().counted - 1);
    auto const hiccup = commands(two, 2, {.error = "EIO", .once = true});
    EXPECT_NE(hiccup.err.find("I/O error"), std::string::npos) << hiccup.err;
    EXPECT_EQ(text("disk/a"), "");
    EXPECT_EQ(text("disk/b"), "b\n");
    EXPECT_EQ(counts().failed, 1u);
}

TEST_F(FailingCalls, WriteHalfBeforeTheyFail) {
    commands("echo abcdefg >f", 2, {.is_short = true});
    EXPECT_EQ(text("disk/f"), "abcd");
    EXPECT_GE(counts().failed, 1u);
}

TEST_F(FailingCalls, AreOfTheFamiliesAskedFor) {
    EXPECT_EQ(commands("echo a >f; mkdir d; mv f d/g; ln d/g h; rm h; rmdir d/none 2>/dev/null || :", 0,
                       {.calls = "rename,mkdir,link,unlink"})
                  .code,
              0);
    EXPECT_EQ(counts().counted, 1u + 1 + 1 + 1 + 1);  // mkdir, rename, link, unlink, rmdir
    EXPECT_NE(commands("mv d/g i", 1, {.calls = "rename"}).code, 0);
    EXPECT_TRUE(exists("disk/d/g"));
}

}  // namespace
}  // namespace slideway::testing::failing_calls_test
