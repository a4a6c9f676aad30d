// Runs that end early: by their time, a signal, a full disk; and runs in each other's way.
#include <chrono>
#include <csignal>

#include "tests/system/small_run.hpp"

namespace slideway::testing::stop_test {
namespace {

class StoppedRun : public SmallRun {};

TEST_F(StoppedRun, OutOfTimeLeavesNoFile) {
    Outcome const outcome = run_scene({"--max-hours", "0"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.err,
              "slideway: stopped early (--max-hours): 37 members have not run; those that did are kept in s.nc.shards: "
              "add --resume to go on, or make a file of them with slideway merge\n");
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
    EXPECT_TRUE(std::filesystem::exists(path("s.nc.shards/run.toml")));
}

TEST_F(StoppedRun, StoppedByASignalKeepsWhatIsFinished) {
    // Half a minute of work whose first members take milliseconds.
    for (int const signal : {SIGINT, SIGTERM}) {
        std::filesystem::remove_all(path("s.nc.shards"));
        pid_t const child = start({"run", "s.toml", "-o", "s.nc", "--set", "study.members=100000", "study.samples=0",
                                   "study.duration=0.1", "--threads", "2"});
        EXPECT_TRUE(comes_true([&] { return shards_in("s.nc.shards") >= 2; }));
        kill(child, signal);
        Outcome const outcome = wait(child);
        EXPECT_EQ(outcome.code, 5) << outcome.err;
        EXPECT_NE(outcome.err.find("slideway: stopped early (signal): "), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
        EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 5);
        ResultReader const file = results("s.nc");
        EXPECT_EQ(file.stored_hash(), file.computed_hash());
        auto const status = file.values("status");
        auto const finished = std::count(status.begin(), status.end(), 0),
                   left = std::count(status.begin(), status.end(), -1);
        EXPECT_GT(finished, 0);
        EXPECT_GT(left, 0);
        EXPECT_EQ(finished + left, 100000);
        std::filesystem::remove(path("s.nc"));
    }
}

TEST_F(StoppedRun, LeavesTheFolderOfARunThatIsAtWorkAlone) {
    pid_t const child = start(
        {"run", "s.toml", "-o", "s.nc", "--set", "study.members=100000", "study.samples=0", "study.duration=0.1", "--threads", "1"});
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(path("s.nc.shards/run.toml")); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // its handler stands
    for (char const* const options : {"", "--resume", "--shard 1/2"}) {
        std::string const rival =
            "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' run s.toml -o s.nc " + options + " >rival 2>&1";
        EXPECT_EQ(WEXITSTATUS(std::system(rival.c_str())), 4);
        EXPECT_EQ(file_text(path("rival")),
                  "s.nc.shards: is being written by process " + std::to_string(child) + "; wait for its end or give another name with -o\n");
    }
    kill(child, SIGTERM);
    EXPECT_EQ(wait(child).code, 5);
}

TEST_F(StoppedRun, TakesTheFolderOfAKilledRunThatFinishedNothing) {
    pid_t const child =
        start({"run", "s.toml", "-o", "s.nc", "--set", "study.members=1", "study.duration=5000 s", "study.samples=11"});
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(path("s.nc.shards/run.toml")); }));
    kill(child, SIGKILL);
    EXPECT_EQ(wait(child).code, -SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
    EXPECT_EQ(run_scene({}).code, 0);
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(37, 0));
    EXPECT_FALSE(std::filesystem::exists(path("s.nc.shards")));
}

TEST_F(StoppedRun, ASignalEndsAMemberThatWouldTakeMinutes) {
    pid_t const child =
        start({"run", "s.toml", "-o", "s.nc", "--set", "study.members=1", "study.duration=5000 s", "study.samples=11"});
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(path("s.nc.shards/run.toml")); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    auto const asked = std::chrono::steady_clock::now();
    kill(child, SIGTERM);
    Outcome const outcome = wait(child);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(5));
    EXPECT_NE(outcome.err.find("1 member has not run"), std::string::npos) << outcome.err;
    EXPECT_EQ(shards_in("s.nc.shards"), 0u);
}

class RunOnAFullDisk : public SmallRun {
protected:
    /// Where no file may grow beyond 128 kB (64 kB where a block of ulimit is 512 B).
    Outcome run_small(std::string const& options) const {
        write("wrapper.sh", "ulimit -f 128\nexec \"$@\"\n");
        std::string const shell = "cd '" + path("").string() +
                                  "' && bash wrapper.sh '" SLIDEWAY_BINARY "' run s.toml -o s.nc " +
                                  "--no-progress --set study.samples=0 --set study.duration=1e-4 " + options + " >out 2>err";
        int const code = WEXITSTATUS(std::system(shell.c_str()));
        return {code, file_text(path("out")), file_text(path("err"))};
    }
};

TEST_F(RunOnAFullDisk, SaysWhichShardItCouldNotWrite) {
    Outcome const outcome = run_small("--set study.members=10000 --block-members 2000");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("s.nc.shards/members-")) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
    EXPECT_EQ(shards_in("s.nc.shards"), 0u);
    for (auto const& entry : std::filesystem::directory_iterator(path("s.nc.shards"))) {
        EXPECT_FALSE(entry.path().filename().string().starts_with("members-")) << "half a shard stays";
    }
}

TEST_F(RunOnAFullDisk, KeepsItsShardsIfTheResultHasNoRoom) {
    Outcome const outcome = run_small("--set study.members=800 --block-members 8");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("s.nc.part: ")) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
    EXPECT_FALSE(std::filesystem::exists(path("s.nc.part")));
    EXPECT_EQ(shards_in("s.nc.shards"), 100u);
    // With room again there is nothing left to compute.
    Outcome const later =
        run({"run", "s.toml", "-o", "s.nc", "--set", "study.samples=0", "study.duration=1e-4", "study.members=800", "--resume"});
    EXPECT_EQ(later.code, 0) << later.err;
    EXPECT_NE(later.err.find("resuming: 800 of 800 members are done\n"), std::string::npos) << later.err;
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(800, 0));
}

}  // namespace
}  // namespace slideway::testing::stop_test
