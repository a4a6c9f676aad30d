// Runs that were stopped, killed or damaged, and what goes on from there.
#include <csignal>

#include "tests/system/resumed.hpp"

namespace slideway::testing::resume_test {
namespace {

class Resume : public Resumed {};

TEST_F(Resume, AfterASignalGivesTheSameResult) {
    std::vector<std::string> const longer{"--set", "study.members=800", "study.duration=0.02", "--block-members", "8"};
    auto const with = [&](std::vector<std::string> options) {
        options.insert(options.end(), longer.begin(), longer.end());
        return options;
    };
    ASSERT_EQ(run_scene(with({"--no-progress", "-o", "whole.nc"})).code, 0);
    for (int const signal : {SIGTERM, SIGKILL}) {
        auto arguments = with({"run", "s.toml", "-o", "s.nc", "--threads", "1", "--no-progress"});
        pid_t const child = start(arguments);
        EXPECT_TRUE(comes_true([&] { return shards_in("s.nc.shards") >= 3; }));
        kill(child, signal);
        EXPECT_EQ(wait(child).code, signal == SIGTERM ? 5 : -SIGKILL);
        EXPECT_FALSE(exists("s.nc"));
        std::size_t const shards = shards_in("s.nc.shards");
        EXPECT_LT(shards, 100u);

        Outcome const outcome = run_scene(with({"--resume"}));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("resuming: "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(" of 800 members are done\n"), std::string::npos) << outcome.err;
        EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
        EXPECT_EQ(results("s.nc").attribute("completeness"), "complete");
        EXPECT_FALSE(exists("s.nc.shards"));
        fs::remove(path("s.nc"));
    }
}

TEST_F(Resume, OnNothingBegins) {
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("resuming"), std::string::npos) << outcome.err;
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(64, 0));
}

TEST_F(Resume, OfACompleteFileSaysSo) {
    ASSERT_EQ(run_scene({"--no-progress"}).code, 0);
    std::string const bytes = file_text(path("s.nc"));
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "resuming: s.nc is complete already\n");
    EXPECT_EQ(run_scene({"--no-progress", "--resume"}).err, "");
    EXPECT_NE(outcome.out.find("finished         64"), std::string::npos) << outcome.out;
    EXPECT_TRUE(file_text(path("s.nc")) == bytes);
    EXPECT_FALSE(exists("s.nc.shards"));
}

TEST_F(Resume, OfADamagedFileIsRefused) {
    ASSERT_EQ(run_scene({"--no-progress"}).code, 0);
    std::string bytes = file_text(path("s.nc"));
    // One bit of one value.
    double const value = results("s.nc").values("initial_y")[33];
    auto const at = bytes.find(std::string(reinterpret_cast<char const*>(&value), sizeof value));
    ASSERT_NE(at, std::string::npos);
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    std::ofstream(path("s.nc"), std::ios::binary) << bytes;
    expect_refusal(4, "s.nc: is damaged: the data do not match their hash",
                   {"run", "s.toml", "--no-progress", "--resume"});
    EXPECT_TRUE(file_text(path("s.nc")) == bytes);
}

TEST_F(Resume, OfAnotherArithmeticIsRefused) {
    make_unfinished();
    let_shards_be_contracted();
    expect_refusal(2, "the arithmetic was contracted (a build with SLIDEWAY_CUDA_FMAD), is fused",
                   {"run", "s.toml", "--no-progress", "--resume"});
}

TEST_F(Resume, KeepsAShardThatCannotBeReadForNow) {
    make_shards();
    std::string const victim = path(shard(24)).string();
    fs::rename(victim, path("away.nc"));
    fs::create_symlink(victim, victim);
    for (char const* const seed : {"study.seed=1", "study.seed=2"}) {
        expect_refusal(4, shard(24) + ": cannot ", {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume", "--set", seed});
    }
    fs::remove(victim);
    fs::rename(path("away.nc"), victim);
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("resuming: 64 of 64 members are done\n"), std::string::npos) << outcome.err;
}

TEST_F(Resume, SaysOfAShardThatIsGoneThatItIs) {
    make_shards();
    fs::remove(path(shard(24)));
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning: " + shard(24) + ": is gone; its members run again\n"), std::string::npos)
        << outcome.err;
}

TEST_F(Resume, OfTheFileOfAnotherSceneIsRefused) {
    ASSERT_EQ(run_scene({"--no-progress"}).code, 0);
    expect_refusal(2, "s.nc: cannot resume: it is the result of another run (study.seed was 1, is 2)",
                   {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume", "--set", "study.seed=2"});
    expect_refusal(2, "the members were 0-63, are 3-5",
                   {"run", "s.toml", "--no-progress", "--resume", "--members", "3..5", "-o", "s.nc"});
    EXPECT_EQ(results("s.nc").values("status").size(), 64u);
    // Without the word it is a run like any other.
    EXPECT_EQ(run_scene({"--no-progress", "--set", "study.seed=2"}).code, 0);
}

TEST_F(Resume, OfAChangedSceneIsRefusedAndSaysWhatChanged) {
    make_unfinished();
    expect_refusal(
        2,
        "s.nc.shards: cannot resume: it holds 48 finished members of another run (mechanism.gravity was 9.81, "
        "is 1.62)",
        {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume", "--set", "mechanism.gravity=1.62"});
    expect_refusal(2, "joint.clearance_y was 0.0001, is 0.0002",
                   {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume", "--set", "joint.clearance=0.2 mm"});
    // What gives no member other bits is nothing that changed.
    EXPECT_EQ(run({"run", "s.toml", "--resume", "--threads", "1", "--block-members", "3"}).code, 0);
}

TEST_F(Resume, IsAskedForWhereARunIsUnfinished) {
    make_unfinished();
    expect_refusal(2, "s.nc.shards: holds 48 finished members of this run; add --resume to go on with it",
                   {"run", "s.toml", "--no-progress"});
    expect_refusal(2, "s.nc.shards: holds 48 finished members of another run",
                   {"run", "s.toml", "--no-progress", "-o", "s.nc", "--set", "study.seed=2"});
    EXPECT_FALSE(exists("s.nc"));
    EXPECT_EQ(run_scene({"--no-progress", "--resume"}).code, 0);
}

TEST_F(Resume, RunsOnlyTheMembersThatAreLeft) {
    ASSERT_EQ(run_scene({"--no-progress", "-o", "whole.nc"}).code, 0);
    make_unfinished();
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("resuming: 48 of 64 members are done\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
}

TEST_F(Resume, OutOfTimeAtOnceKeepsWhatThereWas) {
    make_unfinished();
    Outcome const outcome = run_scene({"--no-progress", "--resume", "--max-hours", "0"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.err.find("stopped early (--max-hours): 16 members have not run"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(run_scene({"--no-progress", "--resume"}).code, 0);
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(64, 0));
}

TEST_F(Resume, RunsADamagedShardAgainAndSaysSo) {
    ASSERT_EQ(run_scene({"--no-progress", "-o", "whole.nc"}).code, 0);
    for (bool const cut : {false, true}) {
        make_shards();
        std::string bytes = file_text(path(shard(24)));
        if (cut)
            bytes.resize(bytes.size() / 2);
        else
            bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 16);
        std::ofstream(path(shard(24)), std::ios::binary) << bytes;
        Outcome const outcome = run_scene({"--resume"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("warning: " + shard(24) + ": is not what was written"), std::string::npos)
            << outcome.err;
        EXPECT_NE(outcome.err.find("resuming: 56 of 64 members are done\n"), std::string::npos) << outcome.err;
        EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
        fs::remove(path("s.nc"));
    }
}

TEST_F(Resume, InterruptedAfterDamageLosesNothing) {
    ASSERT_EQ(run_scene({"--no-progress", "-o", "whole.nc"}).code, 0);
    make_shards();
    std::string bytes = file_text(path(shard(24)));
    bytes[100] = static_cast<char>(bytes[100] ^ 1);
    std::ofstream(path(shard(24)), std::ios::binary) << bytes;
    // The first resume brings four of the eight members, under the name that the damaged shard had.
    EXPECT_EQ(run_scene({"--no-progress", "--resume", "--max-hours", "0"}).code, 5);
    EXPECT_EQ(run_scene({"--no-progress", "--resume", "--block-members", "4", "--shard", "1/1"}).code, 0);
    EXPECT_TRUE(fs::remove(path(shard(28))));
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("resuming: 60 of 64 members are done\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
}

TEST_F(Resume, LeavesWhatIsNotOfTheRunInItsFolderAndSaysSo) {
    make_unfinished();
    write("s.nc.shards/notes.txt", "mine");
    write("s.nc.shards/members-0000000999.nc", "of the board");
    write("s.nc.shards/study.table.csv", "a\n1\n");
    Outcome const outcome = run_scene({"--quiet", "--resume"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("warning: s.nc.shards: stays, for it holds what is not of this run: members-0000000999.nc, notes.txt, study.table.csv\n"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(file_text(path("s.nc.shards/members-0000000999.nc")), "of the board");
    EXPECT_EQ(std::distance(fs::directory_iterator(path("s.nc.shards")), fs::directory_iterator()), 3);
}

TEST_F(Resume, LeavesWhatIsNoFileInItsFolderWhateverItsName) {
    make_unfinished();
    ASSERT_EQ(mkfifo(path("s.nc.shards/members-9999999999.nc").c_str(), 0600), 0);
    Outcome outcome = run_scene({"--quiet", "--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning: s.nc.shards: stays, for it holds what is not of this run: members-9999999999.nc\n"), std::string::npos) << outcome.err;
    outcome = run_scene({"--quiet", "--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(results("s.nc").values("member").size(), 64u);
}

TEST_F(Resume, RefusesAFolderInThePlaceOfAFileOfItsOwnBeforeItComputes) {
    make_unfinished();
    fs::create_directory(path("s.nc.shards/finished.toml"));
    expect_refusal(4, "s.nc.shards/finished.toml: is no file; move it away", {"run", "s.toml", "--no-progress", "--resume"});
    fs::remove(path("s.nc.shards/finished.toml"));
    EXPECT_EQ(run_scene({"--quiet", "--resume"}).code, 0);
}

TEST_F(Resume, OfAFileThatSomebodyAddedToAsksForNoForce) {
    ASSERT_EQ(run_scene({"--no-progress"}).code, 0);
    {
        int file = 0, variable = 0;
        ASSERT_EQ(nc_open(path("s.nc").c_str(), NC_WRITE, &file), NC_NOERR);
        ASSERT_EQ(nc_def_var(file, "my_notes", NC_FLOAT, 0, nullptr, &variable), NC_NOERR);
        ASSERT_EQ(nc_close(file), NC_NOERR);
    }
    expect_refusal(4, "s.nc: holds what slideway did not write, and no hash covers (variable my_notes of type float); take it out again, or give another name with -o",
                   {"run", "s.toml", "--no-progress", "--resume"});
}

TEST_F(Resume, TakesOneMemberThatItRanAlone) {
    ASSERT_EQ(run_scene({"--no-progress"}).code, 0);
    Outcome const outcome = run_scene({"--no-progress", "--member", "7", "--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(results("s_member_7.nc").values("final_y")[0], results("s.nc").values("final_y")[7]);
}

}  // namespace
}  // namespace slideway::testing::resume_test
