// Tables as other programs read them, byte by byte.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/store/table_file.hpp"

namespace slideway::table_file_test {
namespace {

class TableFile : public ::testing::Test {
protected:
    TableFile() { std::filesystem::create_directories(folder_); }
    ~TableFile() override { std::filesystem::remove_all(folder_); }
    OutputTarget target(std::string const& name) const { return {(folder_ / name).string(), {{}, false, [](std::string const&) { return true; }}}; }
    std::string text(std::string const& name) const { return read_text((folder_ / name).string()); }

private:
    std::filesystem::path const folder_ = std::filesystem::temp_directory_path() / ("slideway_table_" + std::to_string(getpid()));
};

/// Columns of numbers that are counted on: 0, 1, 2 …
TableColumns counting(std::vector<std::string> names, TableColumns::Along along, std::size_t of_each) {
    return {.names = std::move(names), .along = along, .numbers = [of_each](std::size_t first, std::size_t count) {
                std::vector<double> numbers;
                for (std::size_t i = first * of_each; i < (first + count) * of_each; ++i) numbers.push_back(static_cast<double>(i));
                return numbers;
            }};
}

TEST_F(TableFile, OfCsvHasTheShortestNumbersAndQuotesWhatSeparates) {
    constexpr double inf = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
    ExportTable table{.name = "members", .members = 3};
    table.columns.push_back({.names = {"member"}, .words = {"a, b", "say \"c\"", ""}});
    table.columns.push_back({.names = {"p[1]", "p[2]"}, .unit = "m s-1", .numbers = [](std::size_t, std::size_t) {
                                 return std::vector<double>{0.1, 1.0 / 3, none, -inf, -0.0, 5e-324};
                             }});
    write_csv(target("o.csv"), table);
    EXPECT_EQ(text("o.csv"), "member,p[1] [m s-1],p[2] [m s-1]\n\"a, b\",0.1,0.3333333333333333\n\"say \"\"c\"\"\",,-inf\n,-0,5e-324\n");
}

TEST_F(TableFile, OfCsvIsWholeAcrossBlocks) {
    using Along = TableColumns::Along;
    // More numbers than are read at once.
    constexpr int samples = 300'000;
    ExportTable table{.name = "series", .members = 5, .samples = samples};
    table.columns = {counting({"member"}, Along::members, 1), counting({"time"}, Along::samples, 1), counting({"y"}, Along::both, samples)};
    write_csv(target("o.csv"), table);
    std::istringstream lines(text("o.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "member,time,y");
    int row = 0;
    for (double member, time, y; std::getline(lines, line); ++row) {
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &member, &time, &y), 3) << line;
        ASSERT_TRUE(member == row / samples && time == row % samples && y == row) << line;
    }
    EXPECT_EQ(row, 5 * samples);
}

std::uint32_t word_at(std::string const& bytes, std::size_t at) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + at, 4);
    return word;
}

/// As "MAT-File Format" of MathWorks has them: tag, flags, sizes, name, length of field names, names, and fields, each an element of that kind.
TEST_F(TableFile, OfMatHasTheElementsOfLevelFive) {
    ExportTable table{.name = "series", .members = 2, .samples = 3};
    table.columns = {counting({"way.roll"}, TableColumns::Along::both, 3)};
    table.columns[0].unit = "rad";
    write_mat(target("o.mat"), {table});
    std::string const bytes = text("o.mat");
    EXPECT_TRUE(bytes.starts_with("MATLAB 5.0 MAT-file"));
    EXPECT_EQ(bytes.substr(124, 4), std::string("\0\1IM", 4));
    std::vector<std::uint32_t> const head{14, 232,        // a matrix, its bytes
                                          6, 8, 2, 0,     // flags: a struct
                                          5, 8, 1, 1,     // 1 × 1
                                          1, 6};          // its name
    for (std::size_t i = 0; i < head.size(); ++i) EXPECT_EQ(word_at(bytes, 128 + 4 * i), head[i]) << i;
    EXPECT_EQ(bytes.substr(176, 8), std::string("series\0\0", 8));
    EXPECT_EQ(word_at(bytes, 184), (4u << 16) | 5u);  // a small element
    EXPECT_EQ(word_at(bytes, 188), 64u);
    EXPECT_EQ(word_at(bytes, 192), 1u);
    EXPECT_EQ(word_at(bytes, 196), 64u);
    EXPECT_EQ(bytes.substr(200, 9), std::string("way_roll\0", 9));
    std::vector<std::uint32_t> const field{14, 96, 6, 8, 6, 0, 5, 8, 2, 3, 1, 0, 9, 48};
    for (std::size_t i = 0; i < field.size(); ++i) EXPECT_EQ(word_at(bytes, 264 + 4 * i), field[i]) << i;
    double numbers[6];
    std::memcpy(numbers, bytes.data() + 320, sizeof numbers);
    EXPECT_EQ(std::vector<double>(numbers, numbers + 6), (std::vector<double>{0, 3, 1, 4, 2, 5})) << "column by column";
    EXPECT_EQ(word_at(bytes, 368), 14u) << "units";
    EXPECT_EQ(376 + word_at(bytes, 372), bytes.size());
}

TEST_F(TableFile, OfMatIsRefusedBeyondItsLimit) {
    ExportTable table{.name = "members", .members = 1 << 28};
    table.columns = {counting({"y"}, TableColumns::Along::members, 1)};
    try {
        write_mat(target("o.mat"), {table});
        FAIL();
    } catch (FileError const& error) {
        std::string const words = error.what();
        EXPECT_NE(words.find("o.mat: members would have 2.1 GB, and a MAT file holds less than"), words.npos) << words;
    }
}

}  // namespace
}  // namespace slideway::table_file_test
