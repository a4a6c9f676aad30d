#include "host/output/study_columns.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace slideway {

std::vector<std::size_t> StudyTable::shape(StudyColumn const& column) const {
    std::vector<std::size_t> lengths;
    for (std::string const& name : column.axes) {
        auto const axis = std::find_if(axes.begin(), axes.end(), [&](StudyAxis const& a) { return a.name == name; });
        lengths.push_back(axis->values.size());
    }
    return lengths;
}

std::size_t StudyTable::width(StudyColumn const& column) const {
    std::size_t width = 1;
    for (std::size_t const length : shape(column)) width *= length;
    return width;
}

void StudyColumnWriter::define(NetcdfFile& file, int member_dimension) {
    std::map<std::string, int> dimensions;
    auto const describe = [&](int variable, auto const& entry) {
        file.put_text(variable, "units", entry.unit);
        file.put_text(variable, "long_name", entry.long_name);
    };
    for (StudyAxis const& axis : table_.axes) {
        int const dimension = file.add_dimension(axis.name, axis.values.size());
        dimensions[axis.name] = dimension;
        axes_.push_back(file.add_variable(axis.name, NetcdfFile::Type::float64, std::array{dimension}));
        describe(axes_.back(), axis);
    }
    for (StudyColumn const& column : table_.columns) {
        std::vector<int> shape{member_dimension};
        for (std::string const& axis : column.axes) shape.push_back(dimensions.at(axis));
        columns_.push_back(file.add_variable(column.name, NetcdfFile::Type::float64, shape, true));
        describe(columns_.back(), column);
    }
}

bool StudyColumnWriter::is_axis(int variable) const {
    return std::find(axes_.begin(), axes_.end(), variable) != axes_.end();
}

void StudyColumnWriter::write_axes(NetcdfFile& file) const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        auto const& values = table_.axes[i].values;
        file.write(axes_[i], std::array{std::size_t{0}}, std::array{values.size()}, values.data());
    }
}

void StudyColumnWriter::write(NetcdfFile& file, std::size_t first, std::size_t members,
                              StudyValues const& values) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        std::vector<std::size_t> count = table_.shape(table_.columns[i]);
        count.insert(count.begin(), members);
        std::vector<std::size_t> start(count.size(), 0);
        start[0] = first;
        file.write(columns_[i], start, count, values[i].data());
    }
}

}  // namespace slideway
