// What numbers usually are: who writes others mostly means another unit.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/config/keys.hpp"
#include "host/config/reader.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

/// By the first row whose name a key's begins with, and whose unit is the key's; no row: any number is usual.
constexpr struct {
    std::string_view name, unit;
    double low, high;
} usual_rows[] = {
    {"joint.clearance", "m", 1e-8, 1e-2},
    {"joint.wall", "m", 0, 1},
    {"contact.edge_radius", "m", 1e-7, 1},
    {"contact.apex_radius", "m", 1e-7, 1},
    {"way.offset", "m", 0, 0.1},
    {"slider.", "m", 0, 1},
    {"mechanism.", "m", 1e-4, 10},
    {"joint.", "m", 1e-4, 10},
    {"mechanism.start_angle", "rad", 0, 10},
    {"initial.", "rad", 0, 0.5},
    {"way.", "rad", 0, 0.5},
    {"mechanism.carriage_speed", "m/s", 1e-6, 1000},
    {"initial.", "m/s", 0, 1000},
    {"friction.", "m/s", 1e-8, 10},
    {"", "rad/s", 0, 1e4},
    {"", "m/s2", 0, 1000},
    {"mechanism.reversal_time", "s", 1e-5, 1000},
    {"", "m2", 1e-8, 1},
    {"", "kg", 1e-6, 1e5},
    {"", "kg m2", 0, 1e6},
    {"", "kg/m3", 10, 3e4},
    {"film.", "Pa", 0, 1e7},
    {"", "Pa", 1e5, 1e13},
    {"contact.point_stiffness", "1", 1e2, 1e16},
    {"contact.eta", "1", 0, 10},
    {"contact.chi_", "s/m", 0, 1e4},
    {"contact.", "N/m", 10, 1e13},
    {"contact.", "N/m3", 1e6, 1e18},
    {"contact.", "N s/m", 0, 1e8},
    {"friction.", "1", 0, 3},
};

/// Units in which people think, where scenes have SI.
constexpr struct {
    std::string_view si, meant;
    double factor;
} slips[] = {
    {"m", "mm", 1e-3},   {"m", "um", 1e-6},      {"rad", "deg", 0.017453292519943295},      {"m/s", "mm/s", 1e-3}, {"rad/s", "rpm", 0.10471975511965977},
    {"m/s2", "mm/s2", 1e-3}, {"m2", "mm2", 1e-6}, {"s", "ms", 1e-3}, {"kg", "g", 1e-3},  {"kg/m3", "g/cm3", 1e3}, {"Pa", "GPa", 1e9}, {"Pa", "MPa", 1e6}, {"N/m", "N/mm", 1e3},
};

/// "; did you mean \"1 mm\"?", if the number is usual in another unit.
std::string proposal(Key const& key, double value) {
    for (auto const& slip : slips) {
        if (slip.si != key.unit || !usual_range(key).contains(std::abs(value) * slip.factor)) continue;
        return fmt::format("; did you mean \"{} {}\"?", value, slip.meant);
    }
    return "; is its unit right?";
}

}  // namespace

Range usual_range(Key const& key) {
    auto const row = std::ranges::find_if(usual_rows, [&](auto const& one) { return key.name.starts_with(one.name) && key.unit == one.unit; });
    return row == std::end(usual_rows) ? Range{} : Range{row->low, row->high};
}

std::optional<std::string> unusual(Key const& key, double value, bool has_unit) {
    Range const usual = usual_range(key);
    // Who writes degrees means them; an angle may have any turns.
    if (!std::isfinite(usual.high) || usual.contains(std::abs(value)) || (has_unit && key.unit == "rad")) return {};
    std::string const unit = key.unit == "1" ? "" : fmt::format(" {}", key.unit);
    std::string const usually = usual.low > 0                           ? fmt::format("{:g} to {:g}{}", usual.low, usual.high, unit)
                                : std::isfinite(range_of(key.rule).low) ? fmt::format("up to {:g}{}", usual.high, unit)
                                                                        : fmt::format("within ±{:g}{}", usual.high, unit);
    return fmt::format("is {} (usually {}){}", with_unit(value, key.unit), usually, has_unit ? "; is it meant?" : proposal(key, value));
}

std::optional<std::pair<Key const*, std::string>> unusual_pair(Inputs const& inputs, Parts const& parts) {
    Inputs const in = complete_inputs(inputs, info(parts.mechanism));
    bool const spatial = info(parts.mechanism).spatial;
    double const smallest = spatial ? std::min(in.way_width, in.way_depth) : std::min(in.slider_height, in.slider_length);
    static Key const* const clearances[] = {find_key("joint.clearance_y"),       find_key("joint.clearance_z"),      find_key("joint.clearance_y_plus"),
                                            find_key("joint.clearance_y_minus"), find_key("joint.clearance_z_plus"), find_key("joint.clearance_z_minus")};
    for (Key const* const one : clearances) {
        Key const& key = *one;
        double const clearance = key.get(in);
        if (!counts_for(key, parts) || !(clearance > smallest / 10)) continue;
        return std::pair{&key, fmt::format("is {} (usually less than a tenth of the {}, {:.4g} m); is its unit right?", with_unit(clearance, key.unit),
                                             spatial ? "way" : "slider", smallest / 10)};
    }
    static Key const* const inertias[] = {find_key("mechanism.slider_inertia_x"), find_key("mechanism.slider_inertia_y"), find_key("mechanism.slider_inertia_z")};
    for (Key const* const one : inertias) {
        double const own = one->get(in), others = (inertias[0]->get(in) + inertias[1]->get(in) + inertias[2]->get(in)) - own;
        if (!spatial || !(own > others * (1 + 1e-9))) continue;
        return std::pair{one, fmt::format("is {} (a rigid body has at most the sum of the other two, {:.4g} {})", with_unit(own, one->unit), others, one->unit)};
    }
    static Key const& kinetic = *find_key("friction.kinetic");
    if (parts.friction && in.friction_kinetic > in.friction_static)
        return std::pair{&kinetic, fmt::format("is {:g} (usually not above friction.static, {:g}); give both", in.friction_kinetic, in.friction_static)};
    constexpr double fastest = 1000;  // [m/s]
    static Key const& turning = *find_key("mechanism.crank_speed");
    double const speed = std::abs(in.crank_speed) * in.crank_length;
    if (!counts_for(turning, parts) || !(speed > fastest)) return {};
    return std::pair{&turning, fmt::format("is {} (the crank pin then moves at {:.4g} m/s, usually up to {} m/s); is its unit right?",
                                             with_unit(in.crank_speed, turning.unit), speed, fastest)};
}

// Warnings of numbers that may be right, and are likelier slips of a unit.

namespace {

/// Numbers that stand for what a distribution draws: its ends, or its middle where it has no ends.
std::vector<double> numbers_of(Distribution const& d) {
    switch (d.kind) {
        case Distribution::Kind::uniform:
        case Distribution::Kind::triangular: return {d.high, d.low};
        case Distribution::Kind::truncated_normal: return {std::clamp(d.mean, d.low, d.high)};
        case Distribution::Kind::weibull: return {d.low + d.scale};
        case Distribution::Kind::values: return d.list;
        case Distribution::Kind::constant:
        case Distribution::Kind::normal:
        case Distribution::Kind::lognormal: break;
    }
    return {d.mean};
}

/// Keys that a warning has named: one for each, whatever says more of it.
using Told = std::vector<Key const*>;

void warn(Reading& reading, Told& told, std::string_view where, std::string_view name, Key const& key, std::string_view words) {
    told.push_back(&key);
    reading.warn(fmt::format("{}: {} {}", where, name, words));
}

/// @param where the number stands  @param name of it  @param has_unit it was written with its unit  @return whether it is unusual
bool check(Reading& reading, Told& told, std::string_view where, std::string_view name, Key const& key, double value, bool has_unit = false) {
    auto const words = unusual(key, value, has_unit);
    if (words) warn(reading, told, where, name, key, *words);
    return words.has_value();
}

/// Of numbers together, where none of them is unusual alone.  @param where "": where the scene gives the key
bool check_pair(Reading& reading, Told& told, std::string where, Inputs const& inputs) {
    Parts parts = reading.scene.parts;
    if (reading.scene.integrator.method == Method::moreau_jean) parts.friction = false;  // it has one coefficient
    auto const found = unusual_pair(inputs, parts);
    if (!found) return false;
    Key const& key = *found->first;
    if (std::ranges::any_of(told, [&](Key const* other) { return other->overlaps(key); })) return true;
    if (where.empty()) {
        where = reading.root.where;
        for (GivenKey const& given : given_keys(reading)) {
            if (given.key->overlaps(key)) where = given.node->where;
        }
    }
    warn(reading, told, where, key.name, key, found->second);
    return true;
}

void check_given(Reading& reading, Told& told) {
    Scene const& scene = reading.scene;
    auto const given = given_keys(reading);
    for (auto one = given.begin(); one != given.end(); ++one) {
        auto const replaced = [&](GivenKey const& later) { return later.key->overlaps(*one->key); };
        auto const varied = [&](Variation const& variation) { return variation.key->overlaps(*one->key); };
        if (!counts_for(*one->key, scene.parts) || std::any_of(one + 1, given.end(), replaced) || std::ranges::any_of(scene.variations, varied)) continue;
        check(reading, told, one->node->where, one->node->name, *one->key, one->key->get(scene.inputs), one->node->type == Node::Type::text);
    }
}

/// @param typical inputs that get the first number of each distribution
void check_drawn(Reading& reading, Told& told, Inputs& typical) {
    auto const nodes = varied_nodes(reading.root);
    for (std::size_t i = 0; i < nodes.size() && i < reading.scene.variations.size(); ++i) {
        Variation const& variation = reading.scene.variations[i];
        std::vector<double> const numbers = numbers_of(variation.distribution);
        variation.key->set(typical, numbers.front());
        std::string const name = fmt::format("a value of {}", nodes[i]->name);
        std::ranges::any_of(numbers, [&](double number) { return check(reading, told, nodes[i]->where, name, *variation.key, number); });
    }
}

void check_swept(Reading& reading, Told& told, Inputs typical) {
    Node const& node = *reading.given_of({"study.values", "study.to"});
    Key const& key = *reading.scene.chaos.parameter;
    for (double const value : reading.scene.chaos.values) {
        key.set(typical, value);
        if (check(reading, told, node.where, fmt::format("a value of {}", key.name), key, value) || check_pair(reading, told, node.where, typical)) return;
    }
}

void check_rows(Reading& reading, Told& told, Inputs const& typical) {
    MemberTable const& table = *reading.scene.design.table;
    std::vector<Variation> left;  // columns that were usual so far
    std::ranges::copy_if(reading.scene.variations, std::back_inserter(left), [](Variation const& one) { return one.column != Variation::no_column; });
    std::vector<Variation> const columns = left;
    bool pair = false;
    for (std::size_t row = 0; row < table.rows() && !(left.empty() && pair); ++row) {
        Inputs inputs = typical;
        auto const where = [&] { return fmt::format("{}:{}", table.name, table.lines[row]); };
        auto const value_of = [&](Variation const& one) { return table.values[row * table.columns + one.column]; };
        for (Variation const& one : columns) one.key->set(inputs, value_of(one));
        std::erase_if(left, [&](Variation const& one) {
            return unusual(*one.key, value_of(one)) && check(reading, told, where(), one.key->name, *one.key, value_of(one));
        });
        pair = pair || (unusual_pair(inputs, reading.scene.parts) && check_pair(reading, told, where(), inputs));
    }
}

}  // namespace

void warn_of_unusual(Reading& reading) {
    Scene const& scene = reading.scene;
    Told told;
    Inputs typical = scene.inputs;
    check_given(reading, told);
    check_drawn(reading, told, typical);
    if (scene.chaos.parameter != nullptr) check_swept(reading, told, typical);
    else if (scene.design.table != nullptr) check_rows(reading, told, typical);
    else check_pair(reading, told, "", typical);
}

}  // namespace slideway
