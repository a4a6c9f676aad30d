#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"
#include "host/sampling/copula.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway {
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
