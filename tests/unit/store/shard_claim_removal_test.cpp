// What a run removes of its folder of shards in the end, what it leaves there, and what it makes of a removal that was cut short.
#include "host/store/shard_claim.hpp"
#include "host/store/shard_folder.hpp"

#include "host/base/error.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::shard_claim_removal_test {
namespace {

namespace fs = std::filesystem;

// Each differs from a name of ours by little.
constexpr char const* look_alikes[] = {"members-of-the-board.nc",
                                       "members-000000003.nc",
                                       "members-00000000003.nc",
                                       "members-0000000003.nc.bak",
                                       "members-0000000003.txt",
                                       "my-members-0000000003.nc",
                                       "Members-0000000003.nc",
                                       "members-0000000003.nc.tmp.tmp",
                                       "statistics-0000000000.bin",
                                       "statistics-2024-1.bin",
                                       "statistics-0000000000-.bin",
                                       "statistics-0000000000-01.bin",
                                       "manifest-00001.txt",
                                       "manifest-000001.txt~",
                                       "manifest-of-cargo.txt",
                                       "manifest-0000001.txt",
                                       "damaged-notes.txt",
                                       "damaged-manifest-000001.txt",
                                       "damaged-",
                                       "run.toml.bak",
                                       "rerun.toml",
                                       "finished.toml.orig",
                                       "lock-smith",
                                       "lock-1-of-",
                                       "lock-1-of-2.txt",
                                       "lock-begin-1",
                                       "locked",
                                       "lock.tmp",
                                       "table.csv",
                                       ".table.csv",
                                       "my-table.csv",
                                       "Load.gas.table.csv",
                                       "study.table.csv.bak",
                                       "notes.txt",
                                       ".tmp"};

class Removal : public testing::OutputFolder {
protected:
    std::string const shards_ = path("out.nc.shards");

    static ShardClaim::Wanted wanted(bool resume = false) {
        MemberSet const all({0, 12});
        return {{"slideway 1", "fused", all, "a = 1\n"}, all, "", resume};
    }
    std::string file(std::string const& name) const { return shards_ + "/" + name; }
    void put(std::uint64_t first) const {
        ShardStore(shards_).put(MemberSet({first, 4}), std::vector<std::byte>(64, std::byte{'x'}));
    }
    /// A run that has finished eight members.
    void leave_shards() const {
        ShardClaim const claim(shards_, wanted());
        put(0);
        put(4);
    }
    /// As a process that was killed in the middle of the removal leaves it.
    void leave_remains() const {
        leave_shards();
        fs::rename(file("run.toml"), file("finished.toml"));
        fs::remove(file("members-0000000000.nc"));
    }
};

TEST_F(Removal, KnowsOurNamesFromThoseThatLookAlike) {
    for (char const* const name : look_alikes) EXPECT_EQ(kind_of(name), ShardFile::foreign) << name;
    for (char const* const name :
         {"members-0000000003.nc", "members-12345678901.nc", "members-0000000003.nc.tmp", "statistics-0000000064-1.bin",
          "statistics-0000000064-10.bin", "statistics-0000000064-0.bin.tmp", "manifest-000001.txt",
          "manifest-1000000.txt", "manifest-000001.txt.tmp", "damaged-members-0000000003.nc",
          "damaged-statistics-0000000003-2.bin", "study.table.csv", "study.table.csv.tmp", "load.gas_2.table.csv"}) {
        EXPECT_EQ(kind_of(name), ShardFile::content) << name;
    }
    for (char const* const name : {"run.toml", "run.toml.tmp", "run-copy.toml", "run-copy.toml.tmp", "finished.toml", "finished.toml.tmp"}) {
        EXPECT_EQ(kind_of(name), ShardFile::identity) << name;
    }
    for (char const* const name : {"lock", "lock-begin", "lock-3-of-8", "lock-10-of-128"}) {
        EXPECT_EQ(kind_of(name), ShardFile::lock) << name;
    }
}

TEST_F(Removal, LeavesWhatOnlyLooksLikeOurs) {
    ShardClaim claim(shards_, wanted());
    put(0);
    for (char const* const name : look_alikes) testing::put(file(name), "mine");
    testing::put(file("damaged-members-0000000000.nc"), "a shard of before");
    testing::put(file("members-0000000008.nc.tmp"), "half a shard");
    claim.remove_folder();
    std::vector<std::string> names(std::begin(look_alikes), std::end(look_alikes));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names_in(shards_), names);
}

/// A shard that is written and not yet listed is the run's all the same.
TEST_F(Removal, OfUnlistedShardsGoesByWhatIsInThem) {
    ShardClaim claim(shards_, wanted());
    put(0);
    testing::put(file("members-0000000004.nc"), "\x89HDF ... source slideway 0.1.0 ...");
    testing::put(file("statistics-0000000004-0.bin"), "... slkstat1 ...");
    testing::put(file("members-0000000008.nc"), "of the board");
    EXPECT_EQ(claim.remove_folder(), std::vector<std::string>{"members-0000000008.nc"});
    EXPECT_EQ(names_in(shards_), std::vector<std::string>{"members-0000000008.nc"});
}

TEST_F(Removal, OfWhatOthersPutThereIsNotForABeginnerToDo) {
    fs::create_directories(shards_);
    for (char const* const name : look_alikes) testing::put(file(name), "mine");
    {
        ShardClaim const claim(shards_, wanted());
        for (char const* const name : look_alikes) EXPECT_EQ(testing::bytes_of(file(name)), "mine") << name;
        put(0);
    }
    // Nor for one that takes the folder of a run that finished nothing.
    fs::remove(file("members-0000000000.nc"));
    ShardClaim::Wanted other = wanted();
    other.identity.scene = "a = 2\n";
    ShardClaim const claim(shards_, other);
    for (char const* const name : look_alikes) EXPECT_EQ(testing::bytes_of(file(name)), "mine") << name;
}

TEST_F(Removal, CutShortIsTakenUpByWhoBegins) {
    for (bool const resume : {false, true}) {
        leave_remains();
        {
            ShardClaim const claim(shards_, wanted(resume));
            EXPECT_TRUE(claim.done().empty());
        }
        for (std::string const& name : names_in(shards_)) {
            EXPECT_TRUE(kind_of(name) == ShardFile::identity || kind_of(name) == ShardFile::lock) << name;
        }
        fs::remove_all(shards_);
    }
}

TEST_F(Removal, CutShortIsEndedWhereTheResultStands) {
    leave_remains();
    ShardClaim::remove_remains(shards_);
    EXPECT_FALSE(fs::exists(shards_));
    // Of its last steps only locks are left, or the folder alone.
    for (bool const locks : {true, false}) {
        fs::create_directories(shards_);
        if (locks) {
            for (char const* const name : {"lock", "lock-begin"}) testing::put(file(name), "");
        }
        ShardClaim::remove_remains(shards_);
        EXPECT_FALSE(fs::exists(shards_));
    }
}

TEST_F(Removal, OfRemainsSparesAFolderThatARunIsToGoOnWith) {
    leave_shards();
    ShardClaim::remove_remains(shards_);
    EXPECT_EQ(ShardClaim(shards_, wanted(true)).done(), MemberSet({0, 8}));
}

TEST_F(Removal, CutShortByADiskIsTold) {
    ShardClaim claim(shards_, wanted());
    put(0);
    put(4);
    // A shard that cannot be removed, as here, where its name is a folder's.
    fs::remove(file("members-0000000004.nc"));
    fs::create_directories(file("members-0000000004.nc") + "/inside");
    EXPECT_THROW(claim.remove_folder(), FileError);
    EXPECT_TRUE(fs::exists(file("finished.toml")));
    EXPECT_FALSE(fs::exists(file("run.toml")));
    fs::remove_all(file("members-0000000004.nc"));
    claim.remove_folder();
    EXPECT_FALSE(fs::exists(shards_));
}

TEST_F(Removal, EmptiesTheFolderBehindALinkAndLeavesBoth) {
    fs::create_directories(path("scratch"));
    fs::create_directory_symlink(path("scratch"), shards_);
    {
        ShardClaim claim(shards_, wanted());
        put(0);
        EXPECT_TRUE(exists("scratch/members-0000000000.nc"));
        claim.remove_folder();
    }
    EXPECT_TRUE(fs::is_symlink(shards_));
    EXPECT_TRUE(fs::is_empty(path("scratch")));
    // The next run goes there again.
    leave_remains();
    ShardClaim::remove_remains(shards_);
    EXPECT_TRUE(fs::is_symlink(shards_));
    EXPECT_TRUE(fs::is_empty(path("scratch")));
}

TEST_F(Removal, TakesTheCopiesOfTablesAlong) {
    ShardClaim::Wanted with_table = wanted();
    for (char const* const name : {"study.table.csv", "load.gas.table.csv"}) with_table.tables[name] = std::make_shared<std::string const>("111");
    with_table.identity.tables = {{"study.table", "\"a.csv\""}, {"load.gas.table", "\"b.csv\""}};
    {
        ShardClaim const claim(shards_, with_table);
        for (auto const& [name, text] : with_table.tables) EXPECT_EQ(testing::bytes_of(file(name)), "111");
        put(0);
    }
    // One that a killed process had not written is made up for.
    fs::remove(file("load.gas.table.csv"));
    with_table.resume = true;
    ShardClaim claim(shards_, with_table);
    EXPECT_EQ(testing::bytes_of(file("load.gas.table.csv")), "111");
    // What has such a name and is of no table of the run is somebody's.
    testing::put(file("load.air.table.csv"), "mine");
    EXPECT_EQ(claim.remove_folder(), std::vector<std::string>{"load.air.table.csv"});
    EXPECT_EQ(names_in(shards_), std::vector<std::string>{"load.air.table.csv"});
}

}  // namespace
}  // namespace slideway::shard_claim_removal_test
