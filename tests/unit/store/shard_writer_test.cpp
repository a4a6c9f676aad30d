#include "host/store/shard_writer.hpp"

#include <chrono>
#include <future>
#include <thread>
#include <utility>

#include "host/base/error.hpp"
#include "host/store/result_view.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::shard_writer_test {
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

ShardImage image_of(BlockResult const& block) { return shard_image("a shard", {}, {}, block); }

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

TEST_F(Writer, MakesImagesOfCopiesInItsOwnThread) {
    std::string const shards = shards_of({"p", "fused", MemberSet({0, 100}), ""});
    std::promise<void> changed;
    std::shared_future<void> const is_changed = changed.get_future();
    std::vector<double> seen;
    std::thread::id maker;
    {
        ShardWriter writer(shards, [&](BlockResult const& block) {
            is_changed.wait();
            maker = std::this_thread::get_id();
            auto const add = [&seen](double x) { seen.push_back(x); };
            add(static_cast<double>(block.members[1]));
            add(block.inputs[1].y);
            add(block.records[1].time);
            for (auto const values :
                 {block.final_states, block.quantities, block.series, block.sections, block.growths})
                add(values[1]);
            return ShardImage();
        });
        std::vector<std::uint64_t> members{4, 5};
        std::vector<Inputs> inputs(2);
        std::vector<MemberRecord> records(2);
        inputs[1].y = 6;
        records[1].time = 7;
        std::vector<double> values[5];
        for (int i = 0; i < 5; ++i) values[i] = {0, 8.0 + i};
        writer.write({members, inputs, records, values[0], values[1], values[2], values[3], values[4]});
        members[1] = 0, inputs[1].y = 0, records[1].time = 0;
        for (auto& column : values) column[1] = 0;
        changed.set_value();
    }
    EXPECT_EQ(seen, (std::vector<double>{5, 6, 7, 8, 9, 10, 11, 12}));
    EXPECT_NE(maker, std::this_thread::get_id());
}

TEST_F(Writer, LetsTwoBlocksWait) {
    std::string const shards = shards_of({"p", "fused", MemberSet({0, 100}), ""});
    std::promise<void> begun, free;
    std::shared_future<void> const is_free = free.get_future();
    bool first = true;
    ShardWriter writer(shards, [&](BlockResult const& block) {
        if (std::exchange(first, false)) begun.set_value();
        is_free.wait();
        return image_of(block);
    });
    writer.write(Block(0, 5).view());
    begun.get_future().wait();
    writer.write(Block(5, 5).view());
    writer.write(Block(10, 5).view());
    auto fourth = std::async(std::launch::async, [&] { writer.write(Block(15, 5).view()); });
    EXPECT_EQ(fourth.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
    free.set_value();
    fourth.get();
    writer.finish();
    EXPECT_EQ(members_of(ShardFolder(shards).listed()), MemberSet({0, 20}));
}

TEST_F(Writer, TellsOfADiskThatFailed) {
    {
        ShardWriter writer(path("none"), image_of);
        writer.write(Block(0, 5).view());
        EXPECT_THROW(writer.finish(), FileError);
    }
    {
        // An image that cannot be made is told like a disk that failed.
        ShardWriter writer(path("none"), [](BlockResult const&) -> ShardImage { throw FileError("no image"); });
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
}  // namespace slideway::shard_writer_test
