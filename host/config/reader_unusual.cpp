// Warnings of numbers that may be right, and are likelier slips of a unit.
#include <algorithm>
#include <optional>
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
        case Distribution::Kind::triangular:
            return {d.high, d.low};
        case Distribution::Kind::truncated_normal:
            return {std::clamp(d.mean, d.low, d.high)};
        case Distribution::Kind::weibull:
            return {d.low + d.scale};
        case Distribution::Kind::values:
            return d.list;
        case Distribution::Kind::constant:
        case Distribution::Kind::normal:
        case Distribution::Kind::lognormal:
            return {d.mean};
    }
    return {};
}

/// Takes one warning for each key, whatever says more of it.
class Warnings {
public:
    Warnings(Node const& root, Scene& scene) : root_(root), scene_(scene) {}

    /// @param where the number stands  @param name of it  @param has_unit it was written with its unit  @return whether it is unusual
    bool check(std::string const& where, std::string_view name, Key const& key, double value, bool has_unit = false) {
        auto const words = unusual(key, value, has_unit);
        if (words) warn(where, name, key, *words);
        return words.has_value();
    }

    /// Of numbers together, where none of them is unusual alone.
    bool check_pair(std::string const& where, Inputs const& inputs) {
        auto const found = unusual_pair(inputs, scene_.parts);
        bool const known = found && std::ranges::any_of(told_, [&](Key const* key) { return key->overlaps(*found->first); });
        if (found && !known) warn(where.empty() ? place_of(*found->first) : where, found->first->name, *found->first, found->second);
        return found.has_value();
    }

private:
    void warn(std::string const& where, std::string_view name, Key const& key, std::string const& words) {
        told_.push_back(&key);
        scene_.warnings.push_back(fmt::format("{}: {} {}", where, name, words));
    }

    std::string place_of(Key const& key) const {
        std::string where = root_.where;
        for (GivenKey const& given : given_keys(root_)) {
            if (given.key->overlaps(key)) where = given.node->where;
        }
        return where;
    }

    Node const& root_;
    Scene& scene_;
    std::vector<Key const*> told_;
};

void check_given(Node const& root, Scene const& scene, Warnings& warnings) {
    auto const given = given_keys(root);
    for (auto one = given.begin(); one != given.end(); ++one) {
        auto const replaced = [&](GivenKey const& later) { return later.key->overlaps(*one->key); };
        auto const varied = [&](Variation const& variation) { return variation.key->overlaps(*one->key); };
        if (!counts_for(*one->key, scene.parts) || std::any_of(one + 1, given.end(), replaced) || std::ranges::any_of(scene.variations, varied)) continue;
        warnings.check(one->node->where, one->node->name, *one->key, one->key->get(scene.inputs), one->node->type == Node::Type::text);
    }
}

/// @param typical inputs that get the first number of each distribution
void check_drawn(Node const& root, Scene const& scene, Inputs& typical, Warnings& warnings) {
    auto const nodes = varied_nodes(root);
    for (std::size_t i = 0; i < nodes.size() && i < scene.variations.size(); ++i) {
        Variation const& variation = scene.variations[i];
        std::vector<double> const numbers = numbers_of(variation.distribution);
        variation.key->set(typical, numbers.front());
        for (double const number : numbers) {
            if (warnings.check(nodes[i].node->where, fmt::format("a value of study.vary.{}", nodes[i].name), *variation.key, number)) break;
        }
    }
}

void check_swept(Node const& root, Scene const& scene, Inputs typical, Warnings& warnings) {
    Node const* node = root.find_path("study.values");
    if (node == nullptr) node = root.find_path("study.to");
    Key const& key = *scene.chaos.parameter;
    for (double const value : scene.chaos.values) {
        key.set(typical, value);
        if (warnings.check(node->where, fmt::format("a value of {}", key.name), key, value) || warnings.check_pair(node->where, typical)) return;
    }
}

void check_rows(Scene const& scene, Inputs const& typical, Warnings& warnings) {
    MemberTable const& table = *scene.design.table;
    std::vector<Variation> columns;
    std::ranges::copy_if(scene.variations, std::back_inserter(columns), [](Variation const& one) { return one.column != Variation::no_column; });
    bool pair = false;
    for (std::size_t row = 0; row < table.rows() && !(columns.empty() && pair); ++row) {
        Inputs inputs = typical;
        auto const where = [&] { return fmt::format("{}:{}", table.name, table.lines[row]); };
        auto const value_of = [&](Variation const& one) { return table.values[row * table.columns + one.column]; };
        for (Variation const& one : scene.variations) {
            if (one.column != Variation::no_column) one.key->set(inputs, value_of(one));
        }
        std::erase_if(columns, [&](Variation const& one) {
            return unusual(*one.key, value_of(one)) && warnings.check(where(), one.key->name, *one.key, value_of(one));
        });
        pair = pair || (unusual_pair(inputs, scene.parts) && warnings.check_pair(where(), inputs));
    }
}

}  // namespace

void warn_of_unusual(Node const& root, Scene& scene) {
    Warnings warnings(root, scene);
    Inputs typical = scene.inputs;
    check_given(root, scene, warnings);
    check_drawn(root, scene, typical, warnings);
    if (scene.chaos.parameter != nullptr) check_swept(root, scene, typical, warnings);
    else if (scene.design.table != nullptr) check_rows(scene, typical, warnings);
    else warnings.check_pair("", typical);
}

}  // namespace slideway
