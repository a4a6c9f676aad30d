// Runs that are divided among the jobs of an array, and the file that is made of their shards.
#include "tests/system/resumed.hpp"

#include "host/backend/backend.hpp"

namespace slideway::testing::parts_test {
namespace {

class Parts : public Resumed {};
class MergeOfShards : public Resumed {};

TEST_F(Parts, TogetherGiveTheSameResult) {
    ASSERT_EQ(run_scene({"--no-progress", "-o", "whole.nc"}).code, 0);
    for (char const* const part : {"2/3", "3/3", "1/3"}) {
        EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, std::string(part) == "2/3" ? 4 : 5);
        fs::remove(path("s.nc"));
        Outcome const outcome = run_scene({"--no-progress", "--shard", part});
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

TEST_F(Parts, LeaveEachOtherAlone) {
    EXPECT_EQ(run_scene({"--no-progress", "--shard", "1/3"}).code, 0);
    EXPECT_EQ(run_scene({"--no-progress", "--shard", "2/3", "--max-hours", "0"}).code, 5);
    expect_refusal(2, "holds 22 finished members of this run; add --resume",
                   {"run", "s.toml", "--no-progress", "--shard", "1/3"});
    Outcome const again = run_scene({"--shard", "1/3", "--resume"});
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.err.find("resuming: 22 of 22 members are done\n"), std::string::npos) << again.err;
    // A run of the whole goes on with what parts have done, and makes the file.
    Outcome const whole = run_scene({"--resume"});
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_NE(whole.err.find("resuming: 22 of 64 members are done\n"), std::string::npos) << whole.err;
    EXPECT_EQ(results("s.nc").values("status"), std::vector<double>(64, 0));
}

TEST_F(Parts, OfAnotherArithmeticAreRefused) {
    EXPECT_EQ(run_scene({"--no-progress", "--shard", "1/2"}).code, 0);
    let_shards_be_contracted();
    expect_refusal(2, "(the arithmetic was contracted (a build with SLIDEWAY_CUDA_FMAD), is fused)",
                   {"run", "s.toml", "--no-progress", "--shard", "2/2"});
}

TEST_F(Parts, MayHaveInstructionSetsOfTheirOwn) {
    ASSERT_EQ(run_scene({"--no-progress", "-o", "whole.nc"}).code, 0);
    std::size_t part = 0;
    std::string const count = std::to_string(built_isas().size());
    for (Isa const isa : built_isas()) {
        std::string const name(name_of(is_supported(isa) ? isa : Isa::scalar));
        EXPECT_EQ(run_scene({"--no-progress", "--shard", std::to_string(++part) + "/" + count, "--isa", name}).code, 0);
    }
    EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
}

TEST_F(Parts, MayBeMoreThanTheMembers) {
    for (int part = 1; part <= 5; ++part) {
        EXPECT_EQ(run_scene({"--no-progress", "--members", "9..11", "--shard", fmt::format("{}/5", part), "-o", "s.nc"}).code,
                  0);
    }
    EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(results("s.nc").values("member"), (std::vector<double>{9, 10, 11}));
}

TEST_F(Parts, ThatThereAreNotAreRefused) {
    for (char const* const part : {"4/3", "0/3", "x", "3", "1/0", "-1/3", "1/3/5", "1.5/3", ""}) {
        if (*part == '\0') continue;
        expect_refusal(2, std::string("--shard ") + part + ": give the part", {"run", "s.toml", "--shard", part});
    }
}

TEST_F(MergeOfShards, TakesAnUnfinishedFolderAndSaysSo) {
    make_unfinished();
    Outcome const outcome = run({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_EQ(outcome.code, 5);
    std::string const last = "slideway: 16 of 64 members have not run; run them and merge again\n";
    EXPECT_TRUE(outcome.err.ends_with(last)) << outcome.err;
    EXPECT_NE(outcome.err.find(shard(16) + ": is gone; its members are left out"), std::string::npos) << outcome.err;
    ResultReader const file = results("m.nc");
    EXPECT_EQ(file.attribute("completeness"), "16 of 64 members not run");
    auto const status = file.values("status");
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(status[i], i / 8 == 2 || i / 8 == 5 ? -1 : 0) << i;
    EXPECT_EQ(run({"info", "m.nc"}).code, 0);
    EXPECT_EQ(run_scene({"--no-progress", "--resume"}).code, 0);  // the shards were still there
    // An incomplete file is not what there is to resume: its run begins anew.
    EXPECT_EQ(run_scene({"--no-progress", "--resume", "-o", "m.nc"}).code, 0);
    EXPECT_EQ(hash_of("m.nc"), hash_of("s.nc"));
}

TEST_F(MergeOfShards, LeavesADamagedShardOutAndSaysSo) {
    make_shards();
    std::string bytes = file_text(path(shard(24)));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(path(shard(24)), std::ios::binary) << bytes;
    Outcome const outcome = run({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.err, "warning: " + shard(24) +
                               ": is not what was written; its members are left out: slideway run --resume runs them "
                               "again\nslideway: 8 of 64 members have not run; run them and merge again\n");
    EXPECT_EQ(results("m.nc").values("status")[24], -1);
    EXPECT_EQ(results("m.nc").values("status")[32], 0);
}

TEST_F(MergeOfShards, NeverWritesAmongThem) {
    make_shards();
    expect_refusal(4, "is what this command reads", {"merge", "s.nc.shards", "-o", "s.nc.shards/run.toml", "--force"});
    for (std::string const name : {"s.nc.shards/table.csv", "s.nc.shards/out.nc"}) {
        expect_refusal(4, name + ": lies in the folder of the shards", {"merge", "s.nc.shards", "-o", name});
    }
    EXPECT_EQ(run_scene({"--no-progress", "--resume"}).code, 0);
}

TEST_F(MergeOfShards, TakesOnlyFoldersOfShards) {
    fs::create_directories(path("empty"));
    expect_refusal(4, "empty: is no folder of shards", {"merge", "empty", "-o", "m.nc"});
    expect_refusal(4, "none: is no folder of shards", {"merge", "none", "-o", "m.nc"});
    make_shards();
    expect_refusal(4, "there is no folder", {"merge", "s.nc.shards", "-o", "none/m.nc"});
}

TEST_F(MergeOfShards, TakesShardsThatAreResultsThemselves) {
    make_shards();
    Outcome const outcome = run({"info", shard(24)});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("matches the data"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("finished         8"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace slideway::testing::parts_test
