#include "host/study/group_writer.hpp"

#include <algorithm>
#include <array>

namespace slideway {

void GroupWriter::attribute(std::string const& name, std::string const& text) {
    group_.put_text(NetcdfFile::global, name, text);
}

void GroupWriter::attribute(std::string const& name, double number) {
    group_.put_number(NetcdfFile::global, name, number);
}

void GroupWriter::dimension(std::string const& name, std::size_t length) { group_.add_dimension(name, length); }

void GroupWriter::labels(std::string const& name, std::string const& long_name,
                         std::vector<std::string> const& labels) {
    group_.add_dimension(name, labels.size());
    texts(name, name, long_name, labels);
}

void GroupWriter::texts(std::string const& name, std::string const& dimension, std::string const& long_name,
                        std::vector<std::string> const& texts) {
    std::size_t width = 1;
    for (std::string const& text : texts) width = std::max(width, text.size());
    std::array const dimensions{group_.dimension(dimension), group_.add_dimension(name + "_length", width)};
    int const variable = group_.add_variable(name + "_name", NetcdfFile::Type::text, dimensions);
    group_.put_text(variable, "long_name", long_name);
    group_.put_text(variable, "_Encoding", "utf-8");
    std::vector<char> letters(texts.size() * width, '\0');
    for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(letters.data() + i * width, width);
    group_.write(variable, std::array<std::size_t, 2>{0, 0}, std::array{texts.size(), width}, letters.data());
}

int GroupWriter::define(Description const& description, NetcdfFile::Type type) {
    std::vector<int> dimensions;
    for (std::string const& name : description.dimensions) dimensions.push_back(group_.dimension(name));
    int const variable = group_.add_variable(description.name, type, dimensions);
    if (!description.unit.empty()) group_.put_text(variable, "units", description.unit);
    group_.put_text(variable, "long_name", description.long_name);
    if (!description.coordinates.empty()) group_.put_text(variable, "coordinates", description.coordinates);
    return variable;
}

void GroupWriter::write(int variable, void const* values) {
    auto const variables = group_.variables();
    auto const found =
        std::find_if(variables.begin(), variables.end(), [&](auto const& other) { return other.id == variable; });
    auto const& shape = found->shape;
    std::vector<std::size_t> const start(shape.size() + 1, 0);  // one more: never a null pointer
    group_.write(variable, std::span(start).first(shape.size()),
                 {shape.empty() ? start.data() : shape.data(), shape.size()}, values);
}

void GroupWriter::numbers(Description const& description, std::span<double const> values) {
    write(define(description, NetcdfFile::Type::float64), values.data());
}

void GroupWriter::counts(Description const& description, std::span<int const> values) {
    write(define(description, NetcdfFile::Type::int32), values.data());
}

}  // namespace slideway
