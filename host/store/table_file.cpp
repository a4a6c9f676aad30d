#include "host/store/table_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/text.hpp"

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

// Level 5 of MAT files, after MathWorks, "MAT-File Format", chapter 1: a header of 128 bytes, then elements, each a type, a length in bytes and
// data up to a multiple of 8 bytes.  A variable is an element of elements: flags, sizes, name, content.

namespace {

enum MatType : std::uint32_t { mat_int8 = 1, mat_int32 = 5, mat_uint32 = 6, mat_double = 9, mat_matrix = 14, mat_utf8 = 16 };
enum MatClass : std::uint32_t { mat_cell = 1, mat_struct = 2, mat_char = 4, mat_number = 6 };

constexpr std::uint64_t largest_variable = (std::uint64_t{1} << 31) - 1;  // [B]
constexpr std::size_t field_length = 64;                                  // of a name with its end, as MATLAB has it since 7.6

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }
std::uint64_t element_bytes(std::uint64_t bytes) { return 8 + (bytes <= 4 ? 0 : padded(bytes)); }

/// Up to four bytes stand in the place of a length of their own.
void put_element(NewFile& file, MatType type, std::span<std::byte const> data) {
    bool const is_small = !data.empty() && data.size() <= 4;
    std::uint32_t head[2] = {type, static_cast<std::uint32_t>(data.size())};
    if (is_small) {
        head[0] |= head[1] << 16;
        head[1] = 0;
        std::memcpy(&head[1], data.data(), data.size());
    }
    file.append(std::as_bytes(std::span(head)));
    if (is_small) return;
    file.append(data);
    std::byte const nothing[8] = {};
    file.append(std::span(nothing).first(padded(data.size()) - data.size()));
}
template <class Number> void put_element(NewFile& file, MatType type, std::vector<Number> const& numbers) {
    put_element(file, type, std::as_bytes(std::span(numbers)));
}

/// A variable, or a part of one.
struct MatValue {
    MatClass kind = mat_number;
    std::size_t rows = 1, columns = 1;
    std::function<std::vector<double>()> numbers = {};  // column by column
    std::string letters = {};                           // UTF-8
    std::vector<std::string> names = {};                // of fields
    std::vector<MatValue> parts = {};                   // fields, or cells

    /// Bytes behind the head of its element.
    std::uint64_t content(std::size_t name) const {
        std::uint64_t bytes = element_bytes(8) + element_bytes(8) + element_bytes(name);
        if (kind == mat_number) bytes += element_bytes(8 * std::uint64_t{rows} * columns);
        if (kind == mat_char) bytes += element_bytes(letters.size());
        if (kind == mat_struct) bytes += element_bytes(4) + element_bytes(field_length * names.size());
        for (MatValue const& part : parts) bytes += 8 + part.content(0);
        return bytes;
    }
};

void put_value(NewFile& file, std::string const& name, MatValue const& value) {
    std::uint32_t const head[2] = {mat_matrix, static_cast<std::uint32_t>(value.content(name.size()))};
    file.append(std::as_bytes(std::span(head)));
    put_element(file, mat_uint32, std::vector<std::uint32_t>{value.kind, 0});
    put_element(file, mat_int32, std::vector<std::int32_t>{static_cast<std::int32_t>(value.rows), static_cast<std::int32_t>(value.columns)});
    put_element(file, mat_int8, std::as_bytes(std::span(name)));
    if (value.kind == mat_number) put_element(file, mat_double, value.numbers());
    if (value.kind == mat_char) put_element(file, mat_utf8, std::as_bytes(std::span(value.letters)));
    if (value.kind == mat_struct) {
        put_element(file, mat_int32, std::vector<std::int32_t>{field_length});
        std::string names(field_length * value.names.size(), '\0');
        for (std::size_t i = 0; i < value.names.size(); ++i) value.names[i].copy(&names[i * field_length], field_length - 1);
        put_element(file, mat_int8, std::as_bytes(std::span(names)));
    }
    for (MatValue const& part : value.parts) put_value(file, "", part);
}

/// What is no character, or one that takes two places in MATLAB and one elsewhere, becomes U+FFFD.
MatValue text_value(std::string const& text) {
    MatValue value{.kind = mat_char, .columns = 0};
    for (std::size_t at = 0, length = 0; at < text.size(); at += std::max<std::size_t>(1, length), ++value.columns) {
        length = character_length(text, at);
        value.letters += length == 0 || length == 4 ? "\xef\xbf\xbd" : text.substr(at, length);
    }
    value.rows = value.columns == 0 ? 0 : 1;
    return value;
}

MatValue column_value(ExportTable const& table, TableColumns const& columns, std::size_t k) {
    using enum TableColumns::Along;
    MatValue value{.rows = columns.along == samples ? table.samples : table.members, .columns = columns.along == both ? table.samples : 1};
    if (!columns.numbers) {
        value.kind = mat_cell;
        for (std::string const& word : columns.words) value.parts.push_back(text_value(word));
        return value;
    }
    value.numbers = [&columns, k, rows = value.rows, wide = value.columns] {
        // Row by row they come; one column of several, or all of a matrix.
        std::size_t const width = columns.names.size() * wide;
        std::vector<double> const all = columns.numbers(0, rows);
        std::vector<double> turned;
        turned.reserve(rows * wide);
        for (std::size_t column = 0; column < wide; ++column) {
            for (std::size_t row = 0; row < rows; ++row) turned.push_back(all[row * width + column + k]);
        }
        return turned;
    };
    return value;
}

/// "joint.clearance" as joint_clearance, "mode_time[free]" as mode_time_free, and no name twice.
std::string field_name(std::string const& name, std::vector<std::string> const& taken) {
    std::string field;
    for (char const c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') field += c;
        else if (!field.ends_with('_')) field += '_';
    }
    field.erase(field.find_last_not_of('_') + 1);
    std::string unique = field.substr(0, field_length - 1);
    for (int i = 2; std::ranges::find(taken, unique) != taken.end(); ++i) {
        std::string const number = fmt::format("_{}", i);
        unique = field.substr(0, field_length - 1 - number.size()) + number;
    }
    return unique;
}

}  // namespace

void write_mat(OutputTarget const& target, std::vector<ExportTable> const& tables) {
    MatValue all{.kind = mat_struct}, units{.kind = mat_struct};
    for (ExportTable const& table : tables) {
        MatValue one{.kind = mat_struct}, its_units{.kind = mat_struct};
        for (TableColumns const& columns : table.columns) {
            for (std::size_t k = 0; k < columns.names.size(); ++k) {
                one.names.push_back(field_name(columns.names[k], one.names));
                one.parts.push_back(column_value(table, columns, k));
                its_units.parts.push_back(text_value(columns.unit));
            }
        }
        if (std::uint64_t const bytes = one.content(table.name.size()); bytes > largest_variable) {
            constexpr char const* words = "{}: {} would have {:.1f} GB, and a MAT file holds less than 2.1 GB a variable; write a CSV, or fewer series";
            throw FileError(fmt::format(words, target.name(), table.name, 1e-9 * static_cast<double>(bytes)));
        }
        its_units.names = one.names;
        for (auto* const of : {&all, &units}) of->names.push_back(table.name);
        all.parts.push_back(std::move(one));
        units.parts.push_back(std::move(its_units));
    }
    target.write([&](NewFile& file) {
        std::string header = mat_title;
        header.resize(124, ' ');
        std::fill(header.begin() + 116, header.end(), '\0');  // nothing of another system
        file.append(header + std::string("\x00\x01IM", 4));
        for (std::size_t i = 0; i < all.parts.size(); ++i) put_value(file, all.names[i], all.parts[i]);
        put_value(file, "units", units);
    });
}

}  // namespace slideway
