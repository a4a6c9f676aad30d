#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// To 15 digits: the column at 0.1 mm then has the bits of a scene that says so.
double rounded(double value) { return parse_number<double>(fmt::format("{:.14e}", value)).value_or(value); }

std::vector<double> read_range(Reading const& reading, Key const& key) {
    Node const &first = *reading.given("study.from"), &last = *reading.given("study.to");
    double const from = read_number(first, key), to = read_number(last, key);
    std::uint64_t const points = read_count(*reading.given("study.points"), setting("study.points"));
    if (from == to) refuse(last, with_unit(to, key.unit), {"equal to study.from", "use another value, or study.values"});
    Node const* const spacing = reading.given("study.spacing");
    bool const logarithmic = spacing != nullptr && read_choice(*spacing, setting("study.spacing")) == 1;
    if (logarithmic && !(from * to > 0)) {
        refuse(*spacing, {fmt::format("from {} to {} there is no common ratio", with_unit(from, key.unit), with_unit(to, key.unit)),
                          "use ends of one sign, or \"linear\""});
    }
    std::vector<double> values(points);
    for (std::uint64_t i = 0; i < points; ++i) {
        double const part = static_cast<double>(i) / static_cast<double>(points - 1);
        values[i] = rounded(logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part);
    }
    values.front() = from;
    values.back() = to;
    return values;
}

/// Why a column cannot be run, if it is so.
std::optional<Problem> broken_column(Inputs inputs, Parts const& parts, Key const& key, double value) {
    key.set(inputs, value);
    if (key.name == "mechanism.crank_speed" && value == 0) return Problem{"a crank at rest comes to no section", "leave the value out"};
    auto const found = find_defect(inputs, parts);
    if (!found) return std::nullopt;
    return Problem{fmt::format("{} would be {}: {}", found->key->name, with_unit(found->value, found->key->unit), found->problem.reason),
                   found->problem.advice};
}

void check_values(Reading const& reading) {
    Scene const& scene = reading.scene;
    Key const& key = *scene.chaos.parameter;
    auto const& values = scene.chaos.values;
    Node const* const list = reading.given("study.values");
    for (std::size_t i = 0; i < values.size(); ++i) {
        auto const problem = broken_column(scene.inputs, scene.parts, key, values[i]);
        if (!problem) continue;
        std::string const shown = with_unit(values[i], key.unit);
        if (list != nullptr) refuse(list->children[i], shown, *problem);
        if (i == 0) refuse(*reading.given("study.from"), shown, *problem);
        if (i + 1 == values.size()) refuse(*reading.given("study.to"), shown, *problem);
        // An end that is wrong too says so first.
        if (auto const at_end = broken_column(scene.inputs, scene.parts, key, values.back()))
            refuse(*reading.given("study.to"), with_unit(values.back(), key.unit), *at_end);
        refuse(*reading.given("study.points"), {fmt::format("one is {}: {}", shown, problem->reason), "use study.values, or other limits"});
    }
}

}  // namespace

void read_sweep(Reading& reading) {
    Scene& scene = reading.scene;
    Node const& parameter = *reading.given("study.parameter");
    std::string const& name = read_text_value(parameter);
    Key const* const key = find_key(name, scene);
    if (key == nullptr) refuse_ungiven(parameter.where, name, scene);
    if (key == nullptr) refuse(parameter, {"only numeric keys of the physics can be swept", key_advice(name, scene)});
    check_varied(reading, parameter, *key, {"the sweep sets it in every column, so this has no effect", "use --set 'study.values=[...]'"});
    Node const* const list = reading.given("study.values");
    scene.chaos.parameter = key;
    scene.chaos.values = list != nullptr ? read_list(*list, *key, setting("study.points").most, "[\"0.1 mm\", \"0.2 mm\"]") : read_range(reading, *key);
    require_part(scene.parts, *key);
    check_values(reading);
}

}  // namespace slideway
