#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

Key const& read_parameter(Node const& root, Scene const& scene) {
    Node const* const node = root.find_path("study.parameter");
    if (node == nullptr) {
        refuse_missing(*root.find_path("study.kind"), "study.parameter", "a sweep changes one key",
                       "add parameter = \"joint.clearance\"");
    }
    std::string const& name = read_text_value(*node);
    Key const* const key = find_key(name);
    if (key == nullptr) refuse(*node, {"only numeric keys of the physics can be swept", key_advice(name)});
    check_varied(root, *node, *key, scene, {"the sweep sets it in every column, so this has no effect", "use --set 'study.values=[...]'"});
    return *key;
}

double read_end(Node const& root, std::string_view name, Key const& key) {
    Node const* const node = root.find_path(name);
    if (node == nullptr) {
        refuse_missing(*root.find_path("study.kind"), name, "a sweep needs its values",
                       "give study.values, or study.from, study.to and study.points");
    }
    return read_number(*node, key);
}

/// To 15 digits: the column at 0.1 mm then has the bits of a scene that says so.
double rounded(double value) { return parse_number<double>(fmt::format("{:.14e}", value)).value_or(value); }

std::vector<double> read_range(Node const& root, Key const& key) {
    double const from = read_end(root, "study.from", key), to = read_end(root, "study.to", key);
    Node const* const count = root.find_path("study.points");
    if (count == nullptr)
        refuse_missing(*root.find_path("study.kind"), "study.points", "how many columns there are", "add points = 50");
    std::uint64_t const points = read_count(*count, setting("study.points"));
    Node const& last = *root.find_path("study.to");
    if (from == to)
        refuse(last, with_unit(to, key.unit), {"equal to study.from", "use another value, or study.values"});
    bool logarithmic = false;
    read_given(root, "study.spacing", logarithmic);
    if (logarithmic && !(from * to > 0)) {
        refuse(*root.find_path("study.spacing"), {fmt::format("from {} to {} there is no common ratio", with_unit(from, key.unit), with_unit(to, key.unit)),
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
    if (key.name == "mechanism.crank_speed" && value == 0) {
        return Problem{"a crank at rest comes to no section", "leave the value out"};
    }
    auto const found = find_defect(inputs, parts);
    if (!found) return std::nullopt;
    return Problem{fmt::format("{} would be {}: {}", found->key->name, with_unit(found->value, found->key->unit),
                               found->problem.reason),
                   found->problem.advice};
}

void check_values(Node const& root, Scene const& scene) {
    Key const& key = *scene.chaos.parameter;
    auto const& values = scene.chaos.values;
    Node const* const list = root.find_path("study.values");
    auto const check = [&](Node const& node, double value) {
        auto const problem = broken_column(scene.inputs, scene.parts, key, value);
        if (problem) refuse(node, with_unit(value, key.unit), *problem);
    };
    if (list != nullptr) {
        for (std::size_t i = 0; i < values.size(); ++i) check(list->children[i], values[i]);
        return;
    }
    check(*root.find_path("study.from"), values.front());
    check(*root.find_path("study.to"), values.back());
    for (double const value : values) {
        if (auto const problem = broken_column(scene.inputs, scene.parts, key, value)) {
            refuse(*root.find_path("study.points"),
                   {fmt::format("one is {}: {}", with_unit(value, key.unit), problem->reason),
                    "use study.values, or other limits"});
        }
    }
}

}  // namespace

void read_sweep(Node const& root, Scene& scene) {
    Key const& key = read_parameter(root, scene);
    Node const* const list = root.find_path("study.values");
    scene.chaos.parameter = &key;
    scene.chaos.values = list != nullptr ? read_list(*list, key, setting("study.points").most, "[\"0.1 mm\", \"0.2 mm\"]") : read_range(root, key);
    require_part(scene.parts, key);
    check_values(root, scene);
    if (!scene.chaos.continued) return;
    Node const& start = *root.find_path("study.start");
    if (key.name.starts_with("initial.") || key.name == "mechanism.start_angle") {
        refuse(start, {fmt::format("{} is where a member starts, and columns start where the one before ended", key.name),
                       "use start = \"fresh\", or another parameter"});
    }
    Node const* const phase = root.find_path("study.phase");
    if (info(scene.parts.mechanism).drive == DriveKind::carriage && phase != nullptr && read_number(*phase, "rad") != 0)
        refuse(start, {"a carriage starts at phase 0, and columns would end at study.phase", "use start = \"fresh\", or phase = 0"});
}

void check_columns(Node const& root, Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    auto const whole = [](Span const& span) { return span.revolutions && span.value == std::floor(span.value); };
    if (!whole(chaos.span))
        refuse(*root.find_path("study.revolutions"), {"a sweep records whole revolutions", "use an integer"});
    if (!chaos.continued || whole(chaos.transient) || chaos.transient.value == 0) return;
    Node const* const time = root.find_path("study.Ttr");
    refuse(time != nullptr ? *time : *root.find_path("study.transient_revolutions"),
           {"with start = \"continue\" columns begin at the crank angle where the one before ended",
            "use a whole number of study.transient_revolutions"});
}

}  // namespace slideway
