#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/store/output_target.hpp"
#include "host/store/result_seal.hpp"
#include "host/store/result_view.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::result_file_test {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ResultLayout layout_of(std::uint64_t members) {
    ResultLayout layout;
    layout.members = MemberSet({100, members});
    layout.sample_times = {0.0, 0.5};
    layout.quantities =
        Selection{1} << static_cast<int>(Quantity::drive_work) | Selection{1} << static_cast<int>(Quantity::mode_time);
    layout.series = 0b101;  // y and vy
    layout.parameters = {parameter_column("initial.y", "m", "vertical position at the start", &Inputs::y)};
    return layout;
}

/// The results of the members at places [first, first + count), each value made of the place and the variable.
struct FakeBlock {
    std::vector<std::uint64_t> members;
    std::vector<Inputs> inputs;
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities, series;
    std::uint64_t first;

    FakeBlock(std::uint64_t first_member, std::size_t count) : first(first_member) {
        for (std::size_t i = 0; i < count; ++i) {
            auto const place = static_cast<double>(first + i);
            members.push_back(100 + first + i);
            inputs.emplace_back().y = place / 8;
            records.push_back({Status::finished, first + i, 2, 3, 0.5});
            for (int k = 0; k < state_size; ++k) states.push_back(place + k / 16.0);
            for (int k = 0; k < quantity_columns; ++k) quantities.push_back(place * 100 + k);
        }
        for (int s = 0; s < 2; ++s) {
            for (std::size_t i = 0; i < count; ++i) {
                for (int t = 0; t < 2; ++t) series.push_back(static_cast<double>(first + i) + 0.25 * s + 0.5 * t);
            }
        }
    }
    BlockResult view() const { return {members, inputs, records, states, quantities, series, {}, {}}; }
};

Provenance provenance_of(int threads) {
    Provenance provenance;
    provenance.title = "a title";
    provenance.scene = "schema = 1\n";
    provenance.seed = 18446744073709551615u;
    provenance.maker.backend = "cpu";
    provenance.maker.isa = "scalar";
    provenance.maker.threads = threads;
    return provenance;
}

class ResultFile : public testing::OutputFolder {
protected:
    void write_file(std::string const& file, std::vector<FakeBlock> const& blocks, int threads = 1,
                    std::function<void(DataFile&)> conclude = {}) const {
        std::vector<BlockResult> views;
        for (FakeBlock const& block : blocks) views.push_back(block.view());
        write_result(file, layout_of(5), provenance_of(threads), views, "complete", std::move(conclude));
    }
};

TEST_F(ResultFile, GivesBackWhatWasWritten) {
    write_file(path(), {{3, 2}, {0, 3}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("member"), (std::vector<double>{100, 101, 102, 103, 104}));
    EXPECT_EQ(results.values("status"), (std::vector<double>(5, 0)));
    EXPECT_EQ(results.values("steps_accepted"), (std::vector<double>{0, 1, 2, 3, 4}));
    EXPECT_EQ(results.values("steps_rejected"), std::vector<double>(5, 2));
    EXPECT_EQ(results.values("rhs_evaluations"), std::vector<double>(5, 3));
    EXPECT_EQ(results.values("end_time"), std::vector<double>(5, 0.5));
    EXPECT_EQ(results.values("initial_y"), (std::vector<double>{0, 0.125, 0.25, 0.375, 0.5}));
    EXPECT_EQ(results.values("final_y"), (std::vector<double>{0, 1, 2, 3, 4}));
    EXPECT_EQ(results.values("final_wz"), (std::vector<double>{0.5625, 1.5625, 2.5625, 3.5625, 4.5625}));
    EXPECT_EQ(results.values("time"), (std::vector<double>{0, 0.5}));
    EXPECT_EQ(results.values("y"), (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5}));
    EXPECT_EQ(results.values("vy"), (std::vector<double>{0.25, 0.75, 1.25, 1.75, 2.25, 2.75, 3.25, 3.75, 4.25, 4.75}));
    EXPECT_FALSE(results.has("z"));
    EXPECT_FALSE(results.has("peak_apex_force"));
    // 18 columns stand before mode_time, 27 before drive_work in the quantity table.
    EXPECT_EQ(results.values("drive_work"), (std::vector<double>{27, 127, 227, 327, 427}));
    EXPECT_EQ(results.shape("mode_time"), (std::vector<std::size_t>{5, 4}));
    auto const mode_time = results.values("mode_time");
    EXPECT_EQ(std::vector<double>(mode_time.begin() + 4, mode_time.begin() + 8),
              (std::vector<double>{118, 119, 120, 121}));
}

TEST_F(ResultFile, SaysWhereItComesFrom) {
    setenv("SOURCE_DATE_EPOCH", "86400", 1);
    write_file(path(), {{0, 5}}, 3);
    unsetenv("SOURCE_DATE_EPOCH");
    ResultReader const results(path());
    EXPECT_EQ(results.attribute("Conventions"), "CF-1.8");
    EXPECT_EQ(results.attribute("title"), "a title");
    EXPECT_EQ(results.attribute("scene"), "schema = 1\n");
    EXPECT_EQ(results.attribute("seed"), "18446744073709551615");
    EXPECT_EQ(results.attribute("threads"), "3");
    EXPECT_EQ(results.attribute("created"), "1970-01-02T00:00:00Z");
    EXPECT_EQ(results.attribute("completeness"), "complete");
    std::string const threads = " (" + std::to_string(std::thread::hardware_concurrency()) + " threads)";
    EXPECT_TRUE(results.attribute("machine").ends_with(threads)) << results.attribute("machine");
    for (char const* const name : {"version", "commit", "compiler"}) EXPECT_NE(results.attribute(name), "") << name;
}

TEST_F(ResultFile, NamesUnitsAndLabels) {
    write_file(path(), {{0, 5}});
    ResultReader const results(path());
    for (std::string const& name : results.variable_names()) {
        if (name == "status" || name.ends_with("_name")) continue;  // flags and texts have no unit
        EXPECT_NE(results.unit(name), "") << name;
        EXPECT_NE(results.long_name(name), "") << name;
    }
    NetcdfFile const file = NetcdfFile::open(path());
    for (auto const& variable : file.variables()) {
        if (variable.name == "mode_time") {
            EXPECT_EQ(file.text(variable.id, "coordinates"), "mode_class_name");
        }
        if (variable.name == "y") {
            EXPECT_EQ(file.text(variable.id, "coordinates"), "time");
        }
        if (variable.name == "status") {
            EXPECT_EQ(file.text(variable.id, "flag_meanings"),
                      "not_run finished step_too_small max_steps nonfinite geometry contact_domain invalid_inputs "
                      "unstable out_of_time");
        }
        if (variable.name == "mode_class_name") {
            std::vector<char> text(variable.size());
            std::size_t const start[2] = {0, 0};
            file.read(variable.id, start, variable.shape, text.data());
            EXPECT_STREQ(text.data() + variable.shape[1], "point");
        }
    }
}

TEST_F(ResultFile, MarksMembersThatWereNeverWritten) {
    write_file(path(), {{1, 2}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("status"), (std::vector<double>{-1, 0, 0, -1, -1}));
    auto const work = results.values("drive_work"), steps = results.values("steps_accepted"), y = results.values("y");
    for (std::size_t const i : {0u, 3u, 4u}) {
        EXPECT_TRUE(std::isnan(work[i]));
        EXPECT_TRUE(std::isnan(steps[i]));
        EXPECT_TRUE(std::isnan(y[2 * i]) && std::isnan(y[2 * i + 1]));
    }
    EXPECT_EQ(work[1], 127);
}

TEST_F(ResultFile, IsTheSameWhateverTheOrderOfBlocks) {
    setenv("SOURCE_DATE_EPOCH", "0", 1);
    write_file(path("a.nc"), {{0, 5}});
    write_file(path("b.nc"), {{4, 1}, {2, 2}, {0, 2}});
    unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_EQ(ResultReader(path("a.nc")).stored_hash(), ResultReader(path("b.nc")).stored_hash());
    EXPECT_TRUE(testing::bytes_of(path("a.nc")) == testing::bytes_of(path("b.nc")));
}

TEST_F(ResultFile, StandsAtItsPathOnlyWhenComplete) {
    std::ofstream(path()) << "a former file";
    auto const giving_up = [&](DataFile&) {
        EXPECT_EQ(fs::file_size(path()), 13u);
        EXPECT_TRUE(fs::exists(path() + ".part"));
        throw FileError("given up");
    };
    EXPECT_THROW(write_file(path(), {{0, 5}}, 1, giving_up), FileError);
    EXPECT_EQ(fs::file_size(path()), 13u);  // the former file stays
    EXPECT_FALSE(fs::exists(path() + ".part"));
    write_file(path(), {{0, 5}});
    EXPECT_FALSE(fs::exists(path() + ".part"));
    EXPECT_EQ(ResultReader(path()).values("status").size(), 5u);
}

TEST_F(ResultFile, HoldsWhatIsConcludedFromItsMembers) {
    auto const concluding = [](DataFile& file) { file.put(DataFile::global, "mean_of_all", 2.5); };
    write_file(path(), {{0, 5}}, 1, concluding);
    EXPECT_EQ(ResultReader(path()).attribute("mean_of_all"), "2.5");
}

TEST_F(ResultFile, StaysAsPartIfOnlyItsNameIsTaken) {
    auto const taking_the_name = [&](DataFile&) { fs::create_directories(path() + "/in_the_way"); };
    EXPECT_THROW(write_file(path(), {{0, 5}}, 1, taking_the_name), FileError);
    EXPECT_EQ(ResultReader(path() + ".part").values("status").size(), 5u);
}

TEST_F(ResultFile, TakesAwayThePartOfAKilledMerge) {
    std::ofstream(path() + ".part") << "half of a file";
    std::ofstream(path() + ".part.lock") << "";
    write_file(path(), {{0, 5}});
    EXPECT_FALSE(fs::exists(path() + ".part"));
    EXPECT_EQ(ResultReader(path()).values("status").size(), 5u);
}

TEST_F(ResultFile, LeavesThePartOfSomebodyElse) {
    std::ofstream(path() + ".part") << "half of a file";
    EXPECT_THROW(write_file(path(), {{0, 5}}), FileError);
    EXPECT_EQ(fs::file_size(path() + ".part"), 14u);
    EXPECT_FALSE(fs::exists(path() + ".part.lock"));
}

TEST_F(ResultFile, NeedsAPlaceToBeWritten) {
    OutputRules const rules{{}, true, is_result_file};
    EXPECT_THROW(OutputTarget(path("no_folder/out.nc"), rules), FileError);
    EXPECT_THROW(OutputTarget(folder(), rules), FileError);
    EXPECT_THROW(OutputTarget("/dev/null", rules), FileError);
    EXPECT_THROW(OutputTarget("", rules), FileError);
    EXPECT_FALSE(OutputTarget(path(), rules).replaces());
    write_file(path(), {{0, 5}});
    EXPECT_TRUE(OutputTarget(path(), rules).replaces());
    EXPECT_THROW(write_file(path("no_folder/out.nc"), {{0, 5}}), FileError);
}

TEST_F(ResultFile, CannotNumberMembersBeyondItsIntegers) {
    // CF-1.8 has no integers wider than 32 bits.
    constexpr std::uint64_t largest = 2147483647;
    FakeBlock block(0, 2);
    block.members = {largest - 2, largest - 1};
    ShardImage const image = shard_image("a shard", layout_of(5), {}, block.view());
    EXPECT_EQ(image.members, MemberSet({largest - 2, 2}));
    block.members = {largest - 1, largest};
    EXPECT_THROW(shard_image("a shard", layout_of(5), {}, block.view()), FileError);
    EXPECT_THROW(write_result(path(), layout_of(std::uint64_t{1} << 40), {}, {}), FileError);
}

TEST_F(ResultFile, IsToldFromOtherFiles) {
    EXPECT_THROW(ResultReader{path("missing.nc")}, FileError);
    std::ofstream(path("text.nc")) << "no netCDF";
    EXPECT_THROW(ResultReader{path("text.nc")}, FileError);
    {
        NetcdfFile other = NetcdfFile::create(path("other.nc"));
        other.close();
    }
    EXPECT_THROW(ResultReader{path("other.nc")}, FileError);
    {
        NetcdfFile unfinished = NetcdfFile::create(path("unfinished.nc"));
        int const dimension = unfinished.add_dimension("member", 2);
        unfinished.add_variable("status", DataFile::Type::int8, {&dimension, 1});
        unfinished.close();
    }
    EXPECT_THROW(ResultReader{path("unfinished.nc")}, FileError);  // without a hash it did not come to its end
}

TEST_F(ResultFile, HashNoticesOneChangedBit) {
    write_file(path("a.nc"), {{0, 5}});
    FakeBlock changed(0, 5);
    changed.series[7] = std::nextafter(changed.series[7], 10.0);
    write_file(path("b.nc"), {changed});
    ResultReader const a(path("a.nc")), b(path("b.nc"));
    EXPECT_EQ(a.stored_hash(), a.computed_hash());
    EXPECT_EQ(b.stored_hash(), b.computed_hash());
    EXPECT_NE(a.stored_hash(), b.stored_hash());
}

TEST_F(ResultFile, HashTakesEveryNanForTheSame) {
    FakeBlock positive(0, 5), negative(0, 5);
    positive.series[2] = nan;
    negative.series[2] = -nan;
    write_file(path("a.nc"), {positive});
    write_file(path("b.nc"), {negative});
    EXPECT_EQ(ResultReader(path("a.nc")).stored_hash(), ResultReader(path("b.nc")).stored_hash());
}

TEST(PayloadBytes, CountColumns) {
    // Per member: number 4, status 1, then 5 counters and the end, 10 states, 1 parameter, 1 + 4 quantity columns,
    // 2 × 2 samples.
    EXPECT_EQ(payload_bytes(layout_of(10)), 10u * (5 + 8 * (6 + 10 + 1 + 5 + 4)) + 2 * 8);
}

TEST_F(ResultFile, HasTheBytesThatItsLayoutTells) {
    Provenance origin = provenance_of(1);
    origin.scene = std::string(3000, '#');
    for (std::size_t const members : {8u, 20000u}) {
        FakeBlock const block(0, members);
        ShardImage const image = shard_image("a shard", layout_of(members), origin, block.view());
        std::uint64_t const payload = payload_bytes(layout_of(members));
        std::uint64_t const header = header_bytes(layout_of(members), origin);
        EXPECT_LE(image.bytes.size(), payload + header);
        EXPECT_GT(image.bytes.size(), payload + header / 2);
        // Nothing is missing at its end, and there is nothing behind it.
        NetcdfFile const file = NetcdfFile::open_in_memory("a shard", image.bytes);
        ResultView const results(file);
        EXPECT_EQ(results.values("vy").back(), block.series.back());
        EXPECT_LT(header, 60'000u);
    }
}

}  // namespace
}  // namespace slideway::result_file_test
