#include "host/study/series_file.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "host/base/error.hpp"

namespace slideway::testing::series_file_test {
namespace {

using Values = std::vector<double>;

StoredSeries read(std::string const& text, std::string const& column = "", std::optional<double> spacing = {}) {
    std::istringstream in(text);
    return read_csv_series(in, "a.csv", column, spacing);
}

void expect_refusal(std::string const& text, std::string const& column, std::string const& part) {
    try {
        read(text, column);
        ADD_FAILURE() << "no refusal: " << part;
    } catch (SceneError const& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(SeriesFile, TakesTheLastColumnThatIsNotTheTime) {
    StoredSeries const series = read("t,y,z\n0,1,4\n0.5,2,5\n1,3,6\n");
    EXPECT_EQ(series.values, (Values{4, 5, 6}));
    EXPECT_EQ(series.name, "z");
    EXPECT_DOUBLE_EQ(series.spacing, 0.5);
    EXPECT_EQ(read("y,time\n7,0\n8,2\n").values, (Values{7, 8}));
}

TEST(SeriesFile, TakesTheColumnAskedFor) {
    EXPECT_EQ(read("t,y,z\n0,1,4\n0.5,2,5\n", "y").values, (Values{1, 2}));
    EXPECT_EQ(read("t,y,z\n0,1,4\n0.5,2,5\n", "2").values, (Values{1, 2}));
    StoredSeries const series = read("1,4\n2,5\n", "1", 0.1);
    EXPECT_EQ(series.values, (Values{1, 2}));
    EXPECT_EQ(series.name, "column 1");
    EXPECT_EQ(series.spacing, 0.1);
}

TEST(SeriesFile, ReadsTheUsualWaysToWriteATable) {
    for (char const* const text : {"1;4\n2;5\n", "1\t4\r\n2\t5\r\n", "  1   4\n\n  2 +5\n", "# a comment\n1, 4\n2, 5",
                                   "\xEF\xBB\xBF\"a\",\"b\"\n1,4e0\n2,5\n", "1.5\n4\n5\n"}) {
        Values values = read(text, "", 1.0).values;
        if (values.size() == 3) values.erase(values.begin());
        EXPECT_EQ(values, (Values{4, 5})) << text;
    }
    EXPECT_EQ(read("\"t\",\"b b\"\n1,4\n2,5\n").name, "b b");
}

TEST(SeriesFile, RefusesWhatIsNoSeries) {
    expect_refusal("", "", "a.csv:1: the table is empty");
    expect_refusal("t,y\n", "", "a.csv:1: the table has a header but no row");
    expect_refusal("t,y\n0,1\n1\n", "", "a.csv:3: the row has 1 fields between commas (the header has 2 columns)");
    expect_refusal("t,y\n0,1\n1,2\n", "w", "there is no column 'w'; give one of t, y, or a number from 1 to 2");
    expect_refusal("t,y\n0,1\n1,2\n", "3", "there is no column '3'");
    expect_refusal("x,y\n0,1\n1,2\n", "", "has no column time or t; give --dt SECONDS");
    expect_refusal("t,y\n0,1\n1,2\n3,3\n", "", "not equally spaced");
    expect_refusal("t,y\n0,1\n0,2\n0,3\n", "", "not equally spaced");
}

TEST(SeriesFile, ReadsSpreadsheetsOfOtherCountries) {
    for (char const* const text : {"t;y\n0;1,5\n0,5;2,25\n", "t\ty\n0\t1,5\n0,5\t2,25\n", "t;y;\n0;1,5;\n0,5;2,25;\n", "t;part;y\n0;A-1;1,5\n0,5;;2,25\n"}) {
        StoredSeries const series = read(text);
        EXPECT_EQ(series.values, (Values{1.5, 2.25})) << text;
        EXPECT_EQ(series.spacing, 0.5) << text;
    }
    EXPECT_EQ(read("0,5;1,5\n1,0;2,5\n", "", 1.0).values, (Values{1.5, 2.5})) << "no header";
}

TEST(SeriesFile, CellsWithoutANumberAreRefusedInTheColumnAskedFor) {
    std::string const table = "t,y,z\n0,1,4\n0.5,#DIV/0!,5\n1,,6\n";
    EXPECT_EQ(read(table, "z").values, (Values{4, 5, 6}));
    expect_refusal(table, "y", "a.csv:3: y is \"#DIV/0!\" (an error of the spreadsheet); correct its formula, or remove the row");
    expect_refusal("t y\n0 4\n1 NaN\n", "2", "a.csv:3: y is \"NaN\" (a missing value)");
    expect_refusal("t,y\n0,1\n#N/A,2\n1,3\n", "y", "a.csv:3: t is \"#N/A\"");
}

TEST(SeriesFile, AnErrorOfASpreadsheetAtItsBeginningIsRefused) {
    expect_refusal("#N/A\n0.5\n1.5\n", "", "a.csv:1: column 1 is \"#N/A\" (an error of the spreadsheet); correct its formula, or remove the row");
    expect_refusal("#DIV/0!,4\n1,2\n", "1", "a.csv:1: column 1 is \"#DIV/0!\" (an error of the spreadsheet)");
    expect_refusal("t,#REF!\n1,2\n", "", "a.csv:1: column 2 is \"#REF!\" (an error of the spreadsheet)");
}

TEST(SeriesFile, HeadersMayHaveUnits) {
    StoredSeries const series = read("time [ms],y [mm],z\n0,1,4\n0.5,2,5\n1,3,6\n", "y");
    EXPECT_DOUBLE_EQ(series.spacing, 0.5e-3);
    EXPECT_EQ(series.values, (Values{1, 2, 3})) << "as they are: their scale has no effect";
    EXPECT_EQ(read("t [s],y\n0,1\n0.5,2\n", "t [s]").values, (Values{0, 0.5}));
    expect_refusal("t [mm],y\n0,1\n1,2\n", "", "column t [mm]: ");
    expect_refusal("t [ms,y\n0,1\n1,2\n", "", "its unit has no end");
}

TEST(SeriesFile, TimesMayBeRounded) {
    // A third of a second, written with three digits.
    EXPECT_NEAR(*equal_spacing({0, 0.333, 0.667, 1}), 1.0 / 3, 1e-3);
    EXPECT_EQ(equal_spacing({0, 0.3, 0.667, 1}), std::nullopt);
    EXPECT_EQ(equal_spacing({1}), std::nullopt);
    EXPECT_EQ(equal_spacing({2, 1, 0}), std::nullopt);
}

}  // namespace
}  // namespace slideway::testing::series_file_test
