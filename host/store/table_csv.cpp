#include <algorithm>
#include <charconv>
#include <cmath>

#include "host/store/table_file.hpp"

namespace slideway {
namespace {

using Along = TableColumns::Along;

/// A text between commas.
std::string csv_cell(std::string const& text) {
    if (text.find_first_of(",;\"\r\n\t") == text.npos) return text;
    std::string quoted = "\"";
    for (char const c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

void append_shortest(std::string& to, double number) {
    if (std::isnan(number)) return;
    char digits[32];
    to.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

std::string csv_header(ExportTable const& table) {
    std::string header;
    for (TableColumns const& columns : table.columns) {
        for (std::string const& name : columns.names)
            header += (header.empty() ? "" : ",") + csv_cell(columns.unit.empty() ? name : name + " [" + columns.unit + "]");
    }
    return header + '\n';
}

/// @param numbers of each of the columns, from a member `first` on  @param line from there
void append_line(std::string& to, ExportTable const& table, std::vector<std::vector<double>> const& numbers, std::size_t first, std::size_t line) {
    std::size_t const member = line / table.samples, sample = line % table.samples;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        TableColumns const& columns = table.columns[i];
        std::size_t const width = columns.names.size(), place = columns.along == Along::both ? line : columns.along == Along::samples ? sample : member;
        for (std::size_t k = 0; k < width; ++k) {
            if (i + k > 0) to += ',';
            if (columns.numbers) append_shortest(to, numbers[i][place * width + k]);
            else to += csv_cell(columns.words[first + member]);
        }
    }
    to += '\n';
}

}  // namespace

void write_csv(OutputTarget const& target, ExportTable const& table) {
    std::size_t width = 0;
    for (TableColumns const& columns : table.columns) width += columns.names.size();
    constexpr std::size_t numbers_at_once = 1 << 21;
    std::size_t const at_once = std::max<std::size_t>(1, numbers_at_once / (width * std::max<std::size_t>(1, table.samples)));
    target.write([&](NewFile& file) {
        file.append(csv_header(table));
        for (std::size_t first = 0; first < table.members; first += at_once) {
            std::size_t const count = std::min(at_once, table.members - first);
            std::vector<std::vector<double>> numbers;
            for (TableColumns const& columns : table.columns) {
                bool const of_samples = columns.along == Along::samples;
                numbers.push_back(!columns.numbers ? std::vector<double>() : of_samples ? columns.numbers(0, table.samples) : columns.numbers(first, count));
            }
            std::string text;
            for (std::size_t line = 0; line < count * table.samples; ++line) append_line(text, table, numbers, first, line);
            file.append(text);
        }
    });
}

}  // namespace slideway
