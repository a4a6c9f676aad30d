#include "host/store/result_view.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

template <class T> std::vector<double> read_as(DataFile const& file, DataFile::Variable const& variable) {
    std::vector<T> const values = file.read<T>(variable);
    return {values.begin(), values.end()};
}

/// As text, also a number.
std::string attribute_text(DataFile const& file, std::string const& attribute) {
    double number = 0;
    if (file.number(DataFile::global, attribute, number)) return fmt::format("{}", number);
    return file.text(DataFile::global, attribute);
}

}  // namespace

ResultView::ResultView(DataFile const& file) : file_(&file), variables_(file.variables()) {
    std::string const name = stores_members() ? "status" : "status_count";
    if (!has(name) || shape(name).size() != 1) throw FileError(file.path() + ": is a netCDF file, but not a result of slideway");
}

DataFile::Variable const& ResultView::find(std::string const& variable) const {
    auto const found = std::ranges::find(variables_, variable, &DataFile::Variable::name);
    if (found == variables_.end()) throw FileError(fmt::format("{}: has no variable {}", file_->path(), variable));
    return *found;
}

std::string ResultView::attribute(std::string const& name) const { return attribute_text(*file_, name); }

std::string ResultView::group_attribute(std::string const& group, std::string const& name) const {
    if (!file_->has_group(group)) return {};
    return attribute_text(*file_->group(group), name);
}

bool ResultView::has(std::string const& variable) const { return std::ranges::count(variables_, variable, &DataFile::Variable::name) > 0; }

std::vector<std::string> ResultView::variable_names() const {
    std::vector<std::string> names;
    for (DataFile::Variable const& variable : variables_) names.push_back(variable.name);
    return names;
}

std::string ResultView::unit(std::string const& variable) const { return file_->text(find(variable).id, "units"); }

std::string ResultView::long_name(std::string const& variable) const { return file_->text(find(variable).id, "long_name"); }

std::vector<std::size_t> ResultView::shape(std::string const& variable) const { return find(variable).shape; }

std::vector<double> ResultView::values(std::string const& variable) const {
    DataFile::Variable const& found = find(variable);
    if (found.type == DataFile::Type::int8) return read_as<signed char>(*file_, found);
    if (found.type == DataFile::Type::int32) return read_as<int>(*file_, found);
    if (found.type == DataFile::Type::float64) return file_->read<double>(found);
    throw FileError(fmt::format("{}: {} is no number", file_->path(), variable));
}

std::vector<double> ResultView::values(std::string const& variable, std::size_t count) const {
    std::vector<double> found = values(variable);
    if (found.size() == count) return found;
    throw FileError(fmt::format("{}: is damaged ({} has {} values in place of {}); run the study again", file_->path(), variable, found.size(), count));
}

std::vector<double> ResultView::column(std::string const& variable, std::size_t index) const {
    DataFile::Variable const& found = find(variable);
    std::size_t const rank = found.shape.size();
    if (found.type != DataFile::Type::float64 || rank < 1 || rank > 2 || index >= (rank == 2 ? found.shape[1] : 1)) {
        throw FileError(fmt::format("{}: {} has no column {}", file_->path(), variable, index));
    }
    std::vector<double> values(found.shape[0]);
    std::size_t const start[2] = {0, index}, count[2] = {found.shape[0], 1};
    if (!values.empty()) file_->read(found.id, {start, rank}, {count, rank}, values.data());
    return values;
}

ResultReader::ResultReader(std::string const& path) : OpenResult{NetcdfFile::open(path)}, ResultView(file) {
    format_of(file);
    if (stored_hash().empty()) throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
}

}  // namespace slideway
