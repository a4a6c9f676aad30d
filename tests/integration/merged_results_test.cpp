// However members are spread over shards, the merged file is the same to the last bit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "host/base/error.hpp"
#include "host/store/result_view.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::merged_results_test {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_sections = 3, samples = 2, series = 2;
constexpr std::size_t row_size = section_columns(state_size);

/// Of the run: with gaps, as --members and a continued run make them.
MemberSet run_members() {
    MemberSet members({3, 6});
    members.add({12, 1});
    members.add({20, 7});
    return members;
}

double value(std::uint64_t member, int variable, std::size_t place = 0) {
    return static_cast<double>(member) + 1000.0 * variable + static_cast<double>(place) / 64;
}

std::size_t sections_of(std::uint64_t member) { return member * 5 % (most_sections + 1); }

ResultLayout layout() {
    ResultLayout layout;
    layout.members = run_members();
    layout.sample_times = {0.0, 0.5};
    layout.quantities = Selection{1} << static_cast<int>(Quantity::drive_work) |
                        Selection{1} << static_cast<int>(Quantity::mode_time) |
                        Selection{1} << static_cast<int>(Quantity::peak_apex_force);
    layout.series = 0b101;  // y and vy
    layout.parameters = {parameter_column("initial.y", "m", "vertical position at the start", &Inputs::y),
                         parameter_column("joint.clearance", "m", "clearance", &Inputs::clearance_y)};
    layout.sections = most_sections;
    layout.crossings = true;
    layout.study = {
        {.name = "exponent", .unit = "1", .meaning = "number of the exponent", .dimensions = {"exponent"}, .values = {1, 2}},
        {.name = "history", .unit = "1", .meaning = "rescalings", .dimensions = {"history"}, .values = {10, 20, 30}},
        {"dimension", "1", "one number", {"member"}, "", [](EndedMember const& row, ResultColumn::Numbers& out) { out.push_back(value(row.member(), 9)); }},
        {"rates", "s-1", "a matrix", {"member", "history", "exponent"}, "", [](EndedMember const& row, ResultColumn::Numbers& out) {
             for (std::size_t i = 0; i < 6; ++i) out.push_back(value(row.member(), 10, i));
         }}};
    return layout;
}

/// The results of some members, which depend on their numbers only.
struct FakeBlock {
    std::vector<std::uint64_t> members;
    std::vector<Inputs> inputs;
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities, samples_of_all, sections;

    explicit FakeBlock(std::vector<std::uint64_t> of) : members(std::move(of)) {
        std::sort(members.begin(), members.end());
        for (std::uint64_t const m : members) add(m);
        for (std::size_t s = 0; s < series; ++s) {
            for (std::uint64_t const m : members) {
                for (std::size_t t = 0; t < samples; ++t)
                    samples_of_all.push_back(value(m, 5 + static_cast<int>(s), t));
            }
        }
    }
    BlockResult view() const { return {members, inputs, records, states, quantities, samples_of_all, sections, {}}; }

private:
    void add(std::uint64_t m) {
        Inputs& in = inputs.emplace_back();
        in.y = value(m, 1);
        in.clearance_y = value(m, 2);
        MemberRecord& record = records.emplace_back();
        record.status = m % 7 == 0 ? Status::max_steps : Status::finished;
        record.steps_accepted = 10 * m;
        record.steps_rejected = m;
        record.rhs_evaluations = 3 * m;
        record.jacobian_evaluations = 5 * m;
        record.stiff_steps = 7 * m;
        record.time = value(m, 0);
        record.crossings = 2 * m;
        for (int k = 0; k < state_size; ++k) states.push_back(value(m, 3, static_cast<std::size_t>(k)));
        for (int k = 0; k < quantity_columns; ++k) quantities.push_back(value(m, 4, static_cast<std::size_t>(k)));
        for (std::size_t row = 0; row < most_sections; ++row) {
            for (std::size_t j = 0; j < row_size; ++j) {
                sections.push_back(row < sections_of(m) ? value(m, 8, row * row_size + j) : nan);
            }
        }
    }
};

using Partition = std::vector<std::vector<std::uint64_t>>;

class Merge : public testing::OutputFolder {
protected:
    std::string merged(Partition const& partition, std::string const& name = "out.nc") const {
        std::vector<FakeBlock> blocks;
        for (auto const& members : partition) blocks.emplace_back(members);
        std::vector<BlockResult> views;
        for (FakeBlock const& block : blocks) views.push_back(block.view());
        write_result(path(name), layout(), {}, views, "so and so");
        ResultReader const result(path(name));
        EXPECT_EQ(result.stored_hash(), result.computed_hash());
        return result.stored_hash();
    }
    std::vector<std::uint64_t> all() const { return run_members().members(0, 100); }
};

TEST_F(Merge, OfOneShardHoldsEveryMemberAtItsPlace) {
    merged({all()});
    ResultReader const result(path());
    std::vector<std::uint64_t> const members = all();
    EXPECT_EQ(members.size(), 14u);
    EXPECT_EQ(result.values("member"), std::vector<double>(members.begin(), members.end()));
    EXPECT_EQ(result.attribute("completeness"), "so and so");
    std::vector<double> section_times;
    for (std::size_t i = 0; i < members.size(); ++i) {
        std::uint64_t const m = members[i];
        EXPECT_EQ(result.values("status")[i], m % 7 == 0 ? 2 : 0);
        EXPECT_EQ(result.values("steps_accepted")[i], 10.0 * static_cast<double>(m));
        EXPECT_EQ(result.values("stiff_steps")[i], 7.0 * static_cast<double>(m));
        EXPECT_EQ(result.values("end_time")[i], value(m, 0));
        EXPECT_EQ(result.values("joint_clearance")[i], value(m, 2));
        EXPECT_EQ(result.values("final_vy")[i], value(m, 3, 2));
        EXPECT_EQ(result.values("mode_time")[4 * i + 3],
                  value(m, 4, static_cast<std::size_t>(quantity_column(Quantity::mode_time)) + 3));
        EXPECT_EQ(result.values("vy")[2 * i + 1], value(m, 6, 1));
        EXPECT_EQ(result.values("dimension")[i], value(m, 9));
        EXPECT_EQ(result.values("rates")[6 * i + 5], value(m, 10, 5));
        EXPECT_EQ(result.values("section_count")[i], static_cast<double>(sections_of(m)));
        EXPECT_EQ(result.values("section_crossings")[i], 2.0 * static_cast<double>(m));
        for (std::size_t row = 0; row < sections_of(m); ++row) section_times.push_back(value(m, 8, row * row_size));
    }
    EXPECT_EQ(result.values("section_time"), section_times);
}

TEST_F(Merge, IsTheSameForAnyPartition) {
    std::string const whole = merged({all()});
    Partition singles, halves(2), interleaved(3);
    for (std::uint64_t const m : all()) {
        singles.push_back({m});
        halves[m < 12 ? 1 : 0].push_back(m);
        interleaved[m % 3].push_back(m);
    }
    for (Partition const& partition : {singles, halves, interleaved}) EXPECT_EQ(merged(partition), whole);
    std::reverse(singles.begin(), singles.end());
    EXPECT_EQ(merged(singles), whole);
    std::mt19937_64 random(3);
    for (int i = 0; i < 20; ++i) {
        Partition any(1 + random() % 5);
        for (std::uint64_t const m : all()) any[random() % any.size()].push_back(m);
        std::erase_if(any, [](auto const& members) { return members.empty(); });
        EXPECT_EQ(merged(any), whole) << i;
    }
}

TEST_F(Merge, TakesOfABlockThoseThatEnded) {
    std::string const whole = merged({all()});
    // Two blocks of all members: what the first one was cut short in is in the second.
    FakeBlock first(all()), second(all());
    for (std::size_t i = 0; i < first.members.size(); ++i) {
        (i % 3 == 1 ? first : second).records[i].status = Status::not_run;
    }
    write_result(path(), layout(), {}, {first.view(), second.view()});
    EXPECT_EQ(ResultReader(path()).computed_hash(), whole);
}

TEST_F(Merge, LeavesAPlaceForMembersThatHaveNotRun) {
    merged({{4, 5}, {24}, {8, 12}});
    ResultReader const result(path());
    std::vector<std::uint64_t> const members = all();
    std::vector<double> times;
    for (std::size_t i = 0; i < members.size(); ++i) {
        std::uint64_t const m = members[i];
        bool const ran = m == 4 || m == 5 || m == 8 || m == 12 || m == 24;
        EXPECT_EQ(result.values("member")[i], static_cast<double>(m));
        EXPECT_EQ(result.values("status")[i] == -1, !ran) << m;
        for (char const* const name :
             {"final_y", "drive_work", "initial_y", "steps_accepted", "end_time", "dimension"}) {
            EXPECT_EQ(std::isnan(result.values(name)[i]), !ran) << name << m;
        }
        for (std::size_t k = 0; k < samples; ++k) EXPECT_EQ(std::isnan(result.values("y")[samples * i + k]), !ran);
        for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(std::isnan(result.values("rates")[6 * i + k]), !ran);
        for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(std::isnan(result.values("peak_apex_force")[8 * i + k]), !ran);
        EXPECT_EQ(result.values("section_count")[i], ran ? static_cast<double>(sections_of(m)) : 0);
        EXPECT_EQ(result.values("section_crossings")[i], ran ? 2.0 * static_cast<double>(m) : 0);
        for (std::size_t row = 0; ran && row < sections_of(m); ++row) times.push_back(value(m, 8, row * row_size));
    }
    EXPECT_EQ(result.values("section_time"), times);
    EXPECT_EQ(result.values("exponent"), (std::vector<double>{1, 2}));
}

TEST_F(Merge, OfNothingIsAFileOfMembersThatHaveNotRun) {
    merged({});
    EXPECT_EQ(ResultReader(path()).values("status"), std::vector<double>(14, -1));
    EXPECT_EQ(ResultReader(path()).shape("section_time"), std::vector<std::size_t>{0});
}

TEST_F(Merge, RefusesADamagedShardByItsName) {
    std::ofstream(path()) << "a former file";
    std::string const shards = shards_of({"p", "fused", run_members(), ""});
    FakeBlock const one({3, 4}), other({20, 21});
    put_blocks(shards, layout(), {}, {one.view(), other.view()});
    ShardFolder const folder(shards);
    auto const listed = folder.listed();
    ASSERT_EQ(listed.size(), 2u);
    std::string const victim = shards + "/members-0000000020.nc";
    testing::flip_bit(victim, fs::file_size(victim) / 2);
    try {
        merge_shards(folder, listed, {layout(), {}, "", {}, {}}, path());
        FAIL() << "was merged";
    } catch (FileError const& error) {
        EXPECT_EQ(std::string(error.what()), victim + ": is not what was written (its checksum differs)");
    }
    EXPECT_EQ(testing::bytes_of(path()), "a former file");
    EXPECT_FALSE(exists("out.nc.part"));
}

TEST_F(Merge, ThatIsInterruptedLeavesNoFileAndAllShards) {
    std::string const shards = shards_of({"p", "fused", run_members(), ""});
    FakeBlock const one({3, 4}), other({20, 21});
    put_blocks(shards, layout(), {}, {one.view(), other.view()});
    ShardFolder const folder(shards);
    struct Interrupted {};
    int asked = 0, at = 0;
    auto const pause = [&] {
        if (asked++ == at) throw Interrupted();
    };
    // Whenever it comes, until the file is whole.
    for (;; ++at) {
        asked = 0;
        try {
            merge_shards(folder, folder.listed(), {layout(), {}, "", {}, pause}, path());
            break;
        } catch (Interrupted const&) {
            EXPECT_FALSE(exists("out.nc"));
            EXPECT_FALSE(exists("out.nc.part"));
            EXPECT_EQ(members_of(folder.listed()).count(), 4u);
        }
    }
    EXPECT_GE(at, 2);
    EXPECT_TRUE(exists("out.nc"));
}

// ---- a shard alone ----

TEST_F(Merge, OfShardsTakesFilesThatAreResultsThemselves) {
    std::string const shards = shards_of({"p", "fused", run_members(), ""});
    FakeBlock const block({21, 4, 24});
    Provenance provenance;
    provenance.title = "a title";
    put_blocks(shards, layout(), provenance, {block.view()});
    auto const listed = ShardFolder(shards).listed();
    ASSERT_EQ(listed.size(), 1u);
    ResultReader const shard(shards + "/" + listed[0].name);
    EXPECT_EQ(shard.values("member"), (std::vector<double>{4, 21, 24}));
    EXPECT_EQ(shard.values("status"), (std::vector<double>{0, 2, 0}));
    EXPECT_EQ(shard.values("final_y"), (std::vector<double>{value(4, 3), value(21, 3), value(24, 3)}));
    EXPECT_EQ(shard.values("y")[2], value(21, 5));
    EXPECT_EQ(shard.values("section_count"),
              (std::vector<double>{static_cast<double>(sections_of(4)), static_cast<double>(sections_of(21)),
                                   static_cast<double>(sections_of(24))}));
    EXPECT_EQ(shard.attribute("title"), "a title");
    EXPECT_EQ(shard.attribute("completeness"), "shard");
    EXPECT_EQ(shard.stored_hash(), shard.computed_hash());
}

TEST_F(Merge, OfABlockThatWasCutShortAltogetherHasNoShard) {
    FakeBlock block({3, 4});
    for (MemberRecord& record : block.records) record.status = Status::not_run;
    ShardImage const image = shard_image("a shard", layout(), {}, block.view());
    EXPECT_TRUE(image.members.empty());
    EXPECT_TRUE(image.bytes.empty());
}

}  // namespace
}  // namespace slideway::merged_results_test
