#include "host/store/group_writer.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

constexpr std::size_t label_length = 8;  // of LabelAxes: "surface" and room for one more letter

void write_texts(DataFile& file, int variable, std::vector<std::string> const& texts, std::size_t width) {
    std::vector<char> letters(texts.size() * width, '\0');
    for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(letters.data() + i * width, width);
    file.write(variable, letters.data());
}

}  // namespace

int define_texts(DataFile& file, std::string const& name, std::array<int, 2> const& dimensions, std::string const& long_name) {
    int const variable = file.add_variable(name, DataFile::Type::text, dimensions);
    file.put(variable, "long_name", long_name);
    file.put(variable, "_Encoding", "utf-8");  // readers then give strings, not bytes
    return variable;
}

void GroupWriter::labels(std::string const& name, std::string const& long_name, std::vector<std::string> const& labels) {
    file_.add_dimension(name, labels.size());
    texts(name, name, long_name, labels);
}

void GroupWriter::texts(std::string const& name, std::string const& dimension, std::string const& long_name, std::vector<std::string> const& texts) {
    std::size_t width = 1;
    for (std::string const& text : texts) width = std::max(width, text.size());
    std::array const dimensions{file_.dimension(dimension), file_.add_dimension(name + "_length", width)};
    write_texts(file_, define_texts(file_, name + "_name", dimensions, long_name), texts, width);
}

int GroupWriter::define(Description const& description, DataFile::Type type) {
    std::vector<int> dimensions;
    for (std::string const& name : description.dimensions) dimensions.push_back(file_.dimension(name));
    int const variable = file_.add_variable(description.name, type, dimensions);
    if (!description.unit.empty()) file_.put(variable, "units", description.unit);
    file_.put(variable, "long_name", description.long_name);
    if (!description.coordinates.empty()) file_.put(variable, "coordinates", description.coordinates);
    return variable;
}

LabelAxes::Axis const& LabelAxes::axis(std::string const& name) {
    auto const [found, is_new] = axes_.try_emplace(name);
    if (!is_new) return found->second;
    if (label_dimension_ < 0) label_dimension_ = file_.add_dimension("label_length", label_length);
    std::vector<std::string> labels = labels_of(name);
    found->second = {file_.add_dimension(name, labels.size()), name + "_name"};
    int const variable = define_texts(file_, found->second.label_name, {found->second.dimension, label_dimension_}, fmt::format("label along {}", name));
    labels_.emplace_back(variable, std::move(labels));
    return found->second;
}

void LabelAxes::write() const {
    for (auto const& [variable, labels] : labels_) write_texts(file_, variable, labels, label_length);
}

}  // namespace slideway
