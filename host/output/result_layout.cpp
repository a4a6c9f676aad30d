#include "host/output/result_layout.hpp"

#include <algorithm>
#include <bit>

#include "host/driver/block_result.hpp"

namespace slideway {

std::string variable_name(std::string_view key) {
    std::string name(key);
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

std::uint64_t payload_bytes(ResultLayout const& layout) {
    std::uint64_t columns = 4 + state_size + layout.parameters.size();  // three counters and end_time
    for (int q = 0; q < quantity_count; ++q) {
        if (selects(layout.quantities, static_cast<Quantity>(q)))
            columns += static_cast<std::uint64_t>(quantity_table[q].columns);
    }
    std::uint64_t const samples = layout.sample_times.size();
    if (samples > 0) columns += static_cast<std::uint64_t>(std::popcount(layout.series)) * samples;
    if (layout.sections > 0) columns += 1 + layout.sections * section_columns;
    for (StudyColumn const& column : layout.study.columns) columns += layout.study.width(column);
    std::uint64_t coordinates = samples;
    for (StudyAxis const& axis : layout.study.axes) coordinates += axis.values.size();
    constexpr std::uint64_t member_and_status = 5;
    return layout.members.count() * (member_and_status + columns * sizeof(double)) + coordinates * sizeof(double);
}

}  // namespace slideway
