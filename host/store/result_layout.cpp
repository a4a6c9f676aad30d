#include "host/store/result_layout.hpp"

#include <algorithm>
#include <bit>

#include "host/run/block_result.hpp"

namespace slideway {

std::string variable_name(std::string_view key) {
    std::string name(key);
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

std::uint64_t payload_bytes(ResultLayout const& layout) {
    constexpr std::uint64_t end_time = 1;
    std::uint64_t columns = work_table.size() + end_time + layout.states() + layout.parameters.size();
    for (int q = 0; q < quantity_count; ++q) {
        if (selects(layout.quantities, static_cast<Quantity>(q)))
            columns += static_cast<std::uint64_t>(quantity_table[q].columns);
    }
    std::uint64_t const samples = layout.sample_times.size();
    if (samples > 0) columns += static_cast<std::uint64_t>(std::popcount(layout.series)) * samples;
    if (layout.sections > 0) columns += layout.sections * section_columns(layout.states());
    std::uint64_t const counts = layout.sections > 0 ? 1 + layout.crossings : 0;  // of sections and of crossings
    for (StudyColumn const& column : layout.study.columns) columns += layout.study.width(column);
    std::uint64_t coordinates = samples;
    for (StudyAxis const& axis : layout.study.axes) coordinates += axis.values.size();
    constexpr std::uint64_t member_and_status = 5;
    return layout.members.count() * (member_and_status + counts * sizeof(std::int32_t) + columns * sizeof(double)) +
           coordinates * sizeof(double);
}

std::uint64_t header_bytes(ResultLayout const& layout, Provenance const& provenance) {
    // An object of HDF5 for each variable with its attributes, and what netCDF adds to every file.
    constexpr std::uint64_t of_variable = 1000, of_file = 16'000;
    std::uint64_t variables = 3 + work_table.size() + 1 + layout.states() + layout.parameters.size();
    variables += static_cast<std::uint64_t>(std::popcount(layout.quantities) + std::popcount(layout.series));
    variables += 2 * (layout.study.columns.size() + layout.study.axes.size());
    if (layout.sections > 0) variables += 2 + section_columns(layout.states());
    return of_file + variables * of_variable + provenance.scene.size() + provenance.flags.size();
}

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
