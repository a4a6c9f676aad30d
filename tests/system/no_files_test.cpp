// Pipes, devices and folders under the names of files: one line, and nobody waits.
#include <sys/stat.h>

#include "tests/system/resumed.hpp"

namespace slideway::testing::no_files_test {
namespace {

class NoFiles : public Resumed {
protected:
    /// In seconds, not for ever.
    void expect_told(std::string const& words, std::string const& name, int code = 4) const {
        std::string const line = "cd '" + path("").string() + "' && timeout 20 '" SLIDEWAY_BINARY "' " + words + " >out 2>err </dev/null";
        EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), code) << words << ' ' << name;
        std::string const err = file_text(path("err"));
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << words << err;
        EXPECT_NE(err.find(name + ": is a device or a pipe"), std::string::npos) << words << err;
    }
    void make_pipe(std::string const& name) const {
        fs::remove_all(path(name));
        ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    }
    std::string const merge_ = "merge s.nc.shards -o m.nc", resume_ = "run s.toml --no-progress -o s.nc --resume";
};

TEST_F(NoFiles, NamedLikeFilesOfAFolderOfShardsAreTold) {
    for (std::string const name : {"members-0000000024.nc", "run.toml", "run-copy.toml", "manifest-000001.txt"}) {
        fs::remove_all(path("s.nc.shards"));
        make_shards();
        make_pipe("s.nc.shards/" + name);
        expect_told(merge_, "s.nc.shards/" + name);
        expect_told(resume_, "s.nc.shards/" + name);
    }
    for (std::string const name : {"lock", "lock-begin"}) {
        fs::remove_all(path("s.nc.shards"));
        make_shards();
        make_pipe("s.nc.shards/" + name);
        expect_told(resume_, "s.nc.shards/" + name);
    }
}

TEST_F(NoFiles, NamedLikeADeviceAreTold) {
    make_shards();
    fs::remove(path(shard(24)));
    fs::create_symlink("/dev/zero", path(shard(24)));
    expect_told(merge_, shard(24));
    expect_told(resume_, shard(24));
}

TEST_F(NoFiles, NamedLikeTemporaryOnesAreTold) {
    make_shards();
    fs::remove(path("s.nc.shards/run-copy.toml"));
    make_pipe("s.nc.shards/run-copy.toml.tmp");
    expect_told(resume_, "s.nc.shards/run-copy.toml.tmp");
}

TEST_F(NoFiles, NamedLikeResultsAreTold) {
    make_pipe("p.nc");
    for (char const* const words : {"info p.nc", "info p.nc --check", "info p.nc --json", "report p.nc -o p.html"}) expect_told(words, "p.nc");
    make_pipe("s.nc.part.lock");
    std::string const line = "cd '" + path("").string() + "' && timeout 20 '" SLIDEWAY_BINARY "' run s.toml -o s.nc >out 2>err";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 4);
    EXPECT_NE(file_text(path("err")).find("s.nc.part.lock: is in the way"), std::string::npos);
}

/// A shell's <(...) is a pipe with a writer.
TEST_F(NoFiles, AsScenesAndTablesAreReadWhereSomebodyWrites) {
    write("read.sh", "timeout 20 '" SLIDEWAY_BINARY "' check <(sleep 0.1; cat s.toml) --resolved\n");
    EXPECT_EQ(WEXITSTATUS(std::system(("cd '" + path("").string() + "' && bash read.sh >out 2>err").c_str())), 0) << file_text(path("err"));
    EXPECT_NE(file_text(path("out")).find("members = 64"), std::string::npos);
    make_pipe("p.toml");
    std::string const alone = "cd '" + path("").string() + "' && timeout 20 '" SLIDEWAY_BINARY "' check p.toml >out 2>err";
    EXPECT_EQ(WEXITSTATUS(std::system(alone.c_str())), 2);
    EXPECT_NE(file_text(path("err")).find("nobody writes to this pipe"), std::string::npos) << file_text(path("err"));
}

}  // namespace
}  // namespace slideway::testing::no_files_test
