#include "host/store/result_layout.hpp"

#include <algorithm>
#include <bit>

#include "host/run/block_buffers.hpp"

namespace slideway {

void add_columns(std::vector<QuantityColumn>& columns, OutputQuantity const& quantity) {
    QuantityColumn column;
    column.quantity = quantity.name;
    column.place = quantity.place;
    column.unit = quantity.unit;
    column.long_name = quantity.long_name;
    if (quantity.dimension == nullptr) return columns.push_back(column);
    column.dimension = quantity.dimension;
    for (std::string const& label : labels_of(column.dimension)) {
        column.label = label;
        columns.push_back(column);
        ++column.index;
        ++column.place;
    }
}

std::vector<QuantityColumn> columns_of(Mechanism mechanism, Selection quantities) {
    std::vector<QuantityColumn> columns;
    for (OutputQuantity const& quantity : selected(outputs_of(mechanism).quantities, quantities)) add_columns(columns, quantity);
    return columns;
}

QuantityColumn const* column_of(std::vector<QuantityColumn> const& columns, Limit const& limit) {
    auto const found =
        std::ranges::find_if(columns, [&](QuantityColumn const& column) { return column.quantity == limit.quantity && column.label == limit.label; });
    return found == columns.end() ? nullptr : &*found;
}

std::string variable_name(std::string_view key) {
    std::string name(key);
    std::ranges::replace(name, '.', '_');
    return name;
}

std::uint64_t payload_bytes(ResultLayout const& layout) {
    constexpr std::uint64_t end_time = 1;
    std::uint64_t columns = work_table.size() + end_time + layout.states() + layout.parameters.size();
    columns += columns_of(layout.mechanism, layout.quantities).size();
    std::uint64_t const samples = layout.sample_times.size();
    if (samples > 0) columns += static_cast<std::uint64_t>(std::popcount(layout.series)) * samples;
    if (layout.sections > 0) columns += layout.sections * section_columns(layout.states());
    std::uint64_t const counts = layout.sections > 0 ? 1 + layout.crossings : 0;  // of sections and of crossings
    for (StudyColumn const& column : layout.study.columns) columns += layout.study.width(column);
    std::uint64_t coordinates = samples;
    for (StudyAxis const& axis : layout.study.axes) coordinates += axis.values.size();
    constexpr std::uint64_t member_and_status = 5;
    return layout.members.count() * (member_and_status + counts * sizeof(std::int32_t) + columns * sizeof(double)) +
           coordinates * sizeof(double) + layout.members.count() * layout.label_width();
}

std::uint64_t header_bytes(ResultLayout const& layout, Provenance const& provenance) {
    // An object of HDF5 for each variable with its attributes, and what netCDF adds to every file.
    constexpr std::uint64_t of_variable = 1000, of_file = 16'000;
    std::uint64_t variables = 3 + work_table.size() + 1 + layout.states() + layout.parameters.size();
    variables += static_cast<std::uint64_t>(std::popcount(layout.quantities) + std::popcount(layout.series));
    variables += 2 * (layout.study.columns.size() + layout.study.axes.size());
    if (layout.sections > 0) variables += 2 + section_columns(layout.states());
    return of_file + variables * of_variable + provenance.scene.size() + provenance.maker.flags.size();
}

std::size_t StudyTable::width(StudyColumn const& column) const {
    std::size_t width = 1;
    for (std::string const& name : column.axes) width *= std::ranges::find(axes, name, &StudyAxis::name)->values.size();
    return width;
}

}  // namespace slideway
