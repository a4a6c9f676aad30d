#include "host/output/shard_writer.hpp"

#include "host/output/result_reader.hpp"
#include "host/scene/error.hpp"
#include "output_fixture.hpp"

namespace slideway {
namespace {

struct Block {
    std::vector<std::uint64_t> members;
    std::vector<Inputs> inputs;
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities;

    Block(std::uint64_t first, std::size_t count, Status status = Status::finished)
        : inputs(count),
          records(count),
          states(count * state_size, static_cast<double>(first)),
          quantities(count * quantity_columns, 1.0) {
        for (std::size_t i = 0; i < count; ++i) members.push_back(first + i), records[i].status = status;
    }
    BlockResult view() const { return {members, inputs, records, states, quantities, {}, {}, {}}; }
};

ShardImage image_of(BlockResult const& block) { return shard_image("a shard", {}, {}, block, {}); }

class Writer : public testing::OutputFolder {};

TEST_F(Writer, HasEverythingOnTheDiskWhenItIsFinished) {
    std::string const shards = shards_of({"p", "fused", MemberSet({0, 100}), ""});
    ShardWriter writer(shards, image_of);
    for (std::uint64_t i = 0; i < 20; ++i) {
        Block block(5 * i, 5);
        writer.write(block.view());
        block.states.assign(block.states.size(), -1.0);  // it took a copy
    }
    writer.finish();
    std::vector<DamagedShard> damaged;
    auto const whole = ShardFolder(shards).intact(damaged);
    EXPECT_TRUE(damaged.empty());
    EXPECT_EQ(whole.size(), 20u);
    EXPECT_EQ(members_of(whole), MemberSet({0, 100}));
    for (Shard const& shard : whole) {
        ResultReader const result(shards + "/" + shard.name);
        EXPECT_EQ(result.values("final_y"),
                  std::vector<double>(5, static_cast<double>(shard.members.ranges()[0].first)));
    }
}

TEST_F(Writer, KeepsWhatItWasGivenAlsoIfNobodyFinishesIt) {
    std::string const shards = shards_of({"p", "fused", MemberSet({0, 100}), ""});
    {
        ShardWriter writer(shards, image_of);
        writer.write(Block(0, 5).view());
        writer.write(Block(5, 5).view());
    }
    EXPECT_EQ(members_of(ShardFolder(shards).listed()), MemberSet({0, 10}));
}

TEST_F(Writer, WritesNothingForMembersThatHaveNotRun) {
    std::string const shards = shards_of({"p", "fused", MemberSet({0, 100}), ""});
    ShardWriter writer(shards, image_of);
    writer.write(Block(0, 5, Status::not_run).view());
    writer.finish();
    EXPECT_EQ(names_in(shards), std::vector<std::string>{"run.toml"});
}

TEST_F(Writer, TellsOfADiskThatFailed) {
    {
        ShardWriter writer(path("none"), image_of);
        writer.write(Block(0, 5).view());
        EXPECT_THROW(writer.finish(), FileError);
    }
    // In a long run a later block hears of it: two may wait, so the fourth at the latest.
    ShardWriter writer(path("none"), image_of);
    EXPECT_THROW(
        {
            for (std::uint64_t i = 0; i < 4; ++i) writer.write(Block(5 * i, 5).view());
        },
        FileError);
}

}  // namespace
}  // namespace slideway
