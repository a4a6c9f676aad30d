// What a folder of shards is safe from: disks that fail for a while, and processes that come and go.
#include <thread>

#include "host/base/error.hpp"
#include "host/store/shard_claim.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::shard_claim_rivals_test {
namespace {

namespace fs = std::filesystem;

class ClaimAmongRivals : public testing::OutputFolder {
protected:
    std::string const shards_ = path("out.nc.shards");

    ShardClaim::Wanted wanted(std::string const& part, bool resume = false,
                              std::string const& scene = "a = 1\n") const {
        MemberSet const all({0, 12});
        return {{"slideway 1", "fused", all, scene}, all, part, resume};
    }
    std::string file(std::string const& name) const { return shards_ + "/" + name; }
    void put(std::uint64_t first) const {
        ShardStore(shards_).put(MemberSet({first, 4}), std::vector<std::byte>(64, std::byte{'x'}));
    }
    std::string refusal(ShardClaim::Wanted const& of) const {
        try {
            ShardClaim const claim(shards_, of);
        } catch (FileError const& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(ClaimAmongRivals, KeepsShardsThatCannotBeReadForNow) {
    {
        ShardClaim const claim(shards_, wanted(""));
        put(0);
        put(4);
    }
    // The disk gives one shard no longer: here its name leads to itself.
    std::string const victim = file("members-0000000004.nc");
    fs::rename(victim, path("whole.nc"));
    fs::create_symlink(victim, victim);
    for (char const* const scene : {"a = 1\n", "a = 2\n"}) {
        for (bool const resume : {true, false}) {
            std::string const line = refusal(wanted("", resume, scene));
            EXPECT_TRUE(line.starts_with(victim + ": cannot ")) << line;
        }
    }
    EXPECT_TRUE(fs::is_symlink(victim));
    EXPECT_EQ(ShardFolder(shards_).identity().scene, "a = 1\n");
    fs::remove(victim);
    fs::rename(path("whole.nc"), victim);
    ShardClaim const claim(shards_, wanted("", true));
    EXPECT_EQ(claim.done(), MemberSet({0, 8}));
    EXPECT_TRUE(claim.damaged().empty());
}

TEST_F(ClaimAmongRivals, KeepsTheFolderOfARunWhoseIdentityCannotBeLookedAt) {
    {
        ShardClaim const claim(shards_, wanted(""));
        put(0);
    }
    fs::remove(file("run.toml"));
    fs::create_symlink(file("run.toml"), file("run.toml"));
    EXPECT_NE(refusal(wanted("")), "");
    EXPECT_TRUE(fs::exists(file("members-0000000000.nc")));
}

TEST_F(ClaimAmongRivals, SaysOfAShardThatIsGoneThatItIs) {
    {
        ShardClaim const claim(shards_, wanted(""));
        put(0);
        put(4);
    }
    fs::remove(file("members-0000000004.nc"));
    ShardClaim const claim(shards_, wanted("", true));
    ASSERT_EQ(claim.damaged().size(), 1u);
    EXPECT_TRUE(claim.damaged()[0].is_gone);
    EXPECT_FALSE(fs::exists(file("damaged-members-0000000004.nc")));
}

TEST_F(ClaimAmongRivals, OfAPartIsRefusedWhileOneOfAnotherDivisionIsAtWork) {
    {
        ShardClaim const half(shards_, wanted("1-of-2"));
        std::string const line = refusal(wanted("2-of-3"));
        EXPECT_NE(line.find(", part 1-of-2 of another division than part 2-of-3; wait for its end or divide the run alike"), line.npos) << line;
        EXPECT_EQ(refusal(wanted("2-of-2")), "");
    }
    ShardClaim const third(shards_, wanted("2-of-3"));
    EXPECT_EQ(refusal(wanted("3-of-3")), "");
    EXPECT_NE(refusal(wanted("1-of-2")), "");
    EXPECT_NE(refusal(wanted("3-of-13")), "");
}

TEST_F(ClaimAmongRivals, OnALockWhoseFileWasRemovedIsNone) {
    fs::create_directories(shards_);
    std::string const name = file("lock-begin");
    auto holder = std::make_unique<FileLock>(name, FileLock::Kind::alone, FileLock::Wait::yes);
    std::atomic<bool> has_begun = false;
    std::thread waits([&] {
        ShardClaim const claim(shards_, wanted(""));
        has_begun = true;
        // The file that it holds is the one that others see.
        EXPECT_NE(refusal(wanted("", true)), "");
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(has_begun);
    // As a run that ends: the folder goes while it is held.
    fs::remove_all(shards_);
    holder.reset();
    waits.join();
    EXPECT_TRUE(has_begun);
    EXPECT_TRUE(ShardFolder::exists(shards_));
}

TEST_F(ClaimAmongRivals, OnALockThatIsHeldAgainAfterItsRemovalWaits) {
    std::string const name = path("lock");
    auto first = std::make_unique<FileLock>(name, FileLock::Kind::alone, FileLock::Wait::yes);
    std::atomic<bool> has_it = false;
    std::thread waits([&] {
        FileLock const lock(name, FileLock::Kind::alone, FileLock::Wait::yes);
        has_it = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    first->remove();
    auto second = std::make_unique<FileLock>(name, FileLock::Kind::alone, FileLock::Wait::no, Rival{"held"});
    first.reset();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(has_it);  // what it waited for is nobody's any more
    second.reset();
    waits.join();
    EXPECT_TRUE(has_it);
}

}  // namespace
}  // namespace slideway::shard_claim_rivals_test
