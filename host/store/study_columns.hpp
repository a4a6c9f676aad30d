// What a study concludes of its members, as further variables of the result file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slideway {

/// A dimension of its own with the values along it.
struct StudyAxis {
    std::string name;
    std::string unit;
    std::string long_name;
    std::vector<double> values;
};

/// One value, or a row of values along axes, per member.
struct StudyColumn {
    std::string name;
    std::string unit;
    std::string long_name;
    std::vector<std::string> axes;  // names of StudyAxis, slowest first
};

struct StudyTable {
    std::vector<StudyAxis> axes;
    std::vector<StudyColumn> columns;

    /// Lengths of a column's axes.
    std::vector<std::size_t> shape(StudyColumn const& column) const;
    /// Values of a column per member.
    std::size_t width(StudyColumn const& column) const;
};

/// Values of a table's columns for the members of one block: [column][members × width].
using StudyValues = std::vector<std::vector<double>>;

}  // namespace slideway
