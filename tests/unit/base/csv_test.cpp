#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/base/csv.hpp"
#include "host/base/error.hpp"

namespace slideway::csv_test {
namespace {

using Fields = std::vector<std::string>;

/// The fields of each row, the line of each in front.
std::vector<Fields> rows_of(std::string const& text) {
    std::istringstream in(text);
    CsvReader reader(in, "a.csv");
    std::vector<Fields> rows;
    while (reader.next()) {
        rows.push_back({std::to_string(reader.line())});
        rows.back().insert(rows.back().end(), reader.fields().begin(), reader.fields().end());
    }
    return rows;
}

TEST(Csv, RowsHaveFieldsBetweenCommas) {
    EXPECT_EQ(rows_of("a,b\n1, 2 ,\t3\r\n"), (std::vector<Fields>{{"1", "a", "b"}, {"2", "1", "2", "3"}}));
    EXPECT_TRUE(rows_of("").empty());
}

TEST(Csv, QuotedFieldsHoldCommasAndQuotes) {
    EXPECT_EQ(rows_of(R"("a,b" , "c ""d""",""," e ")"), (std::vector<Fields>{{"1", "a,b", "c \"d\"", "", " e "}}));
    EXPECT_EQ(rows_of(R"(a "b",c)"), (std::vector<Fields>{{"1", "a \"b\"", "c"}})) << "quotes count at the beginning";
}

TEST(Csv, EmptyLinesCommentsAndAByteOrderMarkAreNoRows) {
    EXPECT_EQ(rows_of("\xEF\xBB\xBF# a\n\n \t# b, c\r\n x\n\n  \ny # z"), (std::vector<Fields>{{"4", "x"}, {"7", "y # z"}}));
}

TEST(Csv, BelowTheHeaderANumberSignBeginsARow) {
    EXPECT_EQ(rows_of("# a\nx,y\n#N/A,1\n# b\n"), (std::vector<Fields>{{"2", "x", "y"}, {"3", "#N/A", "1"}, {"4", "# b"}}));
}

TEST(Csv, AnErrorOfASpreadsheetIsNoComment) {
    for (char const* const cell : {"#N/A", "\"#DIV/0!\"", "#NV", "#WERT!", "#NOM?"}) {
        std::string const bare = cell[0] == '"' ? "#DIV/0!" : cell;
        EXPECT_EQ(rows_of(fmt::format("{},1\n2,3", cell)), (std::vector<Fields>{{"1", bare, "1"}, {"2", "2", "3"}})) << cell;
        EXPECT_EQ(rows_of(fmt::format("{}\n2", cell)), (std::vector<Fields>{{"1", bare}, {"2", "2"}})) << cell;
    }
    for (char const* const comment : {"#", "# N/A", "#time,y", "#data!", "\"# a/b\"", "#A b!"}) EXPECT_EQ(rows_of(fmt::format("{}\nx", comment)), (std::vector<Fields>{{"2", "x"}})) << comment;
}

TEST(Csv, AFirstLineMayNameTheSeparator) {
    EXPECT_EQ(rows_of("sep=;\na;b,c\n1;2"), (std::vector<Fields>{{"2", "a", "b,c"}, {"3", "1", "2"}}));
    EXPECT_EQ(rows_of("\xEF\xBB\xBFsep=,\r\na,b;c\r\n"), (std::vector<Fields>{{"2", "a", "b;c"}}));
    EXPECT_EQ(rows_of("x\nsep=;\n"), (std::vector<Fields>{{"1", "x"}, {"2", "sep=;"}})) << "further down it is a row";
}

TEST(Csv, TextThatIsWrittenOtherwiseIsToldByItsCause) {
    auto const expect = [](std::string const& text, std::string const& line) {
        try {
            rows_of(text);
            ADD_FAILURE() << "no refusal: " << line;
        } catch (SceneError const& error) {
            EXPECT_EQ(error.what(), line);
        }
    };
    expect(std::string("\xFF\xFE" "a\0,\0", 6), "a.csv:1: it is text of UTF-16; save it as UTF-8");
    expect("a,b\r1,2\r", "a.csv:1: its lines end with CR alone; save it with LF or CR LF");
}

TEST(Csv, TheFirstRowSaysWhatSeparates) {
    Fields const abc{"1", "a", "b", "c"};
    for (char const* const row : {"a,b,c", "a;b;c", "a\tb\tc", " a ; b;c ", "a,\tb,\t\tc", "\"a\";\"b\";c"}) EXPECT_EQ(rows_of(row), std::vector<Fields>{abc}) << row;
    EXPECT_EQ(rows_of("x;y\n1,5;2,5"), (std::vector<Fields>{{"1", "x", "y"}, {"2", "1,5", "2,5"}}));
    EXPECT_EQ(rows_of("x\ty\n1,5\t2;5\n\t\"a\tb\""), (std::vector<Fields>{{"1", "x", "y"}, {"2", "1,5", "2;5"}, {"3", "", "a\tb"}}));
    EXPECT_EQ(rows_of("\"x;y\"\n1,2"), (std::vector<Fields>{{"1", "x;y"}, {"2", "1", "2"}})) << "a semicolon in quotes separates nothing";
    EXPECT_EQ(rows_of("name, first;x\na;b"), (std::vector<Fields>{{"1", "name, first", "x"}, {"2", "a", "b"}}));
}

TEST(Csv, ASeriesMayHaveBlanksAndDecimalCommasWithoutAHeader) {
    auto const first_row = [](std::string const& text) {
        std::istringstream in(text);
        CsvReader reader(in, "a.csv", CsvReader::Kind::series);
        EXPECT_TRUE(reader.next());
        return reader.fields();
    };
    EXPECT_EQ(first_row("  1   2 "), (Fields{"1", "2"}));
    EXPECT_EQ(first_row("0,5\t1,5"), (Fields{"0,5", "1,5"}));
    EXPECT_EQ(first_row("0,5;1,5"), (Fields{"0,5", "1,5"}));
    EXPECT_EQ(first_row("0,5"), (Fields{"0", "5"}));
}

TEST(Csv, SeparatorsBehindTheLastColumnAreNone) {
    EXPECT_EQ(rows_of("a,b,,\n1,2,,\n3,4\n5,6,,,,\n"), (std::vector<Fields>{{"1", "a", "b"}, {"2", "1", "2"}, {"3", "3", "4"}, {"4", "5", "6"}}));
    EXPECT_EQ(rows_of("a;b;\n1;;\n;;x"), (std::vector<Fields>{{"1", "a", "b"}, {"2", "1", ""}, {"3", "", "", "x"}}));
    EXPECT_EQ(rows_of(",\na,"), (std::vector<Fields>{{"1", ""}, {"2", "a"}}));
}

/// What is wrong with the cells of a table of one column, in the order of its rows; "" for a number.
Fields faults_in(std::string const& text) {
    std::istringstream in(text);
    CsvReader reader(in, "a.csv");
    Fields faults;
    EXPECT_TRUE(reader.next());
    while (reader.next()) {
        CellNumber number;
        auto const fault = reader.read_number(0, number);
        faults.push_back(fault ? fault->reason : "");
    }
    return faults;
}

TEST(Csv, CellsWithoutANumberSayWhy) {
    for (char const* const cell : {"\"\"", "NA", "n/a", "NaN", "null", "NULL", "-", "None"}) {
        EXPECT_EQ(faults_in(std::string("x\n") + cell), Fields{"a missing value"}) << cell;
    }
    for (char const* const cell : {"#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!", "#NV"}) {
        EXPECT_EQ(faults_in(std::string("x\n") + cell), Fields{"an error of the spreadsheet"}) << cell;
    }
    EXPECT_EQ(faults_in("x\n# a comment"), Fields{"a comment below the header"});
    EXPECT_EQ(faults_in("x\ninf\n-1e999\n1e3\n1 mm\n--1"), (Fields{"not a finite number", "not a finite number", "", "not a number", "not a number"}));
}

TEST(Csv, OneFileHasOneDecimalMark) {
    EXPECT_EQ(faults_in("x;y\n1,5;\n2;\n+3,25e-1;\n"), (Fields{"", "", ""}));
    EXPECT_EQ(faults_in("x;y\n1.5;\n2,5;\n3.5;\n"), (Fields{"", "a decimal comma, after a decimal point in line 2", ""}));
    EXPECT_EQ(faults_in("x\ty\n1,5\t\n2.5\t\n"), (Fields{"", "a decimal point, after a decimal comma in line 2"}));
    EXPECT_EQ(faults_in("x;y\n1.234,5;\n1,2,3;\n"), (Fields{"not a number", "not a number"})) << "digits in groups";
    EXPECT_EQ(faults_in("x,y\n\"1,5\",\n"), Fields{"not a number"}) << "commas separate";
    std::istringstream in("x;y\n+0,1;\n");
    CsvReader reader(in, "a.csv");
    CellNumber number;
    EXPECT_TRUE(reader.next() && reader.next() && !reader.read_number(0, number));
    EXPECT_EQ(number.value, 0.1);
    EXPECT_EQ(number.text, "0.1");
}

TEST(Csv, ARowOfOtherLengthNamesItsSeparator) {
    std::istringstream in("x;y\n1;2;3\n");
    CsvReader reader(in, "a.csv");
    ASSERT_TRUE(reader.next() && reader.next());
    try {
        reader.require_columns();
        ADD_FAILURE();
    } catch (SceneError const& error) {
        EXPECT_STREQ(error.what(), "a.csv:2: the row has 3 fields between semicolons (the header has 2 columns); write one for each column");
    }
}

TEST(Csv, BrokenQuotesAreRefusedAtTheirLine) {
    for (char const* const row : {"\"", "\"a", "1,\"a\"\"", "\"a\"b", "\"a\" \"b\""}) {
        std::istringstream in(std::string("x\n") + row + "\n");
        CsvReader reader(in, "a.csv");
        ASSERT_TRUE(reader.next());
        try {
            reader.next();
            ADD_FAILURE() << row;
        } catch (SceneError const& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("a.csv:2: a quoted field ")) << error.what();
        }
    }
}

TEST(Csv, NumbersStandAlone) {
    double value = 0;
    for (auto const& [text, expected] :
         {std::pair{"1", 1.0}, {"+2.5", 2.5}, {"-3e-2", -0.03}, {".5", 0.5}, {"1e-400", 0.0}}) {
        EXPECT_TRUE(read_plain_number(text, value)) << text;
        EXPECT_EQ(value, expected) << text;
    }
    EXPECT_TRUE(read_plain_number("nan", value));
    EXPECT_TRUE(std::isnan(value));
    for (char const* const text : {"1e400", "inf"}) {
        EXPECT_TRUE(read_plain_number(text, value)) << text;
        EXPECT_TRUE(std::isinf(value) && value > 0) << text;
    }
    for (char const* const text : {"", "+", "1 mm", " 1", "1,5", "0x10", "one", "1e", "--1"}) {
        EXPECT_FALSE(read_plain_number(text, value)) << text;
    }
}

}  // namespace
}  // namespace slideway::csv_test
