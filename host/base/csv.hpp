// Tables of comma-separated values, row by row; of series also separated by semicolons or blanks.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace slideway {

/// Reads rows and knows where it is.  Empty lines and lines that begin with # are skipped, blanks around fields too.
/// A field in double quotes may hold commas, and "" for a quote; it ends on its own line.
class CsvReader {
public:
    enum class Separator { comma, by_first_row };  // there: a comma, else a semicolon, else blanks

    CsvReader(std::istream& in, std::string name, Separator separator = Separator::comma)
        : in_(in), name_(std::move(name)), separator_(separator == Separator::comma ? ',' : '\0') {}

    /// The next row, if there is one.  @throws SceneError where a quote does not end, or a line is too long for a table (a device, say)
    bool next();
    std::vector<std::string> const& fields() const { return fields_; }

    int line() const;                                        // of the row, from 1
    std::string where() const;                               // "members.csv:3"
    [[noreturn]] void fail(std::string_view message) const;  // SceneError `members.csv:3: message`

private:
    bool read_line();
    void split();

    std::istream& in_;
    std::string name_;
    std::string text_;
    std::vector<std::string> fields_;
    int number_ = 0;
    char separator_;
};

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// Whether the text is one number and nothing else, with or without a +: nan and inf are.  Beyond the range of double
/// it is infinite or zero.
bool read_plain_number(std::string_view text, double& value);

}  // namespace slideway
