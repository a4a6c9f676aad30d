#include "host/output/result_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/output/payload_hash.hpp"
#include "host/scene/error.hpp"

namespace slideway {
namespace {

template <class T> std::vector<double> read_as(NetcdfFile const& file, NetcdfFile::Variable const& variable) {
    std::vector<T> values(variable.size());
    std::vector<std::size_t> const start(variable.shape.size(), 0);
    if (!values.empty()) file.read(variable.id, start, variable.shape, values.data());
    return {values.begin(), values.end()};
}

}  // namespace

ResultReader::ResultReader(std::string const& path) : file_(NetcdfFile::open(path)), variables_(file_.variables()) {
    auto const is_status = [](NetcdfFile::Variable const& variable) {
        return variable.name == "status" && variable.shape.size() == 1;
    };
    if (!std::any_of(variables_.begin(), variables_.end(), is_status)) {
        throw FileError(path + ": is a netCDF file, but not a result of slideway");
    }
    if (stored_hash().empty()) {
        throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
    }
}

NetcdfFile::Variable const& ResultReader::find(std::string const& variable) const {
    auto const found = std::find_if(variables_.begin(), variables_.end(),
                                    [&](NetcdfFile::Variable const& candidate) { return candidate.name == variable; });
    if (found == variables_.end()) throw FileError(fmt::format("{}: has no variable {}", file_.path(), variable));
    return *found;
}

std::string ResultReader::attribute(std::string const& name) const {
    double number = 0;
    if (file_.number(NetcdfFile::global, name, number)) return fmt::format("{}", number);
    return file_.text(NetcdfFile::global, name);
}

bool ResultReader::has(std::string const& variable) const {
    return std::any_of(variables_.begin(), variables_.end(),
                       [&](NetcdfFile::Variable const& candidate) { return candidate.name == variable; });
}

std::vector<std::string> ResultReader::variable_names() const {
    std::vector<std::string> names;
    for (NetcdfFile::Variable const& variable : variables_) names.push_back(variable.name);
    return names;
}

std::string ResultReader::unit(std::string const& variable) const { return file_.text(find(variable).id, "units"); }

std::string ResultReader::long_name(std::string const& variable) const {
    return file_.text(find(variable).id, "long_name");
}

std::vector<std::size_t> ResultReader::shape(std::string const& variable) const { return find(variable).shape; }

std::vector<double> ResultReader::values(std::string const& variable) const {
    NetcdfFile::Variable const& found = find(variable);
    switch (found.type) {
        case NetcdfFile::Type::int8:
            return read_as<signed char>(file_, found);
        case NetcdfFile::Type::int32:
            return read_as<int>(file_, found);
        case NetcdfFile::Type::float64:
            return read_as<double>(file_, found);
        case NetcdfFile::Type::text:
            break;
    }
    throw FileError(fmt::format("{}: {} is no number", file_.path(), variable));
}

std::string ResultReader::computed_hash() const { return payload_hash(file_); }

}  // namespace slideway
