#include "host/base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <istream>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// What separates the cells of a row; `otherwise` where it has but one.
char separator_of(std::string_view row, char otherwise) {
    std::size_t semicolons = 0, tabs = 0, commas = 0, decimal_commas = 0;
    bool quoted = false, begins = true;  // quotes count at the beginning of a cell
    for (std::size_t i = 0; i < row.size(); ++i) {
        char const c = row[i];
        if (c == '"' && (quoted || begins)) {
            quoted = !quoted;
        } else if (!quoted) {
            bool const in_number = i > 0 && i + 1 < row.size() && is_digit(row[i - 1]) && is_digit(row[i + 1]);
            semicolons += c == ';';
            tabs += c == '\t';
            if (c == ',') ++(in_number ? decimal_commas : commas);
            begins = c == ';' || c == '\t' || c == ',' || (begins && c == ' ');
        }
    }
    if (semicolons > 0) return ';';
    if (tabs > 0 && commas == 0) return '\t';
    return commas + decimal_commas > 0 ? ',' : otherwise;
}

/// What programs write where there is no number.
bool stands_for_nothing(std::string_view text) {
    constexpr std::string_view words[] = {"", "-", "--", "na", "n/a", "nan", "null", "none"};
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::ranges::count(words, lower) > 0;
}

/// What spreadsheets write where a formula has no value, in any language: #N/A, #NV, #DIV/0!, #WERT!, #NOM?
bool is_formula_error(std::string_view text) {
    if (text == "#NV" || text == "#GETTING_DATA") return true;
    bool const is_one = text.ends_with('!') || text.ends_with('?') || text.find('/') != text.npos;
    return is_one && text.size() > 2 && text[0] == '#' && text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0/!?", 1) == text.npos;
}

CellFault of_formula() { return {"an error of the spreadsheet", "correct its formula, or remove the row"}; }

/// Whether a line above the first row is a comment.
bool is_comment(std::string_view row) {
    if (row.starts_with('"')) row.remove_prefix(1);
    return row.starts_with('#') && !is_formula_error(row.substr(0, row.find_first_of(",;\t\"")));
}

/// A number with a point in place of its decimal comma.
struct MarkedNumber {
    CellNumber number;
    char mark;  // '\0' of an integer
};

std::optional<MarkedNumber> marked_number(std::string_view text, bool decimal_comma) {
    MarkedNumber found{{0, std::string(text.substr(text.starts_with('+') ? 1 : 0))}, '\0'};
    std::string& digits = found.number.text;
    if (digits.starts_with('+')) return {};
    auto const comma = decimal_comma ? digits.find(',') : digits.npos;
    if (comma != digits.npos) {
        if (digits.find('.') != digits.npos) return {};
        digits[comma] = '.';
        found.mark = ',';
    } else if (digits.find('.') != digits.npos) {
        found.mark = '.';
    }
    if (!read_plain_number(digits, found.number.value)) return {};
    return found;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    auto const first = text.find_first_not_of(blank);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

bool CsvReader::read_line() {
    constexpr std::size_t longest = 1'000'000;
    text_.clear();
    ++number_;
    for (std::streambuf* const from = in_.rdbuf();;) {
        int const c = in_ ? from->sbumpc() : std::char_traits<char>::eof();
        if (c == std::char_traits<char>::eof()) {
            in_.setstate(std::ios::eofbit);
            if (text_.empty()) --number_;
            return !text_.empty();
        }
        if (c == '\n') return true;
        text_ += static_cast<char>(c);
        if (text_.size() > longest) fail(fmt::format("the line is longer than {} characters; this is no table", longest));
    }
}

bool CsvReader::next() {
    while (read_line()) {
        if (number_ == 1) begin();
        std::string_view const row = trimmed(text_);
        bool const is_first = columns_ == 0;
        if (row.empty() || (is_first && is_comment(row))) continue;
        if (row.find('\r') != row.npos) fail("its lines end with CR alone; save it with LF or CR LF");
        if (number_ == 1 && (row == "sep=;" || row == "sep=," || text_.starts_with("sep=\t"))) {
            separator_ = text_[4];
            continue;
        }
        if (is_first && separator_ == '\0') separator_ = separator_of(row, kind_ == Kind::series ? ' ' : ',');
        split();
        // Spreadsheets write separators as far as any row of theirs goes.
        while (fields_.size() > std::max<std::size_t>(columns_, 1) && fields_.back().empty()) fields_.pop_back();
        if (is_first) columns_ = fields_.size();
        return true;
    }
    return false;
}

void CsvReader::begin() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // byte order mark
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) fail("it is text of UTF-16; save it as UTF-8");
}

std::string_view CsvReader::separator_word() const {
    return separator_ == ';' ? "semicolon" : separator_ == '\t' ? "tab" : separator_ == ' ' ? "blank" : "comma";
}

/// The quoted cell at the beginning of `rest`, which then begins behind its quotes.
std::string CsvReader::take_quoted(std::string_view& rest) const {
    std::string field;
    std::size_t at = rest.find('"') + 1;
    for (;; ++at) {
        if (at >= rest.size()) fail("a quoted field does not end (a quote is open); write \" behind it");
        if (rest[at] == '"') {
            if (at + 1 >= rest.size() || rest[at + 1] != '"') break;
            ++at;  // "" is a quote
        }
        field += rest[at];
    }
    rest.remove_prefix(at + 1);
    return field;
}

void CsvReader::split() {
    fields_.clear();
    bool const blanks = separator_ == ' ';
    std::string_view rest = blanks ? trimmed(text_) : std::string_view(text_);
    std::string_view const ends = blanks ? std::string_view(" \t") : std::string_view(&separator_, 1);
    std::string_view const padding = separator_ == '\t' ? " " : " \t";
    for (;;) {
        auto const first = rest.find_first_not_of(padding);
        if (first != rest.npos && rest[first] == '"') {
            fields_.push_back(take_quoted(rest));
            if (!trimmed(rest.substr(0, rest.find_first_of(ends))).empty()) {
                fail(fmt::format("a quoted field goes on behind its quotes; write a {} there", separator_word()));
            }
        } else {
            fields_.emplace_back(trimmed(rest.substr(0, rest.find_first_of(ends))));
        }
        auto const end = rest.find_first_of(ends);
        if (end == rest.npos) return;
        rest.remove_prefix(end + 1);
        if (blanks) rest = trimmed(rest);
    }
}

std::optional<CellFault> CsvReader::read_number(std::size_t column, CellNumber& number) {
    std::string const& text = fields_[column];
    if (text.starts_with("# ")) return CellFault{"a comment below the header", "write comments above the header"};
    if (text.starts_with('#')) return of_formula();
    if (is_missing(column)) return CellFault{"a missing value", "give a number, or remove the row"};
    auto found = marked_number(text, separator_ != ',');
    if (!found) {
        bool const decimal_comma = separator_ == ',' && marked_number(text, true).has_value();
        return CellFault{"not a number", decimal_comma ? "write a decimal point, or semicolons between the columns" : ""};
    }
    if (!std::isfinite(found->number.value)) return CellFault{"not a finite number", "use a finite number"};
    if (found->mark != '\0') {
        if (mark_ == '\0') mark_ = found->mark, mark_line_ = line();
        if (found->mark != mark_) {
            auto const name = [](char mark) { return mark == ',' ? "comma" : "point"; };
            return CellFault{fmt::format("a decimal {}, after a decimal {} in line {}", name(found->mark), name(mark_), mark_line_),
                             "use one of the two in all of the file"};
        }
    }
    number = std::move(found->number);
    return {};
}

bool CsvReader::is_number(std::size_t column) const { return marked_number(fields_[column], separator_ != ',').has_value(); }

std::optional<CellFault> CsvReader::formula_fault(std::size_t column) const {
    return is_formula_error(fields_[column]) ? std::optional(of_formula()) : std::nullopt;
}

bool CsvReader::is_missing(std::size_t column) const { return stands_for_nothing(fields_[column]); }

void CsvReader::require_columns() const {
    if (fields_.size() == columns_) return;
    fail(fmt::format("the row has {} fields between {}s (the header has {} columns); {}", fields_.size(), separator_word(), columns_,
                     fields_.front().starts_with('#') ? "comments stand above the header" : "write one for each column"));
}

std::string CsvReader::where() const { return fmt::format("{}:{}", name_, line()); }

void CsvReader::fail(std::string_view message) const { throw SceneError(fmt::format("{}: {}", where(), message)); }

bool read_plain_number(std::string_view text, double& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument) return false;
    // from_chars does not tell too large from too small.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);
    return true;
}

}  // namespace slideway
