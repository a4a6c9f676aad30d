#include "host/store/column.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

constexpr std::size_t label_length = 8;  // of the quantity table's dimensions, but for those with longer ones: "surface" and room for one more letter

template <class T> std::vector<T> stored_as(ResultColumn::Numbers const& numbers) {
    std::vector<T> stored(numbers.size());
    std::ranges::transform(numbers, stored.begin(), [](double number) { return static_cast<T>(number); });
    return stored;
}

ResultColumn::Numbers letters_of(std::vector<std::string> const& texts, std::size_t width) {
    ResultColumn::Numbers letters(texts.size() * width);
    for (std::size_t i = 0; i < texts.size(); ++i) std::ranges::copy(texts[i], letters.begin() + static_cast<std::ptrdiff_t>(i * width));
    return letters;
}

ResultColumn label_column(std::string const& name, std::string const& dimension, std::string const& letters, std::string const& meaning) {
    return {.name = name + "_name", .unit = "", .meaning = meaning, .dimensions = {dimension, letters}, .type = DataFile::Type::text};
}

/// What is known of members before they have run.
void write_before(DataFile& file, std::vector<int> const& variables, ResultColumns const& list, MemberSet const& members) {
    constexpr std::uint64_t at_once = 1 << 16;
    for (std::uint64_t first = 0; first < members.count(); first += at_once) {
        std::vector<std::uint64_t> const some = members.members(first, at_once);
        for (std::size_t i = 0; i < variables.size(); ++i) {
            if (!list.columns[i].before) continue;
            ResultColumn::Numbers numbers;
            for (std::uint64_t const member : some) list.columns[i].before(member, numbers);
            put_numbers(file, variables[i], list, list.columns[i], numbers, static_cast<std::size_t>(first));
        }
    }
}

}  // namespace

std::size_t ResultColumns::width(ResultColumn const& column) const {
    std::size_t width = 1;
    for (std::size_t d = 1; d < column.dimensions.size(); ++d) width *= std::ranges::find(dimensions, column.dimensions[d], &DataFile::Dimension::name)->length;
    return width;
}

std::size_t ResultColumns::size(ResultColumn const& column) const {
    return column.dimensions.empty() ? 1 : std::ranges::find(dimensions, column.dimensions.front(), &DataFile::Dimension::name)->length * width(column);
}

void ResultColumns::add_labels_of(std::string const& dimension) {
    if (has_dimension(dimension)) return;
    std::vector<std::string> const labels = labels_of(dimension);
    std::size_t width = label_length;
    for (std::string const& label : labels) width = std::max(width, label.size());
    std::string const letters = width > label_length ? dimension + "_length" : "label_length";
    if (!has_dimension(letters)) dimensions.push_back({letters, width});
    dimensions.push_back({dimension, labels.size()});
    columns.push_back(label_column(dimension, dimension, letters, fmt::format("label along {}", dimension)));
    columns.back().values = letters_of(labels, width);
}

void put_attributes(DataFile& file, int variable, std::vector<DataFile::Attribute> const& attributes) {
    for (DataFile::Attribute const& attribute : attributes) file.put(variable, attribute.name, attribute.value);
}

int define(DataFile& file, ResultColumn const& column) {
    std::vector<int> dimensions;
    for (std::string const& name : column.dimensions) dimensions.push_back(file.dimension(name));
    // Whatever goes by members reads as NaN where nothing was written, if it is a number that can be.
    bool const fill = column.type == DataFile::Type::float64 && !dimensions.empty() && column.dimensions.front() == "member";
    int const variable = file.add_variable(column.name, column.type, dimensions, fill);
    if (!column.unit.empty()) file.put(variable, "units", column.unit);
    file.put(variable, "long_name", column.meaning);
    if (column.type == DataFile::Type::text) file.put(variable, "_Encoding", "utf-8");  // readers then give strings, not bytes
    if (!column.coordinates.empty()) file.put(variable, "coordinates", column.coordinates);
    put_attributes(file, variable, column.attributes);
    return variable;
}

std::vector<int> define(DataFile& file, ResultColumns const& list, MemberSet const& members) {
    constexpr std::uint64_t largest = std::numeric_limits<int>::max();
    if (!members.empty() && members.ranges().back().end() > largest) throw FileError(fmt::format("{}: cannot number members beyond {}", file.path(), largest));
    put_attributes(file, DataFile::global, list.attributes);
    for (DataFile::Dimension const& dimension : list.dimensions) file.add_dimension(dimension.name, dimension.length);
    std::vector<int> variables;
    for (ResultColumn const& column : list.columns) variables.push_back(define(file, column));
    for (std::size_t i = 0; i < variables.size(); ++i) {
        if (!list.columns[i].values.empty()) put_numbers(file, variables[i], list, list.columns[i], list.columns[i].values);
    }
    write_before(file, variables, list, members);
    return variables;
}

void put_numbers(DataFile& file, int variable, ResultColumns const& list, ResultColumn const& column, ResultColumn::Numbers const& numbers, std::size_t first) {
    if (numbers.empty()) return;
    std::vector<std::size_t> start(column.dimensions.size(), 0), count;
    for (std::string const& name : column.dimensions) count.push_back(std::ranges::find(list.dimensions, name, &DataFile::Dimension::name)->length);
    if (!count.empty()) start[0] = first, count[0] = numbers.size() / list.width(column);
    if (column.type == DataFile::Type::float64) return file.write(variable, start, count, numbers.data());
    if (column.type == DataFile::Type::int32) return file.write(variable, start, count, stored_as<int>(numbers).data());
    file.write(variable, start, count, stored_as<char>(numbers).data());
}

void put_texts(DataFile& file, std::string const& name, std::string const& dimension, std::string const& meaning, std::vector<std::string> const& texts) {
    std::size_t width = 1;
    for (std::string const& text : texts) width = std::max(width, text.size());
    file.add_dimension(name + "_length", width);
    ResultColumn::Numbers const letters = letters_of(texts, width);
    std::vector<char> const stored(letters.begin(), letters.end());
    file.write(define(file, label_column(name, dimension, name + "_length", meaning)), stored.data());
}

std::vector<std::string> read_texts(DataFile const& file, DataFile::Variable const& variable) {
    std::vector<std::string> texts;
    if (variable.type != DataFile::Type::text || variable.shape.size() != 2) return texts;
    std::vector<char> const letters = file.read<char>(variable);
    for (std::size_t row = 0; row < variable.shape[0]; ++row) {
        std::string_view const padded(letters.data() + row * variable.shape[1], variable.shape[1]);
        texts.emplace_back(padded.substr(0, padded.find('\0')));
    }
    return texts;
}

void put_labels(DataFile& file, std::string const& name, std::string const& meaning, std::vector<std::string> const& labels) {
    file.add_dimension(name, labels.size());
    put_texts(file, name, name, meaning, labels);
}

}  // namespace slideway
