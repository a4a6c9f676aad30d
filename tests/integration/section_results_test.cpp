// Sections as ragged arrays and a study's columns: what is written, in whatever order, is read back.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "host/store/result_view.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::section_results_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t members = 8, room = 3;
constexpr std::size_t row_size = section_columns(state_size);

/// Members 3 and 5 failed, the one after a section, the other before any.
constexpr std::size_t rows_of_members[members] = {3, 0, 2, 1, 3, 0, 0, 2};
constexpr Status status_of(std::size_t member) {
    return member == 3 ? Status::max_steps : member == 5 ? Status::invalid_inputs : Status::finished;
}

/// A number that no other place of the file has.
double entry(std::size_t member, std::size_t row, std::size_t column) {
    return static_cast<double>(1000 * member + 100 * row + column);
}

double scalar_entry(std::size_t member) { return 0.5 + static_cast<double>(member); }
double row_entry(std::size_t member, std::size_t j) { return static_cast<double>(10 * member + j) + 0.25; }
double matrix_entry(std::size_t member, std::size_t n, std::size_t j) {
    return static_cast<double>(100 * member + 10 * n + j) + 0.125;
}

ResultLayout layout() {
    ResultLayout layout;
    layout.members = MemberSet({0, members});
    layout.sections = room;
    layout.study = {
        {.name = "exponent", .unit = "1", .meaning = "number of the exponent", .dimensions = {"exponent"}, .values = {1, 2}},
        {.name = "history", .unit = "1", .meaning = "rescalings", .dimensions = {"history"}, .values = {10, 20, 30}},
        {"dimension", "1", "one number", {"member"}, "", [](EndedMember const& row, ResultColumn::Numbers& out) { out.push_back(scalar_entry(row.member())); }},
        {"rate", "s-1", "a row", {"member", "exponent"}, "", [](EndedMember const& row, ResultColumn::Numbers& out) {
             for (std::size_t j = 0; j < 2; ++j) out.push_back(row_entry(row.member(), j));
         }},
        {"rates", "s-1", "a matrix", {"member", "history", "exponent"}, "", [](EndedMember const& row, ResultColumn::Numbers& out) {
             for (std::size_t i = 0; i < 6; ++i) out.push_back(matrix_entry(row.member(), i / 2, i % 2));
         }}};
    return layout;
}

/// Members [first, first + count).
struct FakeBlock {
    std::vector<std::uint64_t> numbers;
    std::vector<Inputs> inputs;
    std::vector<MemberRecord> records;
    std::vector<double> states, quantities, sections;

    FakeBlock(std::size_t first, std::size_t count)
        : inputs(count),
          records(count),
          states(count * state_size, 1.0),
          quantities(count * quantity_columns, nan),
          sections(count * room * row_size, nan) {
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t const member = first + i;
            numbers.push_back(member);
            records[i].status = status_of(member);
            records[i].crossings = rows_of_members[member] == room ? room + member : rows_of_members[member];
            for (std::size_t row = 0; row < rows_of_members[member]; ++row) {
                for (std::size_t j = 0; j < row_size; ++j) {
                    sections[(i * room + row) * row_size + j] = entry(member, row, j);
                }
            }
        }
    }
    BlockResult view() const { return {numbers, inputs, records, states, quantities, {}, sections, {}}; }
};

class SectionsFile : public testing::OutputFolder {
protected:
    void write_with(ResultLayout const& with, std::vector<FakeBlock> const& blocks) const {
        std::vector<BlockResult> views;
        for (FakeBlock const& block : blocks) views.push_back(block.view());
        write_result(path(), with, {}, views);
    }
    void write(std::vector<FakeBlock> const& blocks) const { write_with(layout(), blocks); }
    std::string hash_of(std::vector<FakeBlock> const& blocks) const {
        write(blocks);
        ResultReader const results(path());
        EXPECT_EQ(results.stored_hash(), results.computed_hash());
        return results.stored_hash();
    }
};

char const* const variables[row_size] = {"section_time", "section_y",    "section_z",   "section_vy",
                                         "section_vz",   "section_roll", "section_yaw", "section_pitch",
                                         "section_wx",   "section_wy",   "section_wz"};

TEST_F(SectionsFile, HoldsTheRowsOfEachMemberInTheirOrder) {
    write({{0, members}});
    ResultReader const results(path());
    auto const counts = results.values("section_count");
    EXPECT_EQ(counts, (std::vector<double>{3, 0, 2, 1, 3, 0, 0, 2}));
    for (std::size_t j = 0; j < row_size; ++j) {
        std::vector<double> expected;
        for (std::size_t member = 0; member < members; ++member) {
            for (std::size_t row = 0; row < rows_of_members[member]; ++row) expected.push_back(entry(member, row, j));
        }
        EXPECT_EQ(results.values(variables[j]), expected) << variables[j];
    }
}

TEST_F(SectionsFile, KeepsWhatAFailedMemberCameTo) {
    write({{0, members}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("status")[3], static_cast<double>(Status::max_steps));
    EXPECT_EQ(results.values("section_count")[3], 1);
    EXPECT_EQ(results.values("section_vy")[5], entry(3, 0, 3));  // after the 3 + 0 + 2 rows of members 0 to 2
    EXPECT_EQ(results.values("status")[5], static_cast<double>(Status::invalid_inputs));
    EXPECT_EQ(results.values("section_count")[5], 0);
}

TEST_F(SectionsFile, IsTheSameWhateverTheOrderOfBlocks) {
    std::string const whole = hash_of({{0, members}});
    std::vector<FakeBlock> const blocks{{0, 2}, {2, 1}, {3, 3}, {6, 2}};
    std::vector<std::size_t> order{0, 1, 2, 3};
    do {
        std::vector<FakeBlock> arranged;
        for (std::size_t const i : order) arranged.push_back(blocks[i]);
        EXPECT_EQ(hash_of(arranged), whole);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(SectionsFile, FollowsTheConventionsForContiguousRaggedArrays) {
    write({{0, members}});
    NetcdfFile const file = NetcdfFile::open(path());
    std::size_t length = 0;
    for (auto const& dimension : file.dimensions()) {
        if (dimension.name == "section") length = dimension.length;
    }
    EXPECT_EQ(length, 11u);  // CF-1.8, 9.3.3: the counts sum to the sample dimension
    int counts = 0;
    for (auto const& variable : file.variables()) {
        if (variable.name == "section_count") {
            ++counts;
            EXPECT_EQ(variable.type, DataFile::Type::int32);
            EXPECT_EQ(file.text(variable.id, "sample_dimension"), "section");
        } else {
            EXPECT_EQ(file.text(variable.id, "sample_dimension"), "") << variable.name;
        }
    }
    EXPECT_EQ(counts, 1);
    ResultReader const results(path());
    for (auto const& [name, unit] : {std::pair{"section_time", "s"},
                                     {"section_y", "m"},
                                     {"section_vz", "m s-1"},
                                     {"section_roll", "rad"},
                                     {"section_wz", "rad s-1"},
                                     {"section_count", "1"}}) {
        EXPECT_EQ(results.unit(name), unit) << name;
        EXPECT_NE(results.long_name(name), "") << name;
    }
}

TEST_F(SectionsFile, OfAStoppedRunCountsNothingForMembersThatNeverCame) {
    // Members 0 and 1 never came, nor did the last.
    write({{2, 2}, {4, 1}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("section_count"), (std::vector<double>{0, 0, 2, 1, 3, 0, 0, 0}));
    EXPECT_EQ(results.values("section_time"), (std::vector<double>{entry(2, 0, 0), entry(2, 1, 0), entry(3, 0, 0),
                                                                   entry(4, 0, 0), entry(4, 1, 0), entry(4, 2, 0)}));
    EXPECT_EQ(results.values("status"), (std::vector<double>{-1, -1, 0, 2, 0, -1, -1, -1}));
}

TEST_F(SectionsFile, OfAStoppedRunMayHaveGapsBetweenItsBlocks) {
    write({{7, 1}, {0, 1}, {3, 2}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("section_count"), (std::vector<double>{3, 0, 0, 1, 3, 0, 0, 2}));
    EXPECT_EQ(results.values("section_wz").front(), entry(0, 0, 10));
    EXPECT_EQ(results.values("section_wz")[3], entry(3, 0, 10));
    EXPECT_EQ(results.values("section_wz").back(), entry(7, 1, 10));
}

TEST_F(SectionsFile, OfARunThatNeverBeganIsEmpty) {
    write({});
    ResultReader const results(path());
    EXPECT_EQ(results.values("section_count"), std::vector<double>(members, 0));
    EXPECT_EQ(results.shape("section_time"), std::vector<std::size_t>{0});
    EXPECT_EQ(results.values("section_y"), std::vector<double>{});
    EXPECT_EQ(results.stored_hash(), results.computed_hash());
}

TEST_F(SectionsFile, OfMembersWithoutSectionsIsEmpty) {
    write({{5, 2}, {1, 1}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("section_count"), std::vector<double>(members, 0));
    EXPECT_EQ(results.shape("section_time"), std::vector<std::size_t>{0});
}

TEST_F(SectionsFile, HasNoSectionsIfNoneAreAskedFor) {
    ResultLayout without = layout();
    without.sections = 0;
    write_with(without, {{0, members}});
    EXPECT_FALSE(ResultReader(path()).has("section_count"));
    EXPECT_FALSE(ResultReader(path()).has("section_time"));
}

TEST_F(SectionsFile, OfCrossingsSaysHowManyThereWere) {
    ResultLayout crossings = layout();
    crossings.crossings = true;
    FakeBlock const first(0, 2), last(4, 2);
    write_with(crossings, {last, first});
    ResultReader const results(path());
    EXPECT_EQ(results.values("section_count"), (std::vector<double>{3, 0, 0, 0, 3, 0, 0, 0}));
    EXPECT_EQ(results.values("section_crossings"), (std::vector<double>{3, 0, 0, 0, 7, 0, 0, 0}));
    write({first});
    EXPECT_FALSE(ResultReader(path()).has("section_crossings"));
}

TEST_F(SectionsFile, HashNoticesThatARowBelongsToAnotherMember) {
    FakeBlock one(0, members), other(0, members);
    // The second row of member 2 becomes the first of member 1: the columns stay as they are.
    for (std::size_t j = 0; j < row_size; ++j) {
        other.sections[(1 * room + 0) * row_size + j] = entry(2, 0, j);
        other.sections[(2 * room + 0) * row_size + j] = entry(2, 1, j);
        other.sections[(2 * room + 1) * row_size + j] = nan;
    }
    std::string const before = hash_of({one});
    auto const times = ResultReader(path()).values("section_time");
    EXPECT_NE(hash_of({other}), before);
    EXPECT_EQ(ResultReader(path()).values("section_time"), times);
}

// ---- columns of a study ----

TEST_F(SectionsFile, GivesBackTheStudysColumns) {
    write({{3, 5}, {0, 3}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("exponent"), (std::vector<double>{1, 2}));
    EXPECT_EQ(results.values("history"), (std::vector<double>{10, 20, 30}));
    EXPECT_EQ(results.shape("dimension"), (std::vector<std::size_t>{members}));
    EXPECT_EQ(results.shape("rate"), (std::vector<std::size_t>{members, 2}));
    EXPECT_EQ(results.shape("rates"), (std::vector<std::size_t>{members, 3, 2}));
    auto const dimension = results.values("dimension"), rate = results.values("rate"), rates = results.values("rates");
    for (std::size_t member = 0; member < members; ++member) {
        EXPECT_EQ(dimension[member], scalar_entry(member));
        for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(rate[2 * member + j], row_entry(member, j));
        for (std::size_t n = 0; n < 3; ++n) {
            for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(rates[6 * member + 2 * n + j], matrix_entry(member, n, j));
        }
    }
    EXPECT_EQ(results.unit("rate"), "s-1");
    EXPECT_EQ(results.long_name("rates"), "a matrix");
    EXPECT_EQ(results.long_name("history"), "rescalings");
}

TEST_F(SectionsFile, LeavesColumnsOfMembersThatNeverCameNaN) {
    write({{4, 2}});
    ResultReader const results(path());
    auto const dimension = results.values("dimension"), rates = results.values("rates");
    for (std::size_t member = 0; member < members; ++member) {
        bool const came = member == 4 || member == 5;
        EXPECT_EQ(std::isnan(dimension[member]), !came) << member;
        for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(std::isnan(rates[6 * member + i]), !came) << member;
    }
    EXPECT_EQ(results.values("history"), (std::vector<double>{10, 20, 30}));  // an axis is whole in any case
}

TEST(ResultColumns, WidthIsTheProductOfTheAxes) {
    ResultColumns const list = result_columns(layout());
    auto const width = [&](char const* name) { return list.width(*std::ranges::find(list.columns, name, &ResultColumn::name)); };
    EXPECT_EQ(width("dimension"), 1u);
    EXPECT_EQ(width("rate"), 2u);
    EXPECT_EQ(width("rates"), 6u);
}

TEST(PayloadBytes, CountSectionsAndColumnsOfAStudy) {
    ResultLayout with = layout(), without = layout();
    without.sections = 0;
    // A count, 32 bits of it, and as many rows of time and state as there is room for.
    EXPECT_EQ(payload_bytes(with) - payload_bytes(without), members * (4 + 8 * room * 11));
    with.crossings = true;
    EXPECT_EQ(payload_bytes(with) - payload_bytes(without), members * (4 + 4 + 8 * room * 11));
    without.study = {};
    // The columns' 1 + 2 + 6 numbers of each member and the axes' 2 + 3.
    with.sections = 0;
    EXPECT_EQ(payload_bytes(with) - payload_bytes(without), members * 8 * 9 + 8 * 5);
}

}  // namespace
}  // namespace slideway::section_results_test
