// What merge says of the shards that it read, and whose names it leaves alone.
#include <csignal>

#include <fmt/format.h>

#include "tests/system/resumed.hpp"

namespace slideway::testing::merge_test {
namespace {

class Merge : public Resumed {
protected:
    std::string said(std::string const& to, int code) const {
        Outcome const merged = run({"merge", "s.nc.shards", "-o", to, "--force"});
        EXPECT_EQ(merged.code, code) << merged.err;
        return merged.out.substr(std::min(merged.out.rfind("results  "), merged.out.size()));
    }
};

TEST_F(Merge, OfAnUnfinishedRunSaysThatItsShardsAreNeeded) {
    make_unfinished();
    EXPECT_EQ(said("m.nc", 5), "results      m.nc; s.nc.shards is still needed: m.nc is not complete (16 of 64 members not run)\n");
    EXPECT_EQ(run_scene({"--resume", "--quiet"}).code, 0) << "as the line says";
}

TEST_F(Merge, OfAFinishedRunSaysThatItsShardsAreNotNeeded) {
    make_shards();
    EXPECT_EQ(said("m.nc", 0), "results      m.nc; s.nc.shards is no longer needed\n");
    EXPECT_EQ(said("m.nc", 0), "results      m.nc (replaced a former file); s.nc.shards is no longer needed\n");
}

TEST_F(Merge, OfAFinishedRunSaysThatCommandsThatItNamesNeedTheirScene) {
    ASSERT_EQ(run_scene({"--no-progress", "--shard", "1/1", "--set", "integrator.max_steps=3"}).code, 0);
    EXPECT_EQ(said("m.nc", 0), "results      m.nc; s.nc.shards is needed for the scene that the commands above read, and for nothing else\n");
}

TEST_F(Merge, OfADamagedShardSaysThatTheOthersAreNeeded) {
    make_shards();
    std::ofstream(path(shard(24)), std::ios::binary) << "other";
    EXPECT_EQ(said("m.nc", 5), "results      m.nc; s.nc.shards is still needed: m.nc is not complete (8 of 64 members not run)\n");
}

/// Half a minute of work under its name.
TEST_F(Merge, IntoTheNameOfARunAtWorkIsRefused) {
    make_shards();
    fs::rename(path("s.nc.shards"), path("done.nc.shards"));
    pid_t const child = start({"run", "s.toml", "-o", "live.nc", "--no-progress", "--set", "study.members=100000", "study.samples=0"});
    EXPECT_TRUE(comes_true([&] { return exists("live.nc.shards/run-copy.toml"); }));
    std::string const line = fmt::format("live.nc: is being written by process {}; wait for its end or give another name with -o", child);
    for (std::string const& folder : {std::string("done.nc.shards"), std::string("live.nc.shards")}) {
        expect_refusal(4, line, {"merge", folder, "-o", "live.nc"});
        expect_refusal(4, line, {"merge", folder, "-o", "live.nc", "--force"});
    }
    // So is a link to its name, there already or not.
    fs::create_symlink("live.nc", path("link.nc"));
    expect_refusal(4, "link.nc: is being written by process ", {"merge", "done.nc.shards", "-o", "link.nc"});
    expect_refusal(4, "live.nc.shards: is being written by process ", {"run", "s.toml", "-o", "link.nc", "--no-progress", "--force"});
    // A copy of what it has so far is no harm.
    EXPECT_TRUE(comes_true([&] { return shards_in("live.nc.shards") > 0; }));
    EXPECT_EQ(run({"merge", "live.nc.shards", "-o", "copy.nc"}).code, 5);
    kill(child, SIGTERM);
    EXPECT_EQ(wait(child).code, 5);
    EXPECT_EQ(run({"merge", "done.nc.shards", "-o", "live.nc"}).code, 0) << "nobody is there any more";
}

TEST_F(Merge, ThatASignalEndsLeavesAllAsItWas) {
    make_shards();
    pid_t const child = start({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_TRUE(comes_true([&] { return exists("m.nc.part.lock") || exists("m.nc"); }));
    kill(child, SIGUSR1);
    Outcome const ended = wait(child);
    if (ended.code == 5) {  // else it had come to its end
        EXPECT_EQ(ended.err, "slideway: stopped early (signal): m.nc was not made, and s.nc.shards is as it was: merge again\n");
        EXPECT_FALSE(exists("m.nc"));
    } else {
        EXPECT_EQ(ended.code, 0) << ended.err;
    }
    EXPECT_FALSE(exists("m.nc.part") || exists("m.nc.part.lock"));
    EXPECT_EQ(said("m.nc", 0).find("is still needed"), std::string::npos);
}

}  // namespace
}  // namespace slideway::testing::merge_test
