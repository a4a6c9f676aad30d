// Tables as text, row by row: cells between commas, semicolons or tabs; of series also between blanks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slideway {

/// A number as a cell has it.
struct CellNumber {
    double value = 0;
    std::string text;  // its decimal digits, with a point and without a leading +
};

/// Why a cell holds no number that can be used; words for `… is "#N/A" (reason); advice`.
struct CellFault {
    std::string reason;
    std::string advice;  // "" where only the caller knows what to write instead
};

/// Reads rows and knows where it is.  Empty lines are skipped, above the first row also lines that begin with #, but for those that begin with
/// an error of a spreadsheet (#N/A); further down all such lines are rows.  A first line `sep=;` is Excel's, for what separates cells.  Blanks
/// around cells count for nothing.  A cell in double quotes may hold separators, and "" for a quote; it ends on its own line.
///
/// The first row says what separates cells: semicolons, else tabs, else commas; commas between digits beside tabs are decimal marks, and
/// tabs beside other commas are blanks.  Empty cells at its end are no columns, and those below them are left out.  Where cells are not
/// separated by commas, numbers may have a decimal comma; one file has one decimal mark.
class CsvReader {
public:
    /// A series without separators in its first row has blanks between its cells.
    enum class Kind { table, series };

    CsvReader(std::istream& in, std::string name, Kind kind = Kind::table) : in_(in), name_(std::move(name)), kind_(kind) {}

    /// The next row, if there is one.  @throws SceneError where a quote does not end, or a line is too long for a table (a device, say)
    bool next();
    std::vector<std::string> const& fields() const { return fields_; }

    /// The number in a cell of the row, or why there is none.
    std::optional<CellFault> read_number(std::size_t column, CellNumber& number);
    /// Whether a cell is a number, or empty or a word for that: NA, NaN, null, …
    bool is_number(std::size_t column) const;
    bool is_missing(std::size_t column) const;
    /// Of a cell with what a spreadsheet writes where a formula has no value, #N/A, #DIV/0!, …: why it cannot be used.
    std::optional<CellFault> formula_fault(std::size_t column) const;
    /// Refuses a row with more or fewer cells than the first.
    void require_columns() const;

    int line() const { return std::max(number_, 1); }                                        // of the row, from 1
    std::string where() const;                               // "members.csv:3"
    [[noreturn]] void fail(std::string_view message) const;  // SceneError `members.csv:3: message`

private:
    bool read_line();
    void begin();  // the first line
    void split();
    std::string take_quoted(std::string_view& rest) const;
    std::string_view separator_word() const;

    std::istream& in_;
    std::string name_;
    Kind kind_;
    std::string text_;
    std::vector<std::string> fields_;
    std::size_t columns_ = 0;  // of the first row
    int number_ = 0;
    char separator_ = '\0';
    char mark_ = '\0';  // of decimals, once a number has one
    int mark_line_ = 0;
};

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// Whether the text is one number and nothing else, with or without a +: nan and inf are.  Beyond the range of double
/// it is infinite or zero.
bool read_plain_number(std::string_view text, double& value);

}  // namespace slideway
