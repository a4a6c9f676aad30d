#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/outputs.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

[[noreturn]] void refuse_name(Node const& node, std::string const& why, std::string const& advice) { refuse_that(node, "cannot be limited", {why, advice}); }

/// Of "mode_time[free]" or "peak_normal_force": its place among the outputs of the mechanism, and the label.
std::pair<std::size_t, std::string> read_name(Reading& reading, Node const& node) {
    Scene const& scene = reading.scene;
    std::string_view const name = node.key;
    auto const bracket = name.find('[');
    std::string_view const quantity = reading.named_now(node, name.substr(0, bracket));
    std::vector<std::string_view> names;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (QuantityInfo const& info : outputs.quantities) names.emplace_back(info.name);
    auto const found = std::ranges::find(names, quantity);
    if (found == names.end()) {
        if (std::ranges::any_of(outputs.series, [&](SeriesInfo const& info) { return quantity == info.name; }))
            refuse_name(node, "it is a time series", "limit a quantity, see `slideway list`");
        refuse_name(node, "there is no such quantity", choice_advice(quantity, names));
    }
    auto const place = static_cast<std::size_t>(found - names.begin());
    if ((outputs.has_quantities >> place & 1u) == 0) refuse_foreign_quantity(node, quantity, scene.parts.mechanism);
    if (auto const why = why_unknown(static_cast<Quantity>(place), scene)) refuse_name(node, why->reason, why->advice);
    QuantityInfo const& info = outputs.quantities[place];
    if (info.dimension == nullptr) {
        if (bracket != name.npos) refuse_name(node, "it is one number", fmt::format("write \"{}\"", quantity));
        return {place, {}};
    }
    auto const labels = labels_of(info.dimension);
    std::string const advice = fmt::format("write \"{}[{}]\", one of {}", quantity, labels.front(), fmt::join(labels, ", "));
    if (bracket == name.npos) refuse_name(node, fmt::format("it has a value for each {}", info.dimension), advice);
    std::string_view label = name.substr(bracket + 1);
    bool const closed = label.ends_with(']');
    if (closed) label.remove_suffix(1);
    if (!closed || std::ranges::find(labels, label) == labels.end()) refuse_name(node, fmt::format("there is no such {}", info.dimension), advice);
    return {place, std::string(label)};
}

Limit read_limit(Node const& node, QuantityInfo const& info, std::string label) {
    std::string const example = "write for example { min = 0, max = 1 }, or one of the two";
    if (!node.is_table()) refuse(node, {"not a limit", example});
    check_arguments(node, "limit", {"min", "max"});
    Node const *const low = node.find("min"), *const high = node.find("max");
    if (low == nullptr && high == nullptr) refuse_that(node, "has neither min nor max", {"it would be met always", example});
    Limit limit{info.name, std::move(label)};
    if (low != nullptr) limit.low = read_number(*low, info.unit);
    if (high != nullptr) limit.high = read_number(*high, info.unit);
    if (limit.low > limit.high)
        refuse(*high, with_unit(limit.high, info.unit), {fmt::format("below min, {}", with_unit(limit.low, info.unit)), "use min <= max"});
    return limit;
}

}  // namespace

void read_limits(Reading& reading) {
    Node const* const table = reading.given("study.limits");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.limits] and its quantities below"});
    Scene& scene = reading.scene;
    for (Node const& node : table->children) {
        auto const [place, label] = read_name(reading, node);
        QuantityInfo const& quantity = outputs_of(scene.parts.mechanism).quantities[place];
        auto const is_of_same = [&](Limit const& other) { return other.quantity == quantity.name && other.label == label; };
        if (std::ranges::any_of(scene.limits, is_of_same)) refuse_name(node, fmt::format("{} is limited already", quantity.name), "remove one of the two");
        scene.limits.push_back(read_limit(node, quantity, label));
        scene.quantities |= Selection{1} << place;
    }
}

}  // namespace slideway
