#include <cmath>
#include <sstream>

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
    EXPECT_EQ(rows_of(",\na,"), (std::vector<Fields>{{"1", "", ""}, {"2", "a", ""}}));
    EXPECT_TRUE(rows_of("").empty());
}

TEST(Csv, QuotedFieldsHoldCommasAndQuotes) {
    EXPECT_EQ(rows_of(R"("a,b" , "c ""d""",""," e ")"), (std::vector<Fields>{{"1", "a,b", "c \"d\"", "", " e "}}));
    EXPECT_EQ(rows_of(R"(a "b",c)"), (std::vector<Fields>{{"1", "a \"b\"", "c"}})) << "quotes count at the beginning";
}

TEST(Csv, EmptyLinesCommentsAndAByteOrderMarkAreNoRows) {
    EXPECT_EQ(rows_of("\xEF\xBB\xBF# a\n\n  \n x\n \t# b, c\r\ny # z"),
              (std::vector<Fields>{{"4", "x"}, {"6", "y # z"}}));
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
