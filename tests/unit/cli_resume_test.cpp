// Runs that were stopped, killed, damaged or divided, and what goes on from there.
#include "cli_process.hpp"

#include <csignal>

#include <fmt/format.h>

#include "host/output/result_reader.hpp"
#include "kernels/status.hpp"

namespace slideway::testing {
namespace {

namespace fs = std::filesystem;

constexpr char const* scene = R"(
schema = 1
title = "A resumed ensemble"
[contact]
law = "conservative"
[friction]
[study]
members = 64
duration = "5 ms"
samples = 5
quantities = ["energy_residual", "mode_time"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

class Resume : public Program {
protected:
    Resume() { write("s.toml", scene); }
    Outcome run_scene(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", "s.toml", "--threads", "2"});
        return run(std::move(options));
    }
    ResultReader results(std::string const& name) const { return ResultReader(path(name).string()); }
    /// The hash of a file, which fits its data.
    std::string hash_of(std::string const& name) const {
        ResultReader const file = results(name);
        EXPECT_EQ(file.stored_hash(), file.computed_hash()) << name;
        return file.computed_hash();
    }
    bool exists(std::string const& name) const { return fs::exists(path(name)); }
    std::string shard(std::uint64_t first) const { return fmt::format("s.nc.shards/members-{:010}.nc", first); }

    /// All members in shards of eight, not merged.
    void make_shards() const {
        EXPECT_EQ(run_scene({"--quiet", "--block-members", "8", "--shard", "1/1"}).code, 0);
        EXPECT_EQ(shards_in("s.nc.shards"), 8u);
        EXPECT_FALSE(exists("s.nc"));
    }
    /// Without those of members 16 to 23 and 40 to 47.
    void make_unfinished() const {
        make_shards();
        for (std::uint64_t const first : {16u, 40u}) EXPECT_TRUE(fs::remove(path(shard(first))));
    }
};

// ---- stopped and killed ----

TEST_F(Resume, AfterASignalGivesTheSameResult) {
    std::vector<std::string> const longer{"--set", "study.members=1500", "study.duration=0.02", "--block-members", "8"};
    auto const with = [&](std::vector<std::string> options) {
        options.insert(options.end(), longer.begin(), longer.end());
        return options;
    };
    ASSERT_EQ(run_scene(with({"--quiet", "-o", "whole.nc"})).code, 0);
    for (int const signal : {SIGTERM, SIGKILL}) {
        auto arguments = with({"run", "s.toml", "--threads", "1", "--quiet"});
        pid_t const child = start(arguments);
        EXPECT_TRUE(comes_true([&] { return shards_in("s.nc.shards") >= 3; }));
        kill(child, signal);
        EXPECT_EQ(wait(child).code, signal == SIGTERM ? 5 : -SIGKILL);
        EXPECT_FALSE(exists("s.nc"));
        std::size_t const shards = shards_in("s.nc.shards");
        EXPECT_LT(shards, 188u);

        Outcome const outcome = run_scene(with({"--resume"}));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("resuming: "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(" of 1500 members are done\n"), std::string::npos) << outcome.err;
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
    ASSERT_EQ(run_scene({"--quiet"}).code, 0);
    std::string const bytes = file_text(path("s.nc"));
    Outcome const outcome = run_scene({"--quiet", "--resume"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "resuming: s.nc is complete already\n");
    EXPECT_NE(outcome.out.find("finished         64"), std::string::npos) << outcome.out;
    EXPECT_TRUE(file_text(path("s.nc")) == bytes);
    EXPECT_FALSE(exists("s.nc.shards"));
}

TEST_F(Resume, OfTheFileOfAnotherSceneIsRefused) {
    ASSERT_EQ(run_scene({"--quiet"}).code, 0);
    expect_refusal(2, "s.nc: cannot resume: it is the result of another run (study.seed was 1, is 2)",
                   {"run", "s.toml", "--quiet", "--resume", "--set", "study.seed=2"});
    expect_refusal(2, "the members were 0-63, are 3-5",
                   {"run", "s.toml", "--quiet", "--resume", "--members", "3..5", "-o", "s.nc"});
    EXPECT_EQ(results("s.nc").values("status").size(), 64u);
    // Without the word it is a run like any other.
    EXPECT_EQ(run_scene({"--quiet", "--set", "study.seed=2"}).code, 0);
}

TEST_F(Resume, OfAChangedSceneIsRefusedAndSaysWhatChanged) {
    make_unfinished();
    expect_refusal(
        2,
        "s.nc.shards: cannot resume: it holds 48 finished members of another run (mechanism.gravity was 9.81, "
        "is 1.62)",
        {"run", "s.toml", "--quiet", "--resume", "--set", "mechanism.gravity=1.62"});
    expect_refusal(2, "joint.clearance_y was 0.0001, is 0.0002",
                   {"run", "s.toml", "--quiet", "--resume", "--set", "joint.clearance=0.2 mm"});
    // What gives no member other bits is nothing that changed.
    EXPECT_EQ(run({"run", "s.toml", "--resume", "--threads", "1", "--block-members", "3"}).code, 0);
}

TEST_F(Resume, IsAskedForWhereARunIsUnfinished) {
    make_unfinished();
    expect_refusal(2, "s.nc.shards: holds 48 finished members of this run; add --resume to go on with it",
                   {"run", "s.toml", "--quiet"});
    expect_refusal(2, "s.nc.shards: holds 48 finished members of another run",
                   {"run", "s.toml", "--quiet", "--set", "study.seed=2"});
    EXPECT_FALSE(exists("s.nc"));
    EXPECT_EQ(run_scene({"--quiet", "--resume"}).code, 0);
}

TEST_F(Resume, RunsOnlyTheMembersThatAreLeft) {
    ASSERT_EQ(run_scene({"--quiet", "-o", "whole.nc"}).code, 0);
    make_unfinished();
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("resuming: 48 of 64 members are done\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
}

TEST_F(Resume, OutOfTimeAtOnceKeepsWhatThereWas) {
    make_unfinished();
    Outcome const outcome = run_scene({"--quiet", "--resume", "--max-hours", "0"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.err.find("stopped early (--max-hours): 16 members have not run"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(run_scene({"--quiet", "--resume"}).code, 0);
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(64, 0));
}

TEST_F(Resume, RunsADamagedShardAgainAndSaysSo) {
    ASSERT_EQ(run_scene({"--quiet", "-o", "whole.nc"}).code, 0);
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
    ASSERT_EQ(run_scene({"--quiet", "-o", "whole.nc"}).code, 0);
    make_shards();
    std::string bytes = file_text(path(shard(24)));
    bytes[100] = static_cast<char>(bytes[100] ^ 1);
    std::ofstream(path(shard(24)), std::ios::binary) << bytes;
    // The first resume brings four of the eight members, under the name that the damaged shard had.
    EXPECT_EQ(run_scene({"--quiet", "--resume", "--max-hours", "0"}).code, 5);
    EXPECT_EQ(run_scene({"--quiet", "--resume", "--block-members", "4", "--shard", "1/1"}).code, 0);
    EXPECT_TRUE(fs::remove(path(shard(28))));
    Outcome const outcome = run_scene({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("resuming: 60 of 64 members are done\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
}

TEST_F(Resume, TakesOneMemberThatItRanAlone) {
    ASSERT_EQ(run_scene({"--quiet"}).code, 0);
    Outcome const outcome = run_scene({"--quiet", "--member", "7", "--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(results("s_member_7.nc").values("final_y")[0], results("s.nc").values("final_y")[7]);
}

// ---- divided among the jobs of an array ----

TEST_F(Resume, OfPartsTogetherGivesTheSameResult) {
    ASSERT_EQ(run_scene({"--quiet", "-o", "whole.nc"}).code, 0);
    for (char const* const part : {"2/3", "3/3", "1/3"}) {
        EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, std::string(part) == "2/3" ? 4 : 5);
        fs::remove(path("s.nc"));
        Outcome const outcome = run_scene({"--quiet", "--shard", part});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(fmt::format("part {}-of-3 is done, in s.nc.shards; slideway merge", part[0])),
                  std::string::npos)
            << outcome.out;
        EXPECT_FALSE(exists("s.nc"));
    }
    Outcome const merge = run({"merge", "s.nc.shards", "-o", "s.nc"});
    EXPECT_EQ(merge.code, 0) << merge.err;
    EXPECT_NE(merge.out.find("finished         64"), std::string::npos) << merge.out;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
    EXPECT_EQ(results("s.nc").attribute("completeness"), "complete");
    EXPECT_EQ(results("s.nc").attribute("scene"), results("whole.nc").attribute("scene"));
    EXPECT_EQ(results("s.nc").attribute("isa"), results("whole.nc").attribute("isa"));
}

TEST_F(Resume, OfOnePartLeavesTheOthersAlone) {
    EXPECT_EQ(run_scene({"--quiet", "--shard", "1/3"}).code, 0);
    EXPECT_EQ(run_scene({"--quiet", "--shard", "2/3", "--max-hours", "0"}).code, 5);
    expect_refusal(2, "holds 22 finished members of this run; add --resume",
                   {"run", "s.toml", "--quiet", "--shard", "1/3"});
    Outcome const again = run_scene({"--shard", "1/3", "--resume"});
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.err.find("resuming: 22 of 22 members are done\n"), std::string::npos) << again.err;
    // A run of the whole goes on with what parts have done, and makes the file.
    Outcome const whole = run_scene({"--resume"});
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_NE(whole.err.find("resuming: 22 of 64 members are done\n"), std::string::npos) << whole.err;
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(64, 0));
}

TEST_F(Resume, OfPartsOfMembersThatAreFewerThanThey) {
    for (int part = 1; part <= 5; ++part) {
        EXPECT_EQ(run_scene({"--quiet", "--members", "9..11", "--shard", fmt::format("{}/5", part), "-o", "s.nc"}).code,
                  0);
    }
    EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(results("s.nc").values("member"), (std::vector<double>{9, 10, 11}));
}

TEST_F(Resume, RefusesPartsThatThereAreNot) {
    for (char const* const part : {"4/3", "0/3", "x", "3", "1/0", "-1/3", "1/3/5", "1.5/3", ""}) {
        if (*part == '\0') continue;
        expect_refusal(2, std::string("--shard ") + part + ": give the part", {"run", "s.toml", "--shard", part});
    }
}

TEST_F(Resume, MergesAnUnfinishedFolderAndSaysSo) {
    make_unfinished();
    Outcome const outcome = run({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.err, "slideway: 16 of 64 members have not run; run them and merge again\n");
    ResultReader const file = results("m.nc");
    EXPECT_EQ(file.attribute("completeness"), "16 of 64 members not run");
    auto const status = file.values("status");
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(status[i], i / 8 == 2 || i / 8 == 5 ? -1 : 0) << i;
    EXPECT_EQ(run({"info", "m.nc"}).code, 0);
    EXPECT_EQ(run_scene({"--quiet", "--resume"}).code, 0);  // the shards were still there
    // An incomplete file is not what there is to resume: its run begins anew.
    EXPECT_EQ(run_scene({"--quiet", "--resume", "-o", "m.nc"}).code, 0);
    EXPECT_EQ(hash_of("m.nc"), hash_of("s.nc"));
}

TEST_F(Resume, MergesNoDamagedShard) {
    make_shards();
    std::string bytes = file_text(path(shard(24)));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(path(shard(24)), std::ios::binary) << bytes;
    Outcome const outcome = run({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(outcome.err, shard(24) + ": is not what was written (its checksum differs)\n");
    EXPECT_FALSE(exists("m.nc"));
    EXPECT_FALSE(exists("m.nc.part"));
}

TEST_F(Resume, MergesOnlyFoldersOfShards) {
    fs::create_directories(path("empty"));
    expect_refusal(4, "empty: is no folder of shards", {"merge", "empty", "-o", "m.nc"});
    expect_refusal(4, "none: is no folder of shards", {"merge", "none", "-o", "m.nc"});
    make_shards();
    expect_refusal(4, "there is no folder", {"merge", "s.nc.shards", "-o", "none/m.nc"});
}

TEST_F(Resume, KeepsShardsThatAreResultsThemselves) {
    make_shards();
    Outcome const outcome = run({"info", shard(24)});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("matches the data"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("finished         8"), std::string::npos) << outcome.out;
}

// ---- a member that fails alone ----

TEST_F(Resume, PrintsTheCommandThatRepeatsAPoisonedMember) {
    // A few members start where the rod does not reach, others so deep in the way that they spend their steps.
    std::vector<std::string> const poison{"--set", R"(study.vary."initial.y"={dist="norm",mean="0 mm",sd="70 mm"})",
                                          "--set", "integrator.max_steps=2000"};
    std::vector<std::string> options{"--quiet", "--max-failures", "100%"};
    options.insert(options.end(), poison.begin(), poison.end());
    Outcome const outcome = run_scene(options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results("s.nc");
    auto const status = file.values("status");
    for (Status const kind : {Status::geometry, Status::max_steps}) {
        EXPECT_GT(std::count(status.begin(), status.end(), static_cast<double>(kind)), 0) << static_cast<int>(kind);
    }
    auto const bad = std::find_if(status.begin(), status.end(), [](double s) { return s != 0; });
    ASSERT_NE(bad, status.end());
    auto const member = static_cast<std::size_t>(bad - status.begin());
    auto const named =
        outcome.out.find(fmt::format("  member {}: {}", member, status_names[static_cast<std::size_t>(*bad)]));
    ASSERT_NE(named, std::string::npos) << outcome.out;
    auto const at = outcome.out.find("    slideway ", named);
    ASSERT_NE(at, std::string::npos);
    std::string const command = outcome.out.substr(at + 13, outcome.out.find('\n', at) - at - 13);
    EXPECT_TRUE(command.ends_with(fmt::format("--member {}", member))) << command;

    std::string const shell =
        "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' " + command + " -o one.nc >/dev/null 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system(shell.c_str())), 3);
    ResultReader const one = results("one.nc");
    EXPECT_EQ(one.values("status"), std::vector<double>{*bad});
    for (char const* const name : {"end_time", "steps_accepted", "steps_rejected", "rhs_evaluations", "initial_y"}) {
        EXPECT_EQ(one.values(name)[0], file.values(name)[member]) << name;
    }
}

}  // namespace
}  // namespace slideway::testing
