#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

struct LimitedQuantity {
    std::size_t place;  // among the outputs of the mechanism
    std::string label;
};

[[noreturn]] void refuse_name(Node const& node, std::string const& why, std::string const& advice) {
    refuse_that(node, "cannot be limited", {why, advice});
}

/// Of "mode_time[free]" or "peak_normal_force".
LimitedQuantity read_name(Node const& node, Scene const& scene) {
    std::string_view const name = node.key;
    auto const bracket = name.find('[');
    std::string_view const quantity = name.substr(0, bracket);
    std::vector<std::string_view> names;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (QuantityInfo const& info : outputs.quantities) names.emplace_back(info.name);
    auto const found = std::find(names.begin(), names.end(), quantity);
    if (found == names.end()) {
        auto const of_series = [&](SeriesInfo const& info) { return quantity == info.name; };
        bool const series = std::ranges::any_of(outputs.series, of_series);
        refuse_name(node, series ? "it is a time series" : "there is no such quantity",
                    series ? std::string("limit a quantity, see `slideway list`") : choice_advice(quantity, names));
    }
    auto const limited = static_cast<std::size_t>(found - names.begin());
    if ((outputs.has_quantities >> limited & 1u) == 0) refuse_foreign_quantity(node, quantity, scene.parts.mechanism);
    if (auto const why = why_unknown(static_cast<Quantity>(limited), scene)) refuse_name(node, why->reason, why->advice);
    QuantityInfo const& info = outputs.quantities[limited];
    if (info.dimension == nullptr) {
        if (bracket != name.npos) refuse_name(node, "it is one number", fmt::format("write \"{}\"", quantity));
        return {limited, {}};
    }
    auto const labels = labels_of(info.dimension);
    std::string const advice =
        fmt::format("write \"{}[{}]\", one of {}", quantity, labels.front(), fmt::join(labels, ", "));
    if (bracket == name.npos) refuse_name(node, fmt::format("it has a value for each {}", info.dimension), advice);
    std::string_view label = name.substr(bracket + 1);
    bool const closed = label.ends_with(']');
    if (closed) label.remove_suffix(1);
    if (!closed || std::find(labels.begin(), labels.end(), label) == labels.end()) {
        refuse_name(node, fmt::format("there is no such {}", info.dimension), advice);
    }
    return {limited, std::string(label)};
}

Limit read_limit(Node const& node, QuantityInfo const& info, LimitedQuantity const& limited) {
    constexpr std::string_view example = "{ min = 0, max = 1 }, or one of the two";
    if (!node.is_table()) refuse(node, {"not a limit", fmt::format("write for example {}", example)});
    check_arguments(node, "limit", {"min", "max"});
    Node const *const low = node.find("min"), *const high = node.find("max");
    if (low == nullptr && high == nullptr)
        refuse_that(node, "has neither min nor max", {"it would be met always", fmt::format("write for example {}", example)});
    Limit limit{info.name, limited.label};
    if (low != nullptr) limit.low = read_number(*low, info.unit);
    if (high != nullptr) limit.high = read_number(*high, info.unit);
    if (limit.low > limit.high) {
        refuse(*high, with_unit(limit.high, info.unit),
               {fmt::format("below min, {}", with_unit(limit.low, info.unit)), "use min <= max"});
    }
    return limit;
}

}  // namespace

void read_limits(Node const& root, Scene& scene) {
    Node const* const table = root.find_path("study.limits");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.limits] and its quantities below"});
    for (Node const& node : table->children) {
        LimitedQuantity const limited = read_name(node, scene);
        scene.limits.push_back(read_limit(node, outputs_of(scene.parts.mechanism).quantities[limited.place], limited));
        scene.quantities |= Selection{1} << limited.place;
    }
}

}  // namespace slideway
