#include "host/store/stored_quantities.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace slideway {
namespace {

std::vector<std::string> parts_of(std::string const& text, std::string_view between) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < text.size();) {
        std::size_t const to = std::min(text.find(between, from), text.size());
        parts.push_back(text.substr(from, to - from));
        from = to + between.size();
    }
    return parts;
}

std::vector<std::string> stored_names(ResultView const& results) {
    std::vector<std::string> names = parts_of(results.attribute("quantities"), " ");
    bool const are_variables = results.stores_members();
    // Earlier versions did not say, and knew those of the table alone.
    if (names.empty() && are_variables) {
        for (QuantityInfo const& quantity : quantity_table) names.emplace_back(quantity.name);
    }
    if (are_variables) std::erase_if(names, [&](std::string const& name) { return !results.has(name); });
    return names;
}

}  // namespace

std::vector<QuantityColumn> stored_columns(ResultView const& results) {
    std::vector<std::string> const names = stored_names(results), units = parts_of(results.attribute("quantity_units"), ", ");
    std::vector<QuantityColumn> columns;
    for (std::size_t i = 0; i < names.size(); ++i) {
        auto const* const known = std::ranges::find_if(quantity_table, [&](QuantityInfo const& one) { return names[i] == one.name; });
        QuantityColumn column{names[i], "", "", 0, 0, "1", names[i]};
        if (known != std::end(quantity_table))
            column = {names[i], known->dimension != nullptr ? known->dimension : "", "", 0, 0, known->unit, known->long_name};
        if (i < units.size()) column.unit = units[i];
        if (results.has(names[i])) column.unit = results.unit(names[i]), column.long_name = results.long_name(names[i]);
        add_columns(columns, std::move(column));
    }
    return columns;
}

}  // namespace slideway
