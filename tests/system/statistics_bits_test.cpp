// The same statistics, to the last bit, however a run is shared out and whatever interrupts it.
#include <csignal>
#include <thread>

#include "host/store/shard_folder.hpp"
#include "tests/support/failing_calls.hpp"
#include "tests/support/mpirun.hpp"
#include "tests/system/statistics.hpp"

namespace slideway::testing::statistics_bits_test {
namespace {

TEST_F(StatisticsRun, HasTheSameBitsWithAnyThreadsBlocksAndParts) {
    ASSERT_EQ(run_scene("a.nc", failing).code, 0);
    std::string const hash = hash_of("a.nc");
    for (char const* const threads : {"1", "2", "4"}) {
        for (char const* const block : {"8", "100"}) {
            ASSERT_EQ(run_scene("b.nc", failing, {"--force", "--threads", threads, "--block-members", block}).code, 0);
            EXPECT_EQ(hash_of("b.nc"), hash) << threads << " " << block;
        }
    }
    for (char const* const part : {"2/3", "3/3", "1/3"}) {
        ASSERT_EQ(run_scene("p.nc", failing, {"--shard", part, "--block-members", "16"}).code, 0);
    }
    Outcome const merged = run({"merge", "p.nc.shards", "-o", "p.nc"});
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_NE(merged.out.find("Quantiles are sketched"), std::string::npos);
    EXPECT_EQ(hash_of("p.nc"), hash);
    ResultReader const one(path("a.nc").string()), other(path("p.nc").string());
    for (char const* const name : {"isa", "flags", "backend", "scene"})
        EXPECT_EQ(other.attribute(name), one.attribute(name));
}

TEST_F(StatisticsRun, GoesOnAfterItsEndWithTheSameBits) {
    std::vector<std::string> const longer{"--set", "study.members=8000", "--set", "study.duration=0.3 ms"};
    ASSERT_EQ(run_scene("a.nc", longer).code, 0);
    for (int const signal : {SIGTERM, SIGKILL}) {
        std::vector<std::string> arguments{"run",       "s.toml", "--no-progress",         "-o", "b.nc",
                                           "--threads", "2",      "--block-members", "8"};
        arguments.insert(arguments.end(), longer.begin(), longer.end());
        pid_t const child = start(arguments);
        for (int i = 0; i < 2000 && !(std::filesystem::exists(path("b.nc.shards")) && files_in("b.nc.shards") > 40);
             ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        kill(child, signal);
        EXPECT_EQ(wait(child).code, signal == SIGTERM ? 5 : -SIGKILL);
        Outcome const partial = run({"merge", "b.nc.shards", "-o", "partial.nc", "--force"});
        EXPECT_EQ(partial.code, 5);
        EXPECT_NE(partial.out.find("not_run"), std::string::npos);
        auto const counts = ResultReader(path("partial.nc").string()).values("status_count");
        EXPECT_GT(counts.back(), 0);
        EXPECT_GT(counts.front(), 0);
        EXPECT_EQ(counts.front() + counts.back(), 8000);
        arguments.push_back("--resume");
        Outcome const resumed = run(arguments);
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_FALSE(std::filesystem::exists(path("b.nc.shards")));
        EXPECT_EQ(hash_of("b.nc"), hash_of("a.nc"));
        std::filesystem::remove(path("b.nc"));
    }
}

TEST_F(StatisticsRun, FilesOfManyBlocksStayFew) {
    // 500 blocks: 7 joined shards and 52 single ones.
    ASSERT_EQ(run_scene("a.nc", {"--set", "study.members=4000", "--shard", "1/1", "--block-members", "8"}).code, 0);
    EXPECT_EQ(files_in("a.nc.shards"), 59u);
    ASSERT_EQ(run({"merge", "a.nc.shards", "-o", "a.nc"}).code, 0);
    ASSERT_EQ(run_scene("b.nc", {"--set", "study.members=4000"}).code, 0);
    EXPECT_EQ(hash_of("a.nc"), hash_of("b.nc"));
}

TEST_F(StatisticsRun, ACompleteFileNeedsNoWork) {
    ASSERT_EQ(run_scene("a.nc").code, 0);
    std::string const before = file_text(path("a.nc"));
    Outcome const again = run({"run", "s.toml", "-o", "a.nc", "--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find("a.nc is complete already"), std::string::npos);
    EXPECT_NE(again.out.find("Quantiles are sketched"), std::string::npos);
    EXPECT_EQ(file_text(path("a.nc")), before);
    expect_refusal(2, "study.seed was 1, is 2", {"run", "s.toml", "-o", "a.nc", "--resume", "--set", "study.seed=2"});
}

TEST_F(StatisticsRun, HasTheSameBitsOverRanks) {
    if (auto const why = why_no_ranks(); !why.empty()) GTEST_SKIP() << why;
    ASSERT_EQ(run_scene("a.nc", failing).code, 0);
    ShellOutcome const outcome =
        run_shell(path(""), mpirun(3) + "'" SLIDEWAY_BINARY
                                        "' run s.toml --no-progress -o b.nc --threads 1 --block-members 8 --set "
                                        "integrator.max_steps=60 --max-failures 100%");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(hash_of("b.nc"), hash_of("a.nc"));
}

TEST_F(StatisticsRun, ADiskThatFailsInAJoinLosesNothing) {
    // 75 blocks: the 64th brings a join, which puts one shard and then removes 64.
    std::string const options = " --set study.members=600 --threads 1 --block-members 8 --no-progress -o b.nc";
    ASSERT_EQ(run_scene("a.nc", {"--set", "study.members=600"}).code, 0);
    std::string const command = "'" SLIDEWAY_BINARY "' run s.toml" + options;
    std::filesystem::path const calls = path("").parent_path().string() + "_calls";
    struct Failure {
        char const* calls;
        std::uint64_t at;
        std::uint64_t kept;  // members
    };
    // The first two renamings are those of the identity and its copy.
    for (Failure const& failure :
         {Failure{"rename", 66, 63 * 8}, Failure{"rename", 67, 64 * 8}, Failure{"unlink", 1, 64 * 8},
          Failure{"unlink", 30, 64 * 8}, Failure{"unlink", 64, 64 * 8}}) {
        SCOPED_TRACE(std::string(failure.calls) + " " + std::to_string(failure.at));
        DiskFailure disk;
        disk.error = "EIO";
        disk.calls = failure.calls;
        std::filesystem::remove(calls);
        ShellOutcome const failed =
            run_shell(path(""), with_failing_calls(path(""), calls, failure.at, disk) + command);
        EXPECT_EQ(failed.code, 4) << failed.err;
        std::vector<DamagedShard> damaged;
        EXPECT_EQ(members_of(ShardFolder(path("b.nc.shards").string()).intact(damaged)).count(), failure.kept);
        EXPECT_TRUE(damaged.empty());
        ShellOutcome const resumed = run_shell(path(""), command + " --resume");
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_EQ(resumed.err.find("warning"), std::string::npos) << resumed.err;
        EXPECT_EQ(hash_of("b.nc"), hash_of("a.nc"));
        EXPECT_FALSE(std::filesystem::exists(path("b.nc.shards")));
        std::filesystem::remove(path("b.nc"));
    }
    std::filesystem::remove(calls);
}

}  // namespace
}  // namespace slideway::testing::statistics_bits_test
