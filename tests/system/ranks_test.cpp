// The same bits however a run is shared out: ranks, threads, blocks, jobs of an array, resumed or not.
#include "tests/system/shards.hpp"

#include "host/backend/backend.hpp"
#include "tests/support/failing_calls.hpp"

namespace slideway::testing::ranks_test {
namespace {

class SharedRun : public ShardedRun {
protected:
    SharedRun() { write_scene(150, "5 ms"); }
    void SetUp() override {
        if (auto const why = why_no_ranks(); !why.empty()) GTEST_SKIP() << why;
    }
    /// Calls on files are counted outside of the folder where they are counted.
    std::filesystem::path const calls_ = path("").parent_path().string() + "_calls";
    ~SharedRun() override { std::filesystem::remove(calls_); }

    void clean() const {
        std::filesystem::remove(path("o.nc"));
        std::filesystem::remove_all(shard_folder());
    }
    /// Runs the scene to its end.
    void expect_done(std::string const& command) const {
        ShellOutcome const outcome = shell(command);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    void expect_result(std::string const& hash) const {
        EXPECT_EQ(hash_of("o.nc"), hash);
        expect_no_leftovers();
        clean();
    }
};

TEST_F(SharedRun, HasOneResultOverRanksThreadsAndBlocks) {
    std::string const hash = undisturbed_hash();
    // Any two of the three numbers together.
    for (int const ranks : {1, 2, 3}) {
        for (int const threads : {1, 2, 4}) {
            int const block = (ranks + threads / 2) % 2 == 0 ? 8 : 64;
            std::string const options =
                "--threads " + std::to_string(threads) + " --block-members " + std::to_string(block);
            SCOPED_TRACE(std::to_string(ranks) + " ranks " + options);
            expect_done(mpirun(ranks) + run_text(options));
            expect_result(hash);
        }
    }
}

TEST_F(SharedRun, GoesOnWithOtherRanksThanItBegan) {
    std::string const hash = undisturbed_hash();
    for (int const ranks : {1, 2, 3}) {
        for (int const block : {8, 64}) {
            SCOPED_TRACE(std::to_string(ranks) + " ranks, blocks of " + std::to_string(block));
            // A third of the members, by one process with blocks of another size.
            expect_done(run_text("--threads 2 --block-members 5 --shard 2/3"));
            EXPECT_EQ(shards().count(), 50u);
            expect_done(mpirun(ranks) + run_text("--threads 2 --resume --block-members " + std::to_string(block)));
            expect_result(hash);
        }
    }
}

TEST_F(SharedRun, IsPutTogetherFromTheJobsOfAnArray) {
    std::string const hash = undisturbed_hash();
    for (int const jobs : {1, 2, 5}) {
        SCOPED_TRACE(std::to_string(jobs) + " jobs");
        std::string together;
        for (int i = jobs; i >= 1; --i) {
            std::string const part = "--shard " + std::to_string(i) + "/" + std::to_string(jobs);
            together += run_text("--threads 1 " + part) + " & pids=\"$pids $!\"; ";
        }
        expect_done(together + "for pid in $pids; do wait $pid || exit 9; done");
        EXPECT_FALSE(std::filesystem::exists(path("o.nc")));
        EXPECT_EQ(shards().members(), MemberSet({0, 150}));
        EXPECT_EQ(shards().count(), 150u);
        expect_done("'" SLIDEWAY_BINARY "' merge o.nc.shards -o o.nc");
        EXPECT_EQ(hash_of("o.nc"), hash);
        clean();
    }
}

TEST_F(SharedRun, EndsWithOneCodeAtEveryRank) {
    // About one in six of these masses is negative: too many failed members.
    ShellOutcome const outcome =
        shell(mpirun(3) + run_text("--set 'study.vary.\"mechanism.slider_mass\"={dist=\"norm\",mean=0.2,sd=0.2}' --any-start"));
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    auto const message = outcome.err.find("more than --max-failures");
    EXPECT_NE(message, std::string::npos) << outcome.err;
    EXPECT_EQ(message, outcome.err.rfind("more than --max-failures")) << outcome.err;  // one rank speaks
    EXPECT_TRUE(std::filesystem::exists(path("o.nc")));
}

TEST_F(SharedRun, OnAFullDiskEndsAtEveryRankAndGoesOnLater) {
    std::string const hash = undisturbed_hash();
    for (int const ranks : {2, 3}) {
        for (std::uint64_t const at : {2, 6, 11}) {
            SCOPED_TRACE(std::to_string(ranks) + " ranks, call " + std::to_string(at));
            // The ranks count their calls together.
            std::filesystem::remove(calls_);
            ShellOutcome const full =
                shell(mpirun(ranks, 60) + "env " + with_failing_calls(path(""), calls_, at, {.calls = "write"}) +
                      run_text("--block-members 8 --threads 1"));
            EXPECT_EQ(full.code, 4) << full.err;
            EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
            EXPECT_FALSE(std::filesystem::exists(path("o.nc")));
            shards();
            expect_done(mpirun(ranks) + run_text("--resume"));
            expect_result(hash);
        }
    }
}

TEST_F(SharedRun, GoesOnAfterOneRankWasKilled) {
    write_scene(300, "0.2 s");
    std::string const hash = undisturbed_hash();
    for (char const* const victim : {"0", "2"}) {
        SCOPED_TRACE(std::string("rank ") + victim);
        // The ranks say who they are.
        std::string const ranks = mpirun(3, 60) + "sh -c 'echo $$ >pid.$OMPI_COMM_WORLD_RANK; exec \"$0\" \"$@\"' " +
                                  run_text("--block-members 8 --threads 1");
        std::string const kill_one =
            "for i in $(seq 600); do cat o.nc.shards/manifest-* 2>/dev/null | grep -q . && break; "
            "sleep 0.05; done; kill -9 $(cat pid." +
            std::string(victim) + ")";
        ShellOutcome const killed = shell("{ " + kill_one + "; } & " + ranks + "; code=$?; wait; exit $code");
        EXPECT_NE(killed.code, 0);
        EXPECT_NE(killed.code, 124) << "the others hang";
        Shards const kept = shards();
        EXPECT_GT(kept.count(), 0u);
        EXPECT_EQ(kept.count(), kept.members().count());
        expect_done(mpirun(2) + run_text("--resume --block-members 8", "o.nc", "auto"));  // which is soon done
        expect_result(hash);
    }
}

TEST_F(SharedRun, HasTheArithmeticOfRankZeroAtEveryRank) {
    // Machines that are not alike, as one launcher starts them.
    std::string const program = "'" SLIDEWAY_BINARY "' run s.toml --no-progress --threads 1 --block-members 4 -o ";
    std::string const widest(name_of(best_isa()));
    for (std::string const& leader : {widest, std::string("scalar")}) {
        std::string const other = leader == widest ? "scalar" : widest;
        expect_done(program + "alone.nc --isa " + leader);
        expect_done(mpirun(1) + program + "o.nc --isa " + leader + " : -n 2 " + program + "o.nc --isa " + other);
        expect_result(hash_of("alone.nc"));
        std::filesystem::remove(path("alone.nc"));
    }
}

TEST_F(SharedRun, EndsWhereAnotherRankCannotBegin) {
    // Rank 1 does not see the scene, and rank 0 has begun with it.
    std::string const other = "'" SLIDEWAY_BINARY "' run none.toml --no-progress -o o.nc";
    ShellOutcome const outcome = shell(mpirun(1, 30) + run_text("--threads 1") + " : -n 1 " + other);
    EXPECT_EQ(outcome.code, 2) << outcome.err;  // not 124, that of what hangs
    EXPECT_NE(outcome.err.find("none.toml: the scene cannot be read"), std::string::npos) << outcome.err;
}

TEST_F(SharedRun, OfABrokenSceneEndsAtEveryRank) {
    write("s.toml", "schema = 1\n[joint]\nclearance = \"-1 m\"\n");
    ShellOutcome const outcome = shell(mpirun(3, 30) + run_text(""));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("s.toml:3: joint.clearance"), std::string::npos) << outcome.err;
    EXPECT_FALSE(has_shards());
}

}  // namespace
}  // namespace slideway::testing::ranks_test
