// What has to be a file, and is a pipe, a device or a folder: nobody waits for it.
#include "host/base/open_file.hpp"

#include <filesystem>
#include <istream>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/base/file_lock.hpp"
#include "host/store/netcdf_file.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::open_file_test {
namespace {

/// What a call refuses, in its line; "" if it does not.
template <class Call> std::string refusal(Call const& call) {
    try {
        call();
    } catch (FileError const& error) {
        return error.what();
    }
    return "";
}

class OpenedFile : public testing::OutputFolder {
protected:
    OpenedFile() { EXPECT_EQ(mkfifo(pipe_.c_str(), 0600), 0); }
    std::string const pipe_ = path("pipe");
};

TEST_F(OpenedFile, ThatIsAPipeIsRefusedByAllWhoReadOrWriteFiles) {
    std::string const line = pipe_ + ": is a device or a pipe; give the name of a file";
    EXPECT_EQ(refusal([&] { read_bytes(pipe_); }), line);
    EXPECT_EQ(refusal([&] { require_readable(pipe_); }), line);
    EXPECT_EQ(refusal([&] { file_stream(pipe_); }), line);
    EXPECT_EQ(refusal([&] { require_file(pipe_); }), line);
    EXPECT_EQ(refusal([&] { NetcdfFile::open(pipe_); }), line);
    EXPECT_EQ(refusal([&] { FileLock(pipe_, FileLock::Kind::alone, FileLock::Wait::no); }), line);
    EXPECT_EQ(refusal([&] { OpenFile(pipe_, O_WRONLY); }), line);
    std::filesystem::create_symlink(pipe_, path("file.tmp"));
    EXPECT_NE(refusal([&] { write_durably(path("file"), "text"); }), "");
    EXPECT_FALSE(is_file(pipe_));
}

TEST_F(OpenedFile, ThatIsADeviceOrAFolderIsRefused) {
    EXPECT_EQ(refusal([] { read_bytes("/dev/zero"); }), "/dev/zero: is a device or a pipe; give the name of a file");
    EXPECT_EQ(refusal([&] { read_bytes(folder()); }), folder() + ": is a folder; give the name of a file");
    EXPECT_NE(refusal([&] { read_bytes(path("none")); }).find("none: cannot open: No such file"), std::string::npos);
    EXPECT_NO_THROW(require_file(path("none"))) << "its library says so";
}

TEST_F(OpenedFile, ThatIsOneIsRead) {
    testing::put(path("file"), "one\ntwo\n");
    EXPECT_EQ(read_text(path("file")), "one\ntwo\n");
    std::string line;
    std::getline(*file_stream(path("file")), line);
    EXPECT_EQ(line, "one");
    std::filesystem::create_symlink(path("file"), path("link"));
    EXPECT_TRUE(is_file(path("link")));
}

TEST_F(OpenedFile, OfATextMayBeAPipeThatSomebodyWritesTo) {
    std::string text(300'003, 'a');
    int const reader = open(pipe_.c_str(), O_RDONLY | O_NONBLOCK), end = open(pipe_.c_str(), O_WRONLY);
    ASSERT_GE(end, 0);
    std::thread writer([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));  // who reads has to wait
        for (std::size_t at = 0; at < text.size();) at += static_cast<std::size_t>(std::max<ssize_t>(0, write(end, text.data() + at, text.size() - at)));
        close(end);
    });
    InputText const input = read_input(pipe_, 1 << 20);
    EXPECT_EQ(input.error, 0);
    EXPECT_TRUE(input.text == text);
    writer.join();
    close(reader);
}

TEST_F(OpenedFile, OfATextEndsAtOnceWhereNobodyWrites) {
    EXPECT_EQ(read_input(pipe_, 100).text, "");
    EXPECT_EQ(read_input("/dev/zero", 1000).text.size(), 1001u) << "no more than one byte beyond what was asked for";
    EXPECT_EQ(read_input(path("none"), 100).error, ENOENT);
    EXPECT_EQ(read_input(folder(), 100).error, EISDIR);
}

}  // namespace
}  // namespace slideway::open_file_test
