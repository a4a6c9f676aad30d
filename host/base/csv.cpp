#include "host/base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <istream>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {

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
        if (number_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // byte order mark
        std::string_view const row = trimmed(text_);
        if (row.empty() || row.front() == '#') continue;
        if (separator_ == '\0') separator_ = row.find(',') != row.npos ? ',' : row.find(';') != row.npos ? ';' : ' ';
        split();
        return true;
    }
    return false;
}

void CsvReader::split() {
    fields_.clear();
    std::string_view rest = separator_ == ' ' ? trimmed(text_) : std::string_view(text_);
    std::string_view const ends = separator_ == ' ' ? std::string_view(" \t") : std::string_view(&separator_, 1);
    for (;;) {
        auto const first = rest.find_first_not_of(" \t");
        std::string field;
        if (first != rest.npos && rest[first] == '"') {
            std::size_t at = first + 1;
            for (;; ++at) {
                if (at >= rest.size()) fail("a quoted field does not end (a quote is open); write \" behind it");
                if (rest[at] == '"') {
                    if (at + 1 >= rest.size() || rest[at + 1] != '"') break;
                    ++at;  // "" is a quote
                }
                field += rest[at];
            }
            rest.remove_prefix(at + 1);
            if (auto const tail = trimmed(rest.substr(0, rest.find_first_of(ends))); !tail.empty()) {
                fail("a quoted field goes on behind its quotes; write a comma there");
            }
            fields_.push_back(std::move(field));
        } else {
            fields_.emplace_back(trimmed(rest.substr(0, rest.find_first_of(ends))));
        }
        auto const end = rest.find_first_of(ends);
        if (end == rest.npos) return;
        rest.remove_prefix(end + 1);
        if (separator_ == ' ') rest = trimmed(rest);
    }
}

int CsvReader::line() const { return std::max(number_, 1); }

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
