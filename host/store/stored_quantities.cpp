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
        bool const is_variable = results.has(names[i]);
        auto const* const known = std::ranges::find(quantity_table, std::string_view(names[i]), [](QuantityInfo const& one) { return std::string_view(one.name); });
        bool const is_of_table = known != std::end(quantity_table);
        std::string const unit = is_variable ? results.unit(names[i]) : i < units.size() ? units[i] : is_of_table ? known->unit : "1";
        std::string const words = is_variable ? results.long_name(names[i]) : is_of_table ? known->long_name : names[i];
        OutputQuantity quantity{is_of_table ? *known : QuantityInfo{names[i].c_str(), Statistic::at_end, Keeper::signals, "", 1, nullptr, ""}, 0};
        quantity.unit = unit.c_str();
        quantity.long_name = words.c_str();
        add_columns(columns, quantity);
    }
    return columns;
}

}  // namespace slideway
