// Result files whose variables do not belong together, as an editor of NetCDF files leaves them: refused, whatever is asked of them.
#include <array>
#include <cmath>
#include <optional>

#include "host/base/error.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/series_file.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::testing::edited_results_test {
namespace {

class EditedResult : public OutputFolder {
protected:
    struct Column {
        char const* name;
        std::vector<char const*> dimensions;
        std::vector<double> values;
    };
    /// Two members, three samples, four sections.
    void write(std::vector<Column> const& columns) const {
        NetcdfFile file = NetcdfFile::create(path());
        std::vector<int> variables;
        file.put(DataFile::global, "payload_hash", "0123456789abcdef");
        for (auto const& [name, length] : lengths) file.add_dimension(name, length);
        for (Column const& column : columns) {
            std::vector<int> dimensions;
            for (char const* const name : column.dimensions) dimensions.push_back(file.dimension(name));
            variables.push_back(file.add_variable(column.name, DataFile::Type::float64, dimensions));
        }
        for (std::size_t i = 0; i < columns.size(); ++i) {
            std::vector<std::size_t> count;
            for (char const* const name : columns[i].dimensions) count.push_back(length_of(name));
            std::vector<std::size_t> const start(count.size(), 0);
            file.write(variables[i], start, count, columns[i].values.data());
        }
        file.close();
    }
    /// The line that refuses member 1's series; empty if there is one.
    std::string refusal(std::string const& variable) const {
        try {
            read_result_series(path(), variable, 1);
        } catch (std::runtime_error const& error) {
            return error.what();
        }
        return {};
    }

private:
    static constexpr std::array<std::pair<char const*, std::size_t>, 5> lengths = {
        {{"member", 2}, {"sample", 3}, {"section", 4}, {"other", 1}, {"nobody", 0}}};
    static std::size_t length_of(std::string_view wanted) {
        for (auto const& [name, length] : lengths) {
            if (name == wanted) return length;
        }
        return 0;
    }
};

TEST_F(EditedResult, SeriesHaveARowForEachMember) {
    write({{"status", {"member"}, {0, 0}},
           {"member", {"member"}, {0, 1}},
           {"time", {"sample"}, {0, 1, 2}},
           {"y", {"member", "sample"}, {1, 2, 3, 4, 5, 6}},
           {"z", {"other", "sample"}, {7, 8, 9}}});
    EXPECT_EQ(refusal("y"), "");
    EXPECT_EQ(read_result_series(path(), "y", 1).values, (std::vector<double>{4, 5, 6}));
    EXPECT_NE(refusal("z").find("has no series 'z'; use one of y"), std::string::npos) << refusal("z");
}

TEST_F(EditedResult, SectionsAddUp) {
    for (std::vector<double> const& counts : {std::vector<double>{2, 3}, {5, 2}, {-2, 6}, {1, 2}, {std::nan(""), 4}}) {
        std::filesystem::remove(path());
        write({{"status", {"member"}, {0, 0}},
               {"member", {"member"}, {0, 1}},
               {"section_count", {"member"}, counts},
               {"section_time", {"section"}, {0, 1, 0, 1}},
               {"section_y", {"section"}, {1, 2, 3, 4}}});
        EXPECT_NE(refusal("y").find("do not add up"), std::string::npos) << counts[0] << " " << counts[1] << ": " << refusal("y");
    }
    std::filesystem::remove(path());
    write({{"status", {"member"}, {0, 0}},
           {"member", {"member"}, {0, 1}},
           {"section_count", {"member"}, {1, 3}},
           {"section_time", {"section"}, {0, 0, 1, 2}},
           {"section_y", {"section"}, {1, 2, 3, 4}}});
    EXPECT_EQ(read_result_series(path(), "y", 1).values, (std::vector<double>{2, 3, 4}));
}

TEST_F(EditedResult, FailedMembersHaveTheirNumbers) {
    write({{"status", {"member"}, {1, 1}}, {"member", {"other"}, {0}}, {"end_time", {"member"}, {0.5, 0.5}}});
    ResultReader const results(path());
    try {
        failed_members(results, 5);
        ADD_FAILURE() << "no refusal";
    } catch (FileError const& error) {
        EXPECT_EQ(std::string(error.what()), path() + ": is damaged (member has 1 values in place of 2); run the study again");
    }
}

TEST_F(EditedResult, StatusesAreNumbersOfAnyKind) {
    write({{"status", {"member"}, {std::nan(""), 1e300}}});
    ResultReader const results(path());
    auto const counts = count_statuses(results);
    ASSERT_EQ(counts.size(), 1u);
    EXPECT_EQ(counts[0].members, 2u);
    EXPECT_EQ(name_of(counts[0].status), "status_127");
}

TEST(StoredNumbers, OutOfRangeAreNone) {
    EXPECT_EQ(count_of(7), 7u);
    EXPECT_EQ(count_of(-1), 0u);
    EXPECT_EQ(count_of(0x1p64), 0u);
    EXPECT_EQ(count_of(std::nan("")), 0u);
    EXPECT_EQ(status_of(2), Status::max_steps);
    EXPECT_EQ(status_of(-1), Status::not_run);
}

TEST_F(EditedResult, ExponentsAndSectionsAreOfTheMembers) {
    write({{"status", {"member"}, {0, 0}}, {"section_count", {"other"}, {3}}, {"lyapunov_exponent", {"other", "other"}, {1}}});
    ResultReader const results(path());
    EXPECT_THROW(summarise_sections(results), FileError);
    EXPECT_THROW(summarise_exponents(results), FileError);
}

TEST_F(EditedResult, SeriesAreOfMembers) {
    write({{"status", {"member"}, {0, 0}}, {"member", {"nobody"}, {}}, {"time", {"sample"}, {0, 1, 2}}, {"y", {"nobody", "sample"}, {}}});
    try {
        read_result_series(path(), "y", std::nullopt);
        ADD_FAILURE() << "no refusal";
    } catch (SceneError const& error) {
        EXPECT_EQ(std::string(error.what()), path() + ": has no members");
    }
}

TEST_F(EditedResult, NumbersOfMembersAndStepsAreNumbersOfAnyKind) {
    write({{"status", {"member"}, {0, 0}},
           {"member", {"member"}, {std::nan(""), -1}},
           {"end_time", {"member"}, {0.5, 0.5}},
           {"steps_accepted", {"member"}, {1e300, 7}},
           {"steps_rejected", {"member"}, {-3, std::nan("")}}});
    auto const rows = member_rows(ResultReader(path()), {0, 5});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].number, 0u);
    EXPECT_EQ(rows[1].number, 0u);
    EXPECT_EQ(rows[0].steps_accepted, 0u);
    EXPECT_EQ(rows[1].steps_accepted, 7u);
    EXPECT_EQ(rows[0].steps_rejected + rows[1].steps_rejected, 0u);
}

TEST_F(EditedResult, ExponentsHaveTheirDimensions) {
    write({{"status", {"member"}, {0, 0}},
           {"history", {"sample"}, {1, 2, 3}},
           {"lyapunov_history", {"sample"}, {1, 2, 3}},
           {"lyapunov_exponent", {"member", "nobody"}, {}}});
    ResultReader const results(path());
    EXPECT_THROW(exponent_history(results), FileError);
    EXPECT_THROW(summarise_exponents(results), FileError);
    EXPECT_THROW(offset_health(results), FileError);
}

}  // namespace
}  // namespace slideway::testing::edited_results_test
