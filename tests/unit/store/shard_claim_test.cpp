// Who may write into a folder of shards, and what becomes of what it holds.
#include "host/store/shard_claim.hpp"
#include "host/store/shard_writer.hpp"

#include "host/base/error.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::shard_claim_test {
namespace {

namespace fs = std::filesystem;

RunIdentity identity_of(std::string const& gravity = "9.81") {
    return {"slideway 1", "fused", MemberSet({0, 12}), "schema = 1\n\n[mechanism]\ngravity = " + gravity + "\n"};
}

ShardClaim::Wanted whole_run(bool resume = false, RunIdentity const& identity = identity_of()) {
    return {identity, identity.members, "", resume};
}

ShardClaim::Wanted part(std::uint64_t number, bool resume = false, RunIdentity const& identity = identity_of()) {
    return {identity, MemberSet({4 * (number - 1), 4}), fmt::format("{}-of-3", number), resume};
}

std::vector<std::string> names_of(std::vector<DamagedShard> const& shards) {
    std::vector<std::string> names;
    for (DamagedShard const& one : shards) names.push_back(one.shard.name);
    return names;
}

class Claim : public testing::OutputFolder {
protected:
    std::string const shards_ = path("out.nc.shards");

    void put(std::uint64_t first, std::uint64_t count, char fill = 'x') const {
        ShardStore(shards_).put(MemberSet({first, count}), std::vector<std::byte>(64, static_cast<std::byte>(fill)));
    }
    std::string file(std::string const& name) const { return shards_ + "/" + name; }
    /// The line of the refusal; "" if there is none.
    template <class Error> std::string refusal(ShardClaim::Wanted const& wanted) const {
        try {
            ShardClaim const claim(shards_, wanted);
        } catch (Error const& error) {
            return error.what();
        }
        return "";
    }
    std::string refused_scene(ShardClaim::Wanted const& wanted) const { return refusal<SceneError>(wanted); }
    std::string refused_file(ShardClaim::Wanted const& wanted) const { return refusal<FileError>(wanted); }
};

TEST_F(Claim, MakesTheFolderAndSaysWhoseItIs) {
    ShardClaim const claim(shards_, whole_run());
    EXPECT_TRUE(claim.done().empty());
    EXPECT_TRUE(claim.damaged().empty());
    EXPECT_EQ(ShardFolder(shards_).identity().difference(identity_of()), "");
}

TEST_F(Claim, NeedsAFolderForItsFolder) {
    EXPECT_THROW(ShardClaim(path("none/out.nc.shards"), whole_run()), FileError);
    testing::put(shards_, "a file");
    EXPECT_THROW(ShardClaim(shards_, whole_run()), FileError);
    EXPECT_EQ(testing::bytes_of(shards_), "a file");
}

TEST_F(Claim, GoesOnWithWhatIsDone) {
    {
        ShardClaim const claim(shards_, whole_run());
        put(3, 2);
        put(7, 1);
    }
    ShardClaim const claim(shards_, whole_run(true));
    MemberSet expected({3, 2});
    expected.add({7, 1});
    EXPECT_EQ(claim.done(), expected);
}

TEST_F(Claim, ToGoOnWithNothingBegins) {
    ShardClaim const claim(shards_, whole_run(true));
    EXPECT_TRUE(claim.done().empty());
    EXPECT_TRUE(ShardFolder::exists(shards_));
}

TEST_F(Claim, DoesNotThrowAwayFinishedMembersUnasked) {
    {
        ShardClaim const claim(shards_, whole_run());
        put(3, 2);
    }
    EXPECT_EQ(refused_scene(whole_run()),
              shards_ + ": holds 2 finished members of this run; add --resume to go on with it, or move the folder away");
    EXPECT_EQ(members_of(ShardFolder(shards_).listed()), MemberSet({3, 2}));
}

TEST_F(Claim, IsRefusedWhereAnotherRunHasFinishedMembers) {
    {
        ShardClaim const claim(shards_, whole_run());
        put(3, 1);
    }
    for (bool const resume : {false, true}) {
        std::string const line = refused_scene(whole_run(resume, identity_of("1.62")));
        EXPECT_NE(line.find("1 finished member of another run (mechanism.gravity was 9.81, is 1.62)"),
                  std::string::npos)
            << line;
        EXPECT_EQ(line.find("cannot resume") != std::string::npos, resume) << line;
    }
    RunIdentity more = identity_of();
    more.members = MemberSet({0, 20});
    EXPECT_NE(refused_scene(whole_run(true, more)).find("the members were 0-11, are 0-19"), std::string::npos);
    EXPECT_EQ(ShardFolder(shards_).identity().difference(identity_of()), "");
    EXPECT_EQ(members_of(ShardFolder(shards_).listed()), MemberSet({3, 1}));
}

TEST_F(Claim, TakesTheFolderOfAnotherRunThatFinishedNothing) {
    { ShardClaim const claim(shards_, whole_run()); }
    {
        ShardClaim const claim(shards_, whole_run(false, identity_of("1.62")));
        EXPECT_EQ(ShardFolder(shards_).identity().scene, identity_of("1.62").scene);
        put(0, 1);
    }
    // A shard that is damaged is not finished.
    testing::flip_bit(file("members-0000000000.nc"), 20);
    ShardClaim const claim(shards_, whole_run());
    EXPECT_EQ(ShardFolder(shards_).identity().difference(identity_of()), "");
    EXPECT_FALSE(fs::exists(file("members-0000000000.nc")));
    EXPECT_TRUE(claim.done().empty());
}

TEST_F(Claim, IsRefusedWhereNothingSaysWhatShardsBelongTo) {
    {
        ShardClaim const claim(shards_, whole_run());
        put(3, 2);
    }
    fs::remove(file("run.toml"));
    fs::remove(file("run-copy.toml"));
    for (bool const resume : {false, true}) {
        EXPECT_EQ(refused_scene(whole_run(resume)),
                  shards_ +
                      ": holds shards but no run.toml, which says what they belong to; give another name with "
                      "-o, or move the folder away");
    }
    EXPECT_TRUE(fs::exists(file("members-0000000003.nc")));
    EXPECT_TRUE(fs::exists(file("manifest-000001.txt")));
    ShardClaim::remove_remains(shards_);  // these are none
    EXPECT_TRUE(fs::exists(file("members-0000000003.nc")));
}

TEST_F(Claim, HasDamagedShardsRunAgain) {
    {
        ShardClaim const claim(shards_, whole_run());
        put(0, 4);
        put(4, 4);
    }
    testing::flip_bit(file("members-0000000004.nc"), 20);
    std::string const bytes = testing::bytes_of(file("members-0000000004.nc"));
    {
        ShardClaim const claim(shards_, whole_run(true));
        EXPECT_EQ(claim.done(), MemberSet({0, 4}));
        EXPECT_EQ(names_of(claim.damaged()), std::vector<std::string>{"members-0000000004.nc"});
        EXPECT_FALSE(fs::exists(file("members-0000000004.nc")));
        EXPECT_EQ(testing::bytes_of(file("damaged-members-0000000004.nc")), bytes);
        put(4, 2, 'y');
    }
    // The second shard of that name is whole, though the first one's line still stands.
    ShardClaim const claim(shards_, whole_run(true));
    EXPECT_EQ(claim.done(), MemberSet({0, 6}));
    EXPECT_EQ(names_of(claim.damaged()), std::vector<std::string>{});
    EXPECT_EQ(members_of(ShardFolder(shards_).listed()), MemberSet({0, 6}));
}

TEST_F(Claim, KeepsOthersOut) {
    ShardClaim const claim(shards_, whole_run());
    put(0, 1);
    for (auto const& wanted :
         {whole_run(), whole_run(true), part(1), part(1, true), whole_run(false, identity_of("1"))}) {
        EXPECT_EQ(refused_file(wanted),
                  fmt::format("{}: is being written by process {}; wait for its end or give another name with -o", shards_, getpid()));
    }
    EXPECT_EQ(members_of(ShardFolder(shards_).listed()), MemberSet({0, 1}));
}

TEST_F(Claim, EndsWithItsHolder) {
    { ShardClaim const claim(shards_, whole_run()); }
    EXPECT_NO_THROW(ShardClaim(shards_, whole_run()));
    // Nor does a refused one stay.
    {
        ShardClaim const claim(shards_, whole_run());
        put(0, 1);
    }
    EXPECT_NE(refused_scene(whole_run()), "");
    EXPECT_NO_THROW(ShardClaim(shards_, whole_run(true)));
}

TEST_F(Claim, OfPartsStandSideBySide) {
    ShardClaim const first(shards_, part(1)), third(shards_, part(3));
    put(0, 2);
    put(8, 4);
    ShardClaim const second(shards_, part(2));  // what other parts finished is nothing to go on with
    EXPECT_TRUE(second.done().empty());
    EXPECT_NE(refused_file(part(2)), "");
    EXPECT_NE(refused_file(part(2, true)), "");
    EXPECT_NE(refused_file(whole_run(true)), "");
}

TEST_F(Claim, OfAPartGoesOnWithItsOwnMembers) {
    {
        ShardClaim const first(shards_, part(1)), second(shards_, part(2));
        put(0, 2);
        put(4, 3);
    }
    EXPECT_NE(refused_scene(part(1)).find("holds 2 finished members of this run"), std::string::npos);
    EXPECT_EQ(refused_scene(part(3)), "");
    ShardClaim const first(shards_, part(1, true)), second(shards_, part(2, true));
    EXPECT_EQ(first.done(), MemberSet({0, 2}));
    EXPECT_EQ(second.done(), MemberSet({4, 3}));
}

TEST_F(Claim, OfAPartLeavesTheDamageOfOthersToThem) {
    {
        ShardClaim const first(shards_, part(1)), second(shards_, part(2));
        put(0, 2);
        put(4, 3);
    }
    testing::flip_bit(file("members-0000000000.nc"), 20);
    {
        ShardClaim const second(shards_, part(2, true));
        EXPECT_EQ(names_of(second.damaged()), std::vector<std::string>{});
        EXPECT_TRUE(fs::exists(file("members-0000000000.nc")));
    }
    EXPECT_EQ(names_of(ShardClaim(shards_, part(1, true)).damaged()),
              std::vector<std::string>{"members-0000000000.nc"});
}

TEST_F(Claim, OfAPartDoesNotTakeTheFolderFromPartsAtWork) {
    {
        ShardClaim const first(shards_, part(1));  // has finished nothing yet
        EXPECT_NE(refused_file(part(2, false, identity_of("1.62"))), "");
        EXPECT_EQ(ShardFolder(shards_).identity().difference(identity_of()), "");
        EXPECT_EQ(refused_file(part(2)), "");
    }
    // Now it is nobody's, and those of the new run still stand side by side.
    ShardClaim const second(shards_, part(2, false, identity_of("1.62")));
    EXPECT_EQ(ShardFolder(shards_).identity().scene, identity_of("1.62").scene);
    EXPECT_EQ(refused_file(part(3, false, identity_of("1.62"))), "");
}

TEST_F(Claim, RemovesItsFolderInTheEnd) {
    ShardClaim claim(shards_, whole_run());
    put(0, 4);
    put(4, 8);
    testing::put(file("damaged-members-0000000000.nc"), "a shard of before");
    claim.remove_folder();
    EXPECT_FALSE(fs::exists(shards_));
}

TEST_F(Claim, RemovesNothingThatIsNotOfTheRun) {
    ShardClaim claim(shards_, whole_run());
    put(0, 4);
    testing::put(file("notes.txt"), "mine");
    claim.remove_folder();
    EXPECT_EQ(testing::bytes_of(file("notes.txt")), "mine");
    EXPECT_FALSE(ShardFolder::exists(shards_));
    EXPECT_EQ(names_in(shards_), std::vector<std::string>{"notes.txt"});
}

}  // namespace
}  // namespace slideway::shard_claim_test
