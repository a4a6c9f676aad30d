#include "host/store/study_columns.hpp"

#include <algorithm>

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

}  // namespace slideway
