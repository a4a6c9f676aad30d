#include "host/base/durable_file.hpp"

#include <sys/resource.h>

#include <csignal>

#include "host/base/error.hpp"
#include "host/store/run_identity.hpp"
#include "tests/support/output_fixture.hpp"

#include <sys/stat.h>
#include <thread>

namespace slideway::durable_file_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;

class DurableFile : public testing::OutputFolder {
protected:
    /// Names in the test's folder.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (auto const& entry : fs::directory_iterator(folder())) found.push_back(entry.path().filename().string());
        std::sort(found.begin(), found.end());
        return found;
    }
};

TEST_F(DurableFile, IsReplacedAsAWhole) {
    write_durably(path("a"), "a longer text that was there before");
    write_durably(path("a"), "short");
    EXPECT_EQ(bytes_of(path("a")), "short");
    EXPECT_EQ(names(), std::vector<std::string>{"a"});
    write_durably(path("a"), "");
    EXPECT_EQ(bytes_of(path("a")), "");
}

TEST_F(DurableFile, HoldsAnyBytes) {
    std::vector<std::byte> bytes(100'003);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 37 >> 2);
    write_durably(path("a"), bytes);
    EXPECT_EQ(read_bytes(path("a")), bytes);
    EXPECT_EQ(read_text(path("a")), bytes_of(path("a")));
}

TEST_F(DurableFile, IsSeenOldOrNewByWhoReadsMeanwhile) {
    std::string const old_text(50'000, 'o'), new_text(60'000, 'n');
    write_durably(path("a"), old_text);
    std::thread writer([&] {
        for (int i = 0; i < 20; ++i) write_durably(path("a"), i % 2 == 0 ? new_text : old_text);
    });
    for (int i = 0; i < 200; ++i) {
        std::string const seen = bytes_of(path("a"));
        EXPECT_TRUE(seen == old_text || seen == new_text) << seen.size();
    }
    writer.join();
}

TEST_F(DurableFile, NeedsAFolderAndLeavesNothingWithoutOne) {
    EXPECT_THROW(write_durably(path("none/a"), "text"), FileError);
    EXPECT_FALSE(exists("none"));
}

TEST_F(DurableFile, StaysAsItWasIfItCannotBePutInPlace) {
    fs::create_directories(path("a/inside"));
    EXPECT_THROW(write_durably(path("a"), "text"), FileError);
    EXPECT_TRUE(exists("a/inside"));
    EXPECT_EQ(names(), std::vector<std::string>{"a"});  // nothing beside it
}

TEST_F(DurableFile, StaysAsItWasIfThereIsNoRoom) {
    write_durably(path("a"), "before");
    // A limit of the process stands for a full disk.
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    auto const handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit const small{1000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(write_durably(path("a"), std::string(5000, 'x')), FileError);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(bytes_of(path("a")), "before");
    EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(DurableFile, OfAnotherHandIsRenamedOrStays) {
    testing::put(path("from"), "results");
    testing::put(path("to"), "former");
    rename_durably(path("from"), path("to"));
    EXPECT_EQ(bytes_of(path("to")), "results");
    EXPECT_FALSE(exists("from"));

    testing::put(path("from"), "results");
    fs::create_directories(path("taken/inside"));
    try {
        rename_durably(path("from"), path("taken"));
        FAIL() << "a folder was replaced";
    } catch (FileError const& error) {
        EXPECT_NE(std::string(error.what()).find("the results are in " + path("from")), std::string::npos);
    }
    EXPECT_EQ(bytes_of(path("from")), "results");
    EXPECT_THROW(rename_durably(path("none"), path("to")), FileError);
    EXPECT_EQ(bytes_of(path("to")), "results");
}

TEST_F(DurableFile, ThatIsMissingCannotBeRead) {
    EXPECT_THROW(read_bytes(path("none")), FileError);
    EXPECT_THROW(read_text(folder()), FileError);
    EXPECT_THROW(sync_folder(path("none")), FileError);
    EXPECT_NO_THROW(sync_folder(folder()));
}

TEST_F(DurableFile, IsThereOrNotOrThatCannotBeTold) {
    EXPECT_FALSE(is_there(path("none")));
    EXPECT_FALSE(is_there(path("none/of/them")));
    EXPECT_TRUE(is_there(folder()));
    std::filesystem::create_symlink(path("loop"), path("loop"));
    EXPECT_THROW(is_there(path("loop")), FileError);
}

TEST(BuildOf, ACommitThatSaysAllIsTheCommit) { EXPECT_EQ(build_of("60e6457", "/no/such/program"), "60e6457"); }

TEST_F(DurableFile, OfTheProgramTellsBuildsOfNoCommitApart) {
    // FNV-1a of 64 bits of "a" and of nothing, as its authors give them.
    testing::put(path("program"), "a");
    EXPECT_EQ(build_of("60e6457-dirty", path("program")), "60e6457-dirty-af63dc4c8601ec8c");
    testing::put(path("program"), "");
    EXPECT_EQ(build_of("unknown", path("program")), "unknown-cbf29ce484222325");
}

TEST(FolderOf, IsTheOneThatAPathLiesIn) {
    EXPECT_EQ(folder_of("a/b.nc"), "a");
    EXPECT_EQ(folder_of("/a/b/c.nc"), "/a/b");
    EXPECT_EQ(folder_of("b.nc"), ".");
}

class Lines : public DurableFile {};

TEST_F(Lines, GrowOneByOne) {
    LineFile file(path("lines"));
    EXPECT_EQ(bytes_of(path("lines")), "");
    file.append("first");
    EXPECT_EQ(bytes_of(path("lines")), "first\n");
    file.append("");
    file.append("third");
    EXPECT_EQ(bytes_of(path("lines")), "first\n\nthird\n");
}

TEST_F(Lines, NeverGoIntoAFileThatIsThere) {
    testing::put(path("lines"), "of another process\n");
    EXPECT_THROW(LineFile(path("lines")), FileError);
    EXPECT_EQ(bytes_of(path("lines")), "of another process\n");
    EXPECT_THROW(LineFile(path("none/lines")), FileError);
}

}  // namespace
}  // namespace slideway::durable_file_test
