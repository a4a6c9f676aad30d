#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/base/text.hpp"
#include "host/config/reader.hpp"
#include "host/sampling/design.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway {
namespace {

using Kind = Distribution::Kind;

DistributionForm const& read_form(Node const& node) {
    constexpr std::string_view example = "write for example { dist = \"unif\", low = 0, high = 1 }";
    if (!node.is_table()) refuse(node, {"not a distribution", std::string(example)});
    Node const* const dist = node.find("dist");
    if (dist == nullptr) refuse_that(node, "has no dist", {"how the key scatters", std::string(example)});
    std::vector<std::string_view> names;
    for (DistributionForm const& form : distribution_forms()) names.push_back(form.name);
    DistributionForm const& form = distribution_forms()[read_choice(*dist, "distribution", names)];
    for (Node const& child : node.children) {
        bool const known = child.key == "dist" || (child.key == "levels" && form.has_levels()) ||
                           std::ranges::any_of(form.arguments, [&](DistributionArgument const& argument) { return argument.name == child.key; });
        if (!known) refuse(child, {fmt::format("no argument of \"{}\"", form.name), fmt::format("use {}", listed_arguments(form))});
    }
    return form;
}

/// Of a distribution that is unbounded some values may break the key's rule: their members fail alone.
void check_distribution(Node const& node, Key const& key, Distribution const& d) {
    auto const refuse_argument = [&](std::string_view name, Problem const& problem) {
        auto const& arguments = form_of(d.kind).arguments;
        auto const& of = *std::ranges::find(arguments, name, &DistributionArgument::name);
        refuse(*node.find(name), with_unit(d.*of.member, of.plain ? "1" : key.unit), problem);
    };
    auto const shown = [&](double value) { return with_unit(value, key.unit); };
    bool const bounded = d.kind == Kind::uniform || d.kind == Kind::triangular || d.kind == Kind::truncated_normal;
    bool const above_low = d.kind == Kind::lognormal || d.kind == Kind::weibull;
    for (DistributionArgument const& argument : form_of(d.kind).arguments) {
        bool const by_rule = (argument.name == "low" || argument.name == "high") ? bounded : argument.name == "value" || (argument.name == "mean" && !bounded);
        auto const problem = by_rule ? broken_rule(key, d.*argument.member) : std::nullopt;
        if (problem) refuse_argument(argument.name, *problem);
        bool const positive = argument.name == "sd" || argument.name == "scale" || argument.name == "shape";
        if (positive && !(d.*argument.member > 0))
            refuse_argument(argument.name, {fmt::format("a {} is positive", argument.name == "sd" ? "standard deviation" : argument.name), "use a value > 0"});
    }
    if (bounded && !(d.low < d.high)) refuse_argument("high", {fmt::format("not above low, {}", shown(d.low)), "use low < high, or dist = \"const\""});
    if (d.kind == Kind::triangular && !(d.mode >= d.low && d.mode <= d.high))
        refuse_argument("mode", {fmt::format("outside low and high, {} and {}", shown(d.low), shown(d.high)), "use low <= mode <= high"});
    // Beyond some 37 standard deviations the tail's probability is no longer a double.
    constexpr double farthest = 30;
    if (d.kind == Kind::truncated_normal && !(d.low - d.mean <= farthest * d.sd && d.mean - d.high <= farthest * d.sd))
        refuse_argument("mean", {"it lies more than 30 sd outside low and high", "move the mean or the limits"});
    // Values lie above low, which itself may break the rule: a positive key may begin at 0.
    auto const at_low = above_low ? broken_rule(key, std::nextafter(d.low, std::numeric_limits<double>::infinity())) : std::nullopt;
    if (at_low && node.find("low") != nullptr) refuse_argument("low", *at_low);
    if (at_low) refuse_that(node, "has no low", {"its values would begin at 0: " + at_low->reason, "add low = ..., " + at_low->advice});
    if (d.kind == Kind::lognormal && !(d.mean > d.low))
        refuse_argument("mean", {fmt::format("not above low, {}", shown(d.low)), "use mean > low, above which all values lie"});
}

/// How a key scatters; every value that it bounds meets the key's rule.  Leaves `levels` to the design.
Distribution read_distribution(Node const& node, Key const& key) {
    DistributionForm const& form = read_form(node);
    Distribution distribution;
    distribution.kind = form.kind;
    for (DistributionArgument const& argument : form.arguments) {
        Node const* const child = node.find(argument.name);
        if (child == nullptr) {
            if (argument.optional) continue;
            refuse_that(node, fmt::format("has no {}", argument.name),
                        {fmt::format("\"{}\" needs {}", form.name, listed_arguments(form)), fmt::format("add {} = ...", argument.name)});
        }
        if (argument.member == nullptr) distribution.list = read_list(*child, key, 10'000, "[1, 2]");
        else distribution.*argument.member = read_number(*child, argument.plain ? "1" : key.unit);
    }
    if (form.kind != Kind::values) check_distribution(node, key, distribution);
    return distribution;
}

/// "joint.clearance" = {…} and joint.clearance = {…} mean the same: tables of nothing but tables are descended into.
void collect_variations(Node const& table, std::vector<Node const*>& found) {
    for (Node const& node : table.children) {
        bool const group = node.is_table() && !node.children.empty() && std::ranges::all_of(node.children, &Node::is_table);
        if (group) collect_variations(node, found);
        else found.push_back(&node);
    }
}

/// The dotted key of an entry of [study.vary].
std::string_view varied_name(Node const& node) { return std::string_view(node.name).substr(std::string_view("study.vary.").size()); }

}  // namespace

std::string key_advice(std::string_view name, Scene const& scene) {
    std::string_view const near = nearest_name(name, numeric_key_names(scene));
    return near.empty() ? std::string("use a dotted key like \"joint.clearance\"") : fmt::format("did you mean \"{}\"?", near);
}

bool varies(Scene const& scene, std::string_view name) {
    return std::ranges::any_of(scene.variations, [&](Variation const& one) { return one.key->name == name; }) ||
           (scene.chaos.parameter != nullptr && scene.chaos.parameter->name == name);
}

bool is_of_start(Key const& key) { return key.name.starts_with("initial.") || key.name == "mechanism.start_angle"; }

void check_varied(Reading const& reading, Node const& node, Key const& key, Problem const& of_option) {
    Scene const& scene = reading.scene;
    for (Variation const& other : scene.variations) {
        if (!other.key->overlaps(key)) continue;
        bool const drawn = other.column == Variation::no_column;
        refuse(node, {drawn ? fmt::format("study.vary.{} varies the same", other.key->name) : fmt::format("the column {} has the same", other.key->name),
                      "remove one of the two"});
    }
    for (GivenKey const& given : given_keys(reading)) {
        if (given.node->order > 0 && given.key->overlaps(key)) refuse(*given.node, of_option);
    }
    if (!counts_for(key, scene.parts.mechanism)) refuse_meaningless(node.where, key.name, scene.parts.mechanism);
    if (is_replaced_by_drive(key, scene.parts)) refuse_replaced(node, key, scene.parts);
    if (!counts_for(key, scene.parts)) refuse_strange(node, scene.parts);
    apply_rules(reading, key, node);
    if (key.member != &Inputs::restitution) return;
    for (std::string_view const replaced : rates_of_damping) {
        if (Node const* const given = reading.given(replaced)) refuse(*given, {"contact.restitution is varied and replaces it", "remove one of the two"});
        if (varies(scene, replaced)) refuse(node, {fmt::format("it replaces {}, which varies too", replaced), "remove one of the two"});
    }
}

std::vector<Node const*> varied_nodes(Node const& root) {
    Node const* const table = root.find_path("study.vary");
    if (table == nullptr) return {};
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.vary] and its keys below"});
    std::vector<Node const*> entries;
    collect_variations(*table, entries);
    return entries;
}

void read_variations(Reading& reading) {
    for (Node const* const node : varied_nodes(reading.root)) {
        Key const* const key = find_key(varied_name(*node), reading.scene);
        if (key == nullptr) refuse_ungiven(node->where, varied_name(*node), reading.scene);
        if (key == nullptr) refuse_that(*node, "cannot vary", {"only numeric keys of the physics can", key_advice(varied_name(*node), reading.scene)});
        Distribution distribution = read_distribution(*node, *key);
        check_varied(reading, *node, *key, {"[study.vary] draws it for every member, so this has no effect",
                                            fmt::format("use --set 'study.vary.\"{}\"={{dist=\"const\", value=...}}'", key->name)});
        require_part(reading.scene.parts, *key);
        reading.scene.variations.push_back({key, std::move(distribution), node->line});
    }
}

namespace {

/// Index of the variation that a node of `keys` names.
std::size_t read_varied(Node const& node, Scene const& scene) {
    std::string const& name = read_text_value(node);
    std::vector<std::string_view> names;
    for (Variation const& variation : scene.variations) names.push_back(variation.key->name);
    auto const found = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (found == names.size()) {
        std::string_view const near = nearest_name(name, names);
        refuse(node, {"[study.vary] has no such key", near.empty() ? std::string("name keys as in [study.vary]") : fmt::format("did you mean \"{}\"?", near)});
    }
    Variation const& variation = scene.variations[found];
    if (variation.column != Variation::no_column) refuse(node, {"study.table has its values", "correlate keys of [study.vary] alone"});
    if (variation.distribution.kind == Distribution::Kind::constant) refuse(node, {"its distribution is \"const\"", "remove it, or let it vary"});
    return found;
}

std::vector<std::size_t> read_keys(Node const& table, Scene const& scene) {
    Node const* const list = table.find("keys");
    if (list == nullptr)
        refuse_missing(table, "study.correlation.keys", "which keys vary together", "add keys = [\"joint.clearance_y\", \"joint.clearance_z\"]");
    if (list->type != Node::Type::array || list->children.size() < 2)
        refuse(*list, {"not a list of two or more keys", "write for example [\"joint.clearance_y\", \"initial.y\"]"});
    std::vector<std::size_t> found;
    for (Node const& node : list->children) {
        std::size_t const index = read_varied(node, scene);
        if (std::ranges::count(found, index) > 0) refuse(node, {"it is in the list already", "remove one of the two"});
        found.push_back(index);
    }
    return found;
}

/// Entries [n][n] of a correlation matrix.
std::vector<double> read_matrix(Node const& matrix, std::size_t n) {
    auto const is_row = [&](Node const& row) { return row.type == Node::Type::array && row.children.size() == n; };
    if (!is_row(matrix) || !std::ranges::all_of(matrix.children, is_row))
        refuse(matrix, {fmt::format("not {0} rows of {0} numbers, one for each key", n), "write for example [[1, 0.5], [0.5, 1]]"});
    std::vector<double> r;
    for (Node const& row : matrix.children) {
        for (Node const& entry : row.children) r.push_back(read_number(entry, "1"));
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            Node const& entry = matrix.children[i].children[j];
            std::string const place = fmt::format("row {}, column {}", i + 1, j + 1);
            double const across = r[j * n + i];
            if (i == j && r[i * n + j] != 1) refuse(entry, {place + ": a key is itself", "write 1 on the diagonal"});
            if (i != j && !(std::abs(r[i * n + j]) < 1)) refuse(entry, {place + ": such keys would be one", "use a value > -1 and < 1"});
            if (j < i && r[i * n + j] != across)
                refuse(entry, {fmt::format("{}: the entry across the diagonal is {}", place, across), "write the same number in both places"});
        }
    }
    // Entry by entry it is sound; what is left is the matrix as a whole.
    if (matrix_defect(r, n)) refuse(matrix, {"not positive definite: no values are correlated so", "use entries nearer to 0"});
    return r;
}

/// [study.correlation]; needs the design.
void read_correlation(Reading& reading) {
    Node const* const table = reading.given("study.correlation");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.correlation], keys and matrix below"});
    check_arguments(*table, "correlation", {"keys", "matrix"});
    Scene& scene = reading.scene;
    Correlation& correlation = scene.design.correlation;
    correlation.variations = read_keys(*table, scene);
    Node const* const matrix = table->find("matrix");
    if (matrix == nullptr) refuse_missing(*table, "study.correlation.matrix", "how keys vary together", "add matrix = [[1, 0.5], [0.5, 1]]");
    correlation.matrix = read_matrix(*matrix, correlation.variations.size());
    if (scene.design.kind != DesignKind::sobol) return;
    reading.warn(fmt::format("study.correlation mixes points of design \"sobol\": of the correlated keys only {} keeps its even spread; \"lhs\" keeps all",
                             scene.variations[correlation.variations.front()].key->name));
}

/// The design says how many members there are; study.members may say the same.
void set_members(Reading& reading, std::uint64_t count, std::string_view how) {
    Node const* const node = reading.given("study.members");
    if (node != nullptr && reading.scene.members != count) refuse(*node, {fmt::format("the design has {}, {}", count, how), "remove it"});
    reading.scene.members = count;
}

void read_base(Reading& reading) {
    Node const& node = *reading.given("study.base");
    std::uint64_t const base = read_count(node, setting("study.base")), row = reading.scene.variations.size() + 2, most = most_members / row;
    if (base > most) refuse(node, {fmt::format("with {} members a row there would be {}", row, base * row), fmt::format("use a value <= {}", most)});
    if (!std::has_single_bit(base)) {
        reading.warn(fmt::format("study.base is {} and no power of two, where points are spread less evenly; use {} or {}", base, std::bit_floor(base),
                                 std::bit_ceil(base)));
    }
    // Percentile intervals of 95 % cover 83 to 88 % at 16 rows, 88 to 90 % at 64, 99 % at 256 (indices of first order).
    constexpr std::uint64_t enough = 128;
    if (base < enough) reading.warn(fmt::format("study.base is {}: the intervals of so few rows are too narrow; use {} or more", base, enough));
    reading.scene.design.base = base;
    set_members(reading, base * row, fmt::format("study.base times {}", row));
}

void read_levels(Reading& reading) {
    Scene& scene = reading.scene;
    Node const* const common = reading.given("study.levels");
    Setting const& row = setting("study.levels");
    std::uint64_t const levels = common != nullptr ? read_count(*common, row) : 0;
    std::uint64_t product = 1;
    for (Node const* const entry : varied_nodes(reading.root)) {
        Distribution const& distribution = scene.variations[scene.design.levels.size()].distribution;
        Node const* const own = entry->find("levels");
        std::uint64_t count = levels;
        if (distribution.kind == Distribution::Kind::constant) count = 1;
        else if (distribution.kind == Distribution::Kind::values) count = distribution.list.size();
        else if (own != nullptr) count = read_count(*own, row);
        else if (common == nullptr)
            refuse_missing(*entry, fmt::format("{}.levels", entry->name), "a grid takes each key at as many values", "add levels = 5 to it, or to [study]");
        if (count > most_members / product) {
            Node const& much = own != nullptr ? *own : common != nullptr ? *common : *entry;
            refuse(much, {fmt::format("the grid would have more than {} members", most_members), "use fewer levels"});
        }
        product *= count;
        scene.design.levels.push_back(count);
    }
    set_members(reading, product, "the product of the levels");
}

}  // namespace

void read_design(Reading& reading) {
    DesignKind const kind = reading.scene.design.kind;
    apply_rules(reading, Known::members);
    if (kind == DesignKind::table) read_member_table(reading, *reading.given("study.table"));
    if (kind == DesignKind::saltelli) read_base(reading);
    if (kind == DesignKind::grid) read_levels(reading);
    for (Node const* const entry : varied_nodes(reading.root)) {
        Node const* const levels = kind != DesignKind::grid ? entry->find("levels") : nullptr;
        if (levels != nullptr) reading.warn(fmt::format("{} has no effect with design \"{}\"", levels->name, name_of(kind)));
    }
    read_correlation(reading);
}

}  // namespace slideway
