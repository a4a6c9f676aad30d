// What stands in a folder of shards, and what of it can be trusted after damage.
#include "host/store/shard_folder.hpp"
#include "host/store/shard_writer.hpp"

#include <numeric>

#include "host/base/error.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::shard_folder_test {
namespace {

namespace fs = std::filesystem;

MemberSet range(std::uint64_t first, std::uint64_t count) { return MemberSet({first, count}); }

/// Bytes that tell shards apart.
std::vector<std::byte> content(int number, std::size_t size = 300) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 + static_cast<std::size_t>(number));
    return bytes;
}

class Shards : public testing::OutputFolder {
protected:
    Shards() : shards_(shards_of({"a program", "fused", range(0, 100), "schema = 1\n"})) {}

    void put(MemberSet const& members, int number) const { ShardStore(shards_).put(members, content(number)); }
    ShardFolder open() const { return ShardFolder(shards_); }
    std::string file(std::string const& name) const { return shards_ + "/" + name; }
    std::string first_manifest() const { return file("manifest-000001.txt"); }

    struct Found {
        MemberSet members;
        std::vector<std::string> damaged;  // names
        std::size_t gone = 0;              // of those
    };
    Found intact() const {
        std::vector<DamagedShard> damaged;
        Found found;
        EXPECT_NO_THROW(found.members = members_of(open().intact(damaged)));
        for (DamagedShard const& one : damaged) {
            found.damaged.push_back(one.shard.name);
            found.gone += one.is_gone ? 1 : 0;
        }
        return found;
    }

    std::string const shards_;
};

TEST_F(Shards, ListWhatWasPutIntoThem) {
    ShardStore store(shards_);
    MemberSet split = range(40, 2);
    split.add({60, 1});
    store.put(split, content(1));
    store.put(range(10, 5), content(2));
    ShardFolder const folder = open();
    EXPECT_EQ(folder.identity().scene, "schema = 1\n");
    EXPECT_EQ(folder.identity().members, range(0, 100));
    auto const listed = folder.listed();
    ASSERT_EQ(listed.size(), 2u);
    EXPECT_EQ(listed[0].members, range(10, 5));  // by first member
    EXPECT_EQ(listed[1].members, split);
    EXPECT_EQ(folder.read(listed[0]), content(2));
    EXPECT_EQ(folder.read(listed[1]), content(1));
    EXPECT_EQ(listed[0].name, "members-0000000010.nc");
    MemberSet all = split;
    all.add({10, 5});
    EXPECT_EQ(members_of(listed), all);
    EXPECT_EQ(intact().members, all);
    EXPECT_EQ(intact().damaged, std::vector<std::string>{});
}

TEST_F(Shards, OfSeveralProcessesStandSideBySide) {
    ShardStore one(shards_), other(shards_);
    one.put(range(0, 2), content(1));
    other.put(range(2, 2), content(2));
    one.put(range(4, 2), content(3));
    EXPECT_EQ(members_of(open().listed()), range(0, 6));
    EXPECT_TRUE(fs::exists(first_manifest()));
    EXPECT_TRUE(fs::exists(file("manifest-000002.txt")));
}

TEST_F(Shards, AreNotThoseOfAFolderWithoutIdentity) {
    EXPECT_TRUE(ShardFolder::exists(shards_));
    EXPECT_FALSE(ShardFolder::exists(path("none")));
    EXPECT_FALSE(ShardFolder::exists(folder()));
    EXPECT_THROW(ShardFolder(path("none")), FileError);
    EXPECT_THROW(ShardFolder{folder()}, FileError);
    write_durably(file("run.toml"), "not ours\n");
    EXPECT_THROW(open(), FileError);
}

TEST_F(Shards, KeepTheirIdentityWhicheverBitOfEitherFileChanges) {
    RunIdentity identity{"a program", "fused", range(0, 100), "schema = 1\n", {{"study.table", "\"a table.csv\""}, {"load.gas.table", "\"p = 1.csv\""}}};
    write_identity(shards_, identity);
    for (std::string const name : {"run.toml", "run-copy.toml"}) {
        std::string const whole = testing::bytes_of(file(name));
        for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
            std::string changed = whole;
            changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
            testing::put(file(name), changed);
            ShardFolder const folder = open();
            EXPECT_EQ(folder.identity().difference(identity), "") << bit;
            EXPECT_EQ(folder.identity().tables, identity.tables) << bit;
            EXPECT_EQ(folder.damaged_identity(), file(name)) << bit;
        }
        open().mend();
        EXPECT_EQ(testing::bytes_of(file(name)), whole);
        EXPECT_EQ(open().damaged_identity(), "");
    }
    fs::remove(file("run.toml"));
    EXPECT_TRUE(ShardFolder::exists(shards_));
    EXPECT_EQ(open().damaged_identity(), file("run.toml"));
    open().mend();
    EXPECT_TRUE(fs::exists(file("run.toml")));
}

TEST_F(Shards, OfAnIdentityWhoseFilesAreBothDamagedAreRefused) {
    write_identity(shards_, {"a program", "fused", range(0, 100), "schema = 1\n"});
    for (char const* const name : {"run.toml", "run-copy.toml"}) testing::flip_bit(file(name), 150);
    try {
        open();
        FAIL() << "was read";
    } catch (FileError const& error) {
        EXPECT_EQ(std::string(error.what()), file("run.toml") + ": is damaged (its checksum differs)");
    }
}

TEST_F(Shards, OfAnIdentityWithoutChecksumAreRead) {
    write_durably(file("run.toml"), "# What the shards beside this file belong to; slideway run --resume continues it.\n# program: a program\n"
                                    "# arithmetic: fused\n# members: 0-99\n\nschema = 1\n");
    RunIdentity const expected{"a program", "fused", range(0, 100), "schema = 1\n"};
    EXPECT_EQ(open().identity().difference(expected), "");
    EXPECT_EQ(open().damaged_identity(), "");
}

TEST_F(Shards, OfATornLastLineDoNotCount) {
    put(range(0, 4), 1);
    ShardStore store(shards_);
    store.put(range(4, 4), content(2));
    store.put(range(8, 4), content(3));
    std::string const manifest = file("manifest-000002.txt"), whole = testing::bytes_of(manifest);
    auto const last = whole.find('\n') + 1;
    // Wherever the machine stopped; the line is whole without its end.
    for (std::size_t size = last; size + 1 < whole.size(); ++size) {
        testing::put(manifest, whole.substr(0, size));
        EXPECT_EQ(members_of(open().listed()), range(0, 8)) << size;
        EXPECT_EQ(intact().members, range(0, 8)) << size;
    }
    testing::put(manifest, whole.substr(0, whole.size() - 1));
    EXPECT_EQ(intact().members, range(0, 12));
}

TEST_F(Shards, OfALineWithAChangedCharacterDoNotCount) {
    put(range(0, 4), 1);
    std::string const whole = testing::bytes_of(first_manifest());
    for (std::size_t at = 0; at + 1 < whole.size(); ++at) {
        for (char const changed : {static_cast<char>(whole[at] ^ 1), static_cast<char>(whole[at] ^ 4), '\n', '\0'}) {
            std::string other = whole;
            other[at] = changed;
            testing::put(first_manifest(), other);
            EXPECT_TRUE(open().listed().empty()) << at << other;
            EXPECT_TRUE(intact().members.empty()) << at << other;
        }
    }
}

TEST_F(Shards, OfAManifestOfAnythingElseAreNone) {
    for (std::string const& text : {std::string(), std::string("\n\n"), std::string(1000, ' '), std::string(1000, '\0'),
                                    std::string("a b c d e\n"), std::string("members-0.nc 5 zz 0-3 0123\n")}) {
        testing::put(first_manifest(), text);
        EXPECT_TRUE(open().listed().empty());
        EXPECT_TRUE(intact().members.empty());
    }
}

TEST_F(Shards, ThatWereCutShortAreFound) {
    put(range(0, 4), 1);
    put(range(4, 4), 2);
    fs::resize_file(file("members-0000000004.nc"), 299);
    EXPECT_EQ(members_of(open().listed()), range(0, 4));
    EXPECT_EQ(intact().members, range(0, 4));
    EXPECT_EQ(intact().damaged, std::vector<std::string>{"members-0000000004.nc"});
}

TEST_F(Shards, WithOneChangedBitAreFoundWhereverItIs) {
    put(range(0, 4), 1);
    put(range(4, 4), 2);
    std::string const victim = file("members-0000000000.nc");
    for (std::size_t at = 0; at < 300; at += 13) {
        testing::flip_bit(victim, at);
        EXPECT_EQ(intact().members, range(4, 4)) << at;
        EXPECT_EQ(intact().damaged, std::vector<std::string>{"members-0000000000.nc"});
        ShardFolder const folder = open();
        try {
            folder.read(folder.listed().front());  // its size is right
            FAIL() << "was taken for whole";
        } catch (FileError const& error) {
            EXPECT_NE(std::string(error.what()).find("members-0000000000.nc: "), std::string::npos) << error.what();
        }
        testing::flip_bit(victim, at);
    }
    EXPECT_EQ(intact().members, range(0, 8));
}

TEST_F(Shards, ThatAreGoneAreFound) {
    put(range(0, 4), 1);
    fs::remove(file("members-0000000000.nc"));
    EXPECT_TRUE(open().listed().empty());
    EXPECT_EQ(intact().damaged, std::vector<std::string>{"members-0000000000.nc"});
    EXPECT_EQ(intact().gone, 1u);
}

TEST_F(Shards, ThatCannotBeReadAreNotTakenForDamaged) {
    put(range(0, 4), 1);
    put(range(4, 4), 2);
    std::vector<DamagedShard> damaged;
    {
        // No file can be opened, though each is there.
        testing::NoMoreFiles const none;
        EXPECT_THROW(ShardFolder{shards_}, FileError);
    }
    ShardFolder const folder = open();
    std::string const victim = file("members-0000000000.nc");
    fs::rename(victim, path("whole.nc"));
    // A folder in its place and a link to itself have names, but cannot be read.
    fs::create_directories(victim);
    EXPECT_THROW(folder.intact(damaged), FileError);
    fs::remove(victim);
    fs::create_symlink(victim, victim);
    EXPECT_THROW(folder.intact(damaged), FileError);
    EXPECT_THROW(folder.listed(), FileError);
    fs::remove(victim);
    fs::rename(path("whole.nc"), victim);
    EXPECT_TRUE(damaged.empty());
    EXPECT_EQ(intact().members, range(0, 8));
}

TEST_F(Shards, ThatCannotBeLookedForAreNotTakenForNone) {
    // A folder that leads to itself.
    fs::create_symlink(path("loop"), path("loop"));
    EXPECT_THROW(ShardFolder::exists(path("loop")), FileError);
    EXPECT_FALSE(ShardFolder::exists(path("none")));
}

TEST_F(Shards, WithoutALineDoNotCount) {
    put(range(0, 4), 1);
    write_durably(file("members-0000000050.nc"), content(5));
    write_durably(file("something.txt"), "else");
    EXPECT_EQ(members_of(open().listed()), range(0, 4));
    EXPECT_EQ(intact().members, range(0, 4));
    EXPECT_EQ(intact().damaged, std::vector<std::string>{});
}

TEST_F(Shards, ThatRanAgainCountOnce) {
    // The same members twice, under one name and under two: the later shards hold.
    put(range(0, 4), 1);
    testing::flip_bit(file("members-0000000000.nc"), 17);
    put(range(0, 2), 2);  // takes the place of the former
    put(range(2, 2), 3);
    EXPECT_EQ(intact().members, range(0, 4));
    EXPECT_EQ(intact().damaged, std::vector<std::string>{});
    ShardFolder const folder = open();
    auto const listed = folder.listed();
    ASSERT_EQ(listed.size(), 2u);
    EXPECT_EQ(folder.read(listed[0]), content(2));
    EXPECT_EQ(folder.read(listed[1]), content(3));
}

TEST_F(Shards, ThatRanAgainInPartAreNotTakenForDamaged) {
    put(range(0, 4), 1);
    testing::flip_bit(file("members-0000000000.nc"), 17);
    put(range(0, 2), 2);
    // Members 2 and 3 are still to do, but the file of that name is whole: nobody may remove it.
    EXPECT_EQ(intact().members, range(0, 2));
    EXPECT_EQ(intact().damaged, std::vector<std::string>{});
    EXPECT_EQ(members_of(open().listed()), range(0, 2));
}

TEST_F(Shards, ThatAreDamagedAndReplacedUnderAnotherNameAreForgotten) {
    put(range(10, 4), 1);
    testing::flip_bit(file("members-0000000010.nc"), 17);
    put(range(8, 8), 2);
    EXPECT_EQ(intact().members, range(8, 8));
    EXPECT_EQ(intact().damaged, std::vector<std::string>{});
    EXPECT_EQ(members_of(open().listed()), range(8, 8));
    EXPECT_EQ(open().listed().size(), 1u);
}

TEST_F(Shards, CannotBePutWhereThereIsNoFolder) {
    ShardStore store(path("none"));
    EXPECT_THROW(store.put(range(0, 4), content(1)), FileError);
}

TEST_F(Shards, AreListedOnlyOnceTheyAreThere) {
    // The name is taken by a folder.
    fs::create_directories(file("members-0000000000.nc"));
    EXPECT_THROW(put(range(0, 4), 1), FileError);
    EXPECT_TRUE(open().listed().empty());
    EXPECT_FALSE(fs::exists(first_manifest()));
}

}  // namespace
}  // namespace slideway::shard_folder_test
