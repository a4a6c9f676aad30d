#include <cmath>

#include <fmt/format.h>

#include "host/base/suggest.hpp"
#include "host/config/reader.hpp"
#include "host/config/values.hpp"
#include "host/sampling/copula.hpp"

namespace slideway {
namespace {

/// Index of the variation that a node of `keys` names.
std::size_t read_varied(Node const& node, Scene const& scene) {
    std::string const& name = read_text_value(node);
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < scene.variations.size(); ++i) {
        Variation const& variation = scene.variations[i];
        names.push_back(variation.key->name);
        if (variation.key->name != name) continue;
        if (variation.column != Variation::no_column) {
            refuse(node, {"study.table has its values", "correlate keys of [study.vary] alone"});
        }
        if (variation.distribution.kind == Distribution::Kind::constant) {
            refuse(node, {"its distribution is \"const\"", "remove it, or let it vary"});
        }
        return i;
    }
    std::string_view const near = nearest_name(name, names);
    refuse(node, {"[study.vary] has no such key", near.empty() ? std::string("name keys as in [study.vary]")
                                                               : fmt::format("did you mean \"{}\"?", near)});
}

std::vector<std::size_t> read_keys(Node const& table, Scene const& scene) {
    Node const* const list = table.find("keys");
    if (list == nullptr) {
        refuse_missing(table, "study.correlation.keys", "which keys vary together",
                       "add keys = [\"joint.clearance_y\", \"joint.clearance_z\"]");
    }
    if (list->type != Node::Type::array || list->children.size() < 2) {
        refuse(*list, {"not a list of two or more keys", "write for example [\"joint.clearance_y\", \"initial.y\"]"});
    }
    std::vector<std::size_t> found;
    for (Node const& node : list->children) {
        std::size_t const index = read_varied(node, scene);
        for (std::size_t const other : found) {
            if (other == index) refuse(node, {"it is in the list already", "remove one of the two"});
        }
        found.push_back(index);
    }
    return found;
}

/// Entries [n][n] as they are given.
std::vector<double> read_entries(Node const& node, std::size_t n) {
    auto const is_row = [&](Node const& row) { return row.type == Node::Type::array && row.children.size() == n; };
    bool square = is_row(node);
    for (Node const& row : node.children) square = square && is_row(row);
    if (!square) {
        refuse(node, {fmt::format("not {0} rows of {0} numbers, one for each key", n),
                      "write for example [[1, 0.5], [0.5, 1]]"});
    }
    std::vector<double> entries;
    for (Node const& row : node.children) {
        for (Node const& entry : row.children) entries.push_back(read_number(entry, "1"));
    }
    return entries;
}

void check_entries(Node const& node, std::vector<double> const& r, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            Node const& entry = node.children[i].children[j];
            std::string const place = fmt::format("row {}, column {}", i + 1, j + 1);
            if (i == j && r[i * n + j] != 1) refuse(entry, {place + ": a key is itself", "write 1 on the diagonal"});
            if (i != j && !(std::abs(r[i * n + j]) < 1)) {
                refuse(entry, {place + ": such keys would be one", "use a value > -1 and < 1"});
            }
            if (j < i && r[i * n + j] != r[j * n + i]) {
                refuse(entry, {fmt::format("{}: the entry across the diagonal is {}", place, r[j * n + i]),
                               "write the same number in both places"});
            }
        }
    }
}

}  // namespace

void read_correlation(Node const& root, Scene& scene) {
    Node const* const table = root.find_path("study.correlation");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.correlation], keys and matrix below"});
    check_arguments(*table, "correlation", {"keys", "matrix"});
    DesignKind const kind = scene.design.kind;
    if (kind == DesignKind::saltelli) {
        refuse(*table, {"sensitivities of design \"saltelli\" are of keys that vary alone",
                        "remove it, or use \"mc\", \"lhs\" or \"sobol\""});
    }
    if (kind == DesignKind::grid) {
        refuse(*table, {"a grid takes its levels of each key alone", "remove it, or use \"mc\", \"lhs\" or \"sobol\""});
    }
    Correlation& correlation = scene.design.correlation;
    correlation.variations = read_keys(*table, scene);
    Node const* const matrix = table->find("matrix");
    if (matrix == nullptr) {
        refuse_missing(*table, "study.correlation.matrix", "how keys vary together",
                       "add matrix = [[1, 0.5], [0.5, 1]]");
    }
    std::size_t const n = correlation.variations.size();
    correlation.matrix = read_entries(*matrix, n);
    check_entries(*matrix, correlation.matrix, n);
    // Entry by entry it is sound; what is left is the matrix as a whole.
    if (matrix_defect(correlation.matrix, n)) {
        refuse(*matrix, {"not positive definite: no values are correlated so", "use entries nearer to 0"});
    }
    if (kind == DesignKind::sobol) {
        scene.warnings.push_back(
            fmt::format("study.correlation mixes points of design \"{}\": of the correlated keys only {} keeps its "
                        "even spread; \"lhs\" keeps all",
                        name_of(kind), scene.variations[correlation.variations.front()].key->name));
    }
}

}  // namespace slideway
