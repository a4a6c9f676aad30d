// Warnings of numbers that may be right, and are likelier slips of a unit.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/config/reader.hpp"

namespace slideway {
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
