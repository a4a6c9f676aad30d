// Statistics of blocks, and their shards in a folder, of made-up members.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/shard_writer.hpp"

namespace slideway::block_statistics_test {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

StatisticsPlan plan() {
    return {selection_of(Quantity::peak_normal_force) | selection_of(Quantity::mode_time),
            {{"peak_normal_force", "", -infinity, 499}, {"mode_time", "line", 0, 1000}}};
}

/// Member k: force k, mode_time[line] 2 k, NaN of every 50th; 10 k + 3 fails at t = k; 10 k + 7 did not run.
struct MadeUpBlock {
    std::vector<std::uint64_t> members;
    std::vector<Inputs> inputs;
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities;

    MadeUpBlock(std::uint64_t first, std::size_t count)
        : inputs(count), records(count), states(count * state_size), quantities(count * quantity_columns, nan) {
        for (std::size_t i = 0; i < count; ++i) {
            std::uint64_t const member = first + i;
            members.push_back(member);
            auto const x = static_cast<double>(member);
            records[i].status = member % 10 == 3   ? Status::max_steps
                                : member % 10 == 7 ? Status::not_run
                                                   : Status::finished;
            records[i].time = x;
            records[i].steps_accepted = member;
            double* const row = quantities.data() + i * quantity_columns;
            row[quantity_column(Quantity::peak_normal_force)] = x;
            row[quantity_column(Quantity::mode_time) + 2] = member % 50 == 0 ? nan : 2 * x;
        }
    }
    BlockResult view() const { return {members, inputs, records, states, quantities, {}, {}, {}}; }
};

BlockStatistics statistics_of(std::uint64_t first, std::size_t count) {
    BlockStatistics statistics(plan());
    statistics.add(MadeUpBlock(first, count).view(), plan());
    return statistics;
}

TEST(BlockStatistics, CountsWhatEnded) {
    BlockStatistics const statistics = statistics_of(0, 1000);
    EXPECT_EQ(statistics.members().count(), 900u);
    EXPECT_FALSE(statistics.members().contains(7));
    EXPECT_EQ(statistics.ended(Status::finished), 800u);
    EXPECT_EQ(statistics.ended(Status::max_steps), 100u);
    EXPECT_EQ(statistics.ended(Status::geometry), 0u);
    // 0 + … + 999 without 7 + 17 + … + 997.
    EXPECT_EQ(statistics.work()[0], 499500u - 50200u);
    ASSERT_EQ(statistics.columns().size(), 5u);
    ColumnAccumulator const& force = statistics.columns()[0];
    EXPECT_EQ(force.count(), 800u);
    // Without 3 + 13 + … + 993 either.
    EXPECT_EQ(force.mean(), (499500.0 - 50200 - 49800) / 800);
    EXPECT_EQ(force.max(), 999);
    EXPECT_EQ(statistics.columns()[3].missing(), 20u);
    EXPECT_EQ(statistics.columns()[3].max(), 1998);
    EXPECT_EQ(statistics.columns()[1].missing(), 800u);
}

TEST(BlockStatistics, LimitsAreMetByFinishedMembersWithANumber) {
    BlockStatistics const statistics = statistics_of(0, 1000);
    // Below 500, of ten in a row eight.
    EXPECT_EQ(statistics.met()[0], 400u);
    // 2 k <= 1000: 0 to 500, eight in ten and member 500, without NaN of 0, 50, …, 500.
    EXPECT_EQ(statistics.met()[1], 401u - 11u);
    EXPECT_EQ(statistics.all_met(), 400u - 10u);
}

TEST(BlockStatistics, KeepsTheFirstFailures) {
    BlockStatistics late = statistics_of(1000, 2000);
    late.merge(statistics_of(0, 1000));
    ASSERT_EQ(late.failed().size(), BlockStatistics::most_failed);
    for (std::size_t i = 0; i < BlockStatistics::most_failed; ++i) {
        EXPECT_EQ(late.failed()[i].member, 10 * i + 3);
        EXPECT_EQ(late.failed()[i].time, static_cast<double>(10 * i + 3));
        EXPECT_EQ(late.failed()[i].status, Status::max_steps);
    }
}

TEST(BlockStatistics, OrderAndPartsLeaveNoTrace) {
    auto const whole = statistics_of(0, 3000).bytes();
    std::mt19937_64 engine(5);
    for (int round = 0; round < 4; ++round) {
        std::vector<BlockStatistics> parts;
        for (std::uint64_t from = 0; from < 3000;) {
            std::uint64_t const count = std::min<std::uint64_t>(3000 - from, 1 + engine() % 700);
            parts.push_back(statistics_of(from, count));
            from += count;
        }
        for (std::size_t i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[engine() % i]);
        BlockStatistics merged(plan());
        for (BlockStatistics const& part : parts) merged.merge(BlockStatistics::parse(part.bytes(), "part"));
        EXPECT_EQ(merged.bytes(), whole);
    }
}

TEST(BlockStatistics, RefusesWhatDoesNotBelong) {
    BlockStatistics statistics = statistics_of(0, 10);
    EXPECT_THROW(statistics.merge(statistics_of(9, 10)), FileError);
    EXPECT_THROW(statistics.merge(BlockStatistics({selection_of(Quantity::drive_work), {}})), FileError);
}

TEST(BlockStatistics, DamagedBytesAreTold) {
    auto const bytes = statistics_of(0, 200).bytes();
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 7) {
        EXPECT_THROW(BlockStatistics::parse(std::span(bytes).first(length), "x.bin"), FileError) << length;
    }
    auto longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THROW(BlockStatistics::parse(longer, "x.bin"), FileError);
    // Counts that name more than there is, wherever they stand.
    for (std::size_t at = 0; at + 8 <= 400; at += 8) {
        auto broken = bytes;
        for (std::size_t i = 0; i < 8; ++i) broken[at + i] = std::byte{0xff};
        try {
            BlockStatistics::parse(broken, "x.bin");
        } catch (FileError const& error) {
            EXPECT_EQ(std::string(error.what()).substr(0, 6), "x.bin:");
        }
    }
}

/// A folder of shards with an identity, into which made-up blocks go.
class StatisticsFolder : public ::testing::Test {
protected:
    StatisticsFolder() : path_(fs::temp_directory_path() / ("slideway_statistics_test_" + std::to_string(getpid()))) {
        fs::remove_all(path_);
        fs::create_directories(path_);
        write_durably((path_ / "run.toml").string(),
                      identity_text({"slideway", "fused", MemberSet({0, 100000}), "schema = 1\n"}));
    }
    ~StatisticsFolder() override { fs::remove_all(path_); }

    /// Blocks of ten members, of which nine ran.
    void put(ShardStore& store, std::uint64_t first_block, std::uint64_t blocks) const {
        for (std::uint64_t b = first_block; b < first_block + blocks; ++b) {
            ShardImage const image = statistics_image(plan(), {}, MadeUpBlock(10 * b, 10).view());
            store.put(image.members, image.bytes);
        }
    }
    ShardStore store() const { return ShardStore(path_.string(), joined_statistics); }
    ShardFolder folder() const { return ShardFolder(path_.string()); }
    std::vector<std::string> shards() const {
        std::vector<std::string> names;
        for (std::string const& name : names_in(path_.string())) {
            if (name.starts_with("statistics-")) names.push_back(name);
        }
        return names;
    }
    /// Statistics of the shards that count, as bytes.
    std::vector<std::byte> merged() const {
        ShardFolder const from = folder();
        BlockStatistics all(plan());
        for (Shard const& shard : from.listed()) all.merge(parse_statistics(from.read(shard), shard.name));
        return all.bytes();
    }
    void expect_whole(std::uint64_t blocks) const {
        EXPECT_EQ(merged(), statistics_of(0, 10 * blocks).bytes());
        std::vector<DamagedShard> damaged;
        EXPECT_EQ(members_of(folder().intact(damaged)).count(), 9 * blocks);
        EXPECT_TRUE(damaged.empty()) << damaged.size() << " " << damaged.front().shard.name;
    }
    fs::path const path_;
};

TEST_F(StatisticsFolder, ShardsBecomeFewerWhereTheyAreMany) {
    ShardStore to = store();
    std::size_t most = 0;
    for (std::uint64_t block = 0; block < 64 * 64 + 65; ++block) {
        put(to, block, 1);
        if (block % 16 == 0 || block % 64 > 61) most = std::max(most, shards().size());
    }
    EXPECT_LE(most, 2 * 64u + 1);
    // One of 64 × 64 blocks, one of 64, and one.
    EXPECT_EQ(shards(), (std::vector<std::string>{"statistics-0000000000-2.bin", "statistics-0000040960-1.bin",
                                                  "statistics-0000041600-0.bin"}));
    expect_whole(64 * 64 + 65);
}

TEST_F(StatisticsFolder, AJoinThatDidNotComeToItsEndLosesNothing) {
    {
        ShardStore to = store();
        put(to, 0, 63);
    }
    std::vector<std::string> const before = shards();
    fs::path const aside = path_.string() + "_aside";
    fs::remove_all(aside);
    fs::copy(path_, aside);
    // The same again, with the 64th: the others are joined.
    fs::remove_all(path_);
    fs::create_directories(path_);
    fs::copy_file(aside / "run.toml", path_ / "run.toml");
    {
        ShardStore to = store();
        put(to, 0, 64);
    }
    ASSERT_EQ(shards(), std::vector<std::string>{"statistics-0000000000-1.bin"});
    expect_whole(64);
    // Killed between the listing of the joined one and the removal of the last of the 64: some are still there.
    for (std::size_t const left : {std::size_t{1}, std::size_t{30}, before.size()}) {
        for (std::size_t i = before.size() - left; i < before.size(); ++i) {
            fs::copy_file(aside / before[i], path_ / before[i], fs::copy_options::overwrite_existing);
        }
        expect_whole(64);
    }
    // Killed before the joined one was listed: its file is there and nobody knows it.
    fs::rename(path_ / "manifest-000001.txt", path_ / "kept");
    fs::copy_file(aside / "manifest-000001.txt", path_ / "manifest-000001.txt");
    expect_whole(63);
    // Killed while its line was written: the line is torn.
    std::string text;
    {
        std::ifstream in(path_ / "kept", std::ios::binary);
        text.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::ofstream(path_ / "manifest-000001.txt", std::ios::binary) << text.substr(0, text.size() - 9);
    ShardImage const last = statistics_image(plan(), {}, MadeUpBlock(630, 10).view());
    write_durably((path_ / "statistics-0000000630-0.bin").string(), last.bytes);
    expect_whole(64);
    fs::remove_all(aside);
}

TEST_F(StatisticsFolder, AResumedRunJoinsItsOwn) {
    {
        ShardStore to = store();
        put(to, 0, 70);
    }
    {
        ShardStore to = store();
        put(to, 70, 70);
    }
    // 1 joined and 6; 1 joined and 6.
    EXPECT_EQ(shards().size(), 14u);
    expect_whole(140);
}

TEST_F(StatisticsFolder, ADamagedShardIsTold) {
    {
        ShardStore to = store();
        put(to, 0, 66);
    }
    std::ofstream(path_ / "statistics-0000000000-1.bin", std::ios::binary | std::ios::in)
        .seekp(100)
        .put('\x55')
        .put('\xaa');
    std::vector<DamagedShard> damaged;
    EXPECT_EQ(members_of(folder().intact(damaged)).count(), 9 * 2u);
    // Those that it was made of are gone, and their members with it.
    EXPECT_EQ(std::count_if(damaged.begin(), damaged.end(),
                            [](auto const& s) { return s.shard.name == "statistics-0000000000-1.bin"; }),
              1);
    // A successor of the same name is whole, whatever the older line says of it.
    fs::remove(path_ / "statistics-0000000000-1.bin");
    {
        ShardStore to = store();
        put(to, 0, 64);
    }
    damaged.clear();
    EXPECT_EQ(members_of(folder().intact(damaged)).count(), 9 * 66u);
    EXPECT_TRUE(damaged.empty()) << damaged.front().shard.name;
    expect_whole(66);
}

}  // namespace
}  // namespace slideway::block_statistics_test
