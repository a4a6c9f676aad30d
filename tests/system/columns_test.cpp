// One more column in the list of a result is in everything that goes by the list.
#include <cmath>

#include <nlohmann/json.hpp>

#include "host/config/scene.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/result_view.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/result_summary.hpp"
#include "tests/support/output_fixture.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::columns_test {
namespace {

constexpr std::size_t members = 6;

/// Two members that finished, and one that failed.
struct MadeUpBlock {
    std::vector<std::uint64_t> numbers;
    std::vector<Inputs> inputs = std::vector<Inputs>(3);
    std::vector<MemberRecord> records = std::vector<MemberRecord>(3);
    std::vector<double> states = std::vector<double>(3 * state_size, 1.0), quantities = std::vector<double>(3 * quantity_columns, 2.0);

    explicit MadeUpBlock(std::uint64_t first) : numbers{first, first + 1, first + 2} {
        for (MemberRecord& record : records) record.status = Status::finished;
        records[2].status = Status::max_steps;
    }
    BlockResult view() const { return {numbers, inputs, records, states, quantities, {}, {}, {}}; }
};

ResultLayout layout(bool with_one_more) {
    ResultLayout layout;
    layout.members = MemberSet({0, members + 1});  // the last never comes
    if (!with_one_more) return layout;
    layout.study = {{"distance", "m", "way of the slider", {"member"}, "", [](EndedMember const& member, ResultColumn::Numbers& out) {
                         out.push_back(10.0 + static_cast<double>(member.member()));
                     }}};
    layout.study.back().summarised = true;
    return layout;
}

std::string merged(std::string const& path, ResultLayout const& layout, bool in_one_block_after_another) {
    MadeUpBlock const one(0), other(3);
    std::vector<MergedShard> shards{memory_shard("one", layout, one.view()), memory_shard("other", layout, other.view())};
    if (!in_one_block_after_another) std::swap(shards[0], shards[1]);
    merge_shards(shards, {layout, {}, "complete", {}, {}}, path);
    return ResultReader(path).computed_hash();
}

class OneMoreColumn : public Program {};

TEST_F(OneMoreColumn, IsInTheFileTheHashTheSummaryAndTheJson) {
    std::string const with = path("with.nc").string(), again = path("again.nc").string(), without = path("without.nc").string();
    std::string const hash = merged(with, layout(true), true);
    EXPECT_EQ(merged(again, layout(true), false), hash);
    EXPECT_NE(merged(without, layout(false), true), hash);
    EXPECT_TRUE(check_result(with).intact());

    ResultReader const results(with);
    std::vector<double> const values = results.values("distance");
    ASSERT_EQ(values.size(), members + 1);
    for (std::size_t i = 0; i < members; ++i) EXPECT_EQ(values[i], 10.0 + static_cast<double>(i));
    EXPECT_TRUE(std::isnan(values.back()));
    EXPECT_EQ(results.unit("distance"), "m");
    EXPECT_EQ(results.long_name("distance"), "way of the slider");

    auto const summaries = summarise_quantities(results);
    ASSERT_EQ(summaries.size(), 1u);
    EXPECT_EQ(summaries[0].label, "distance");
    EXPECT_EQ(summaries[0].values.count, 4u);  // of those that finished
    EXPECT_EQ(summaries[0].values.mean, (10 + 11 + 13 + 14) / 4.0);

    Outcome const told = run({"info", with, "--json"});
    ASSERT_EQ(told.code, 0) << told.err;
    auto const json = nlohmann::json::parse(told.out);
    ASSERT_EQ(json["quantities"].size(), 1u);
    EXPECT_EQ(json["quantities"][0]["name"], "distance");
    EXPECT_EQ(json["quantities"][0]["unit"], "m");
    EXPECT_EQ(json["payload_hash"], hash);
}

TEST_F(OneMoreColumn, CountsInTheSizeThatIsForetold) {
    EXPECT_EQ(payload_bytes(layout(true)), payload_bytes(layout(false)) + (members + 1) * sizeof(double));
    EXPECT_GT(header_bytes(layout(true), {}), header_bytes(layout(false), {}));
}

}  // namespace
}  // namespace slideway::testing::columns_test
