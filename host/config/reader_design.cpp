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

/// [study.correlation]; needs the design.
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

bool varies(Variation const& variation) {
    return variation.column != Variation::no_column || variation.distribution.kind != Distribution::Kind::constant;
}

DesignKind read_kind(Node const& root, Scene const& scene) {
    Node const* const node = root.find_path("study.design");
    DesignKind kind = DesignKind::mc;
    read_given(root, "study.design", kind);
    bool const drawn = kind == DesignKind::mc || kind == DesignKind::lhs || kind == DesignKind::sobol;
    if (scene.study == StudyKind::sweep && !drawn) {
        refuse(*node, {"a sweep draws the starts of its columns", "use \"mc\", \"lhs\" or \"sobol\""});
    }
    if (kind == DesignKind::saltelli && !runs_to_end(scene.study)) {
        refuse(*node, {fmt::format("kind = \"{}\" asks for no sensitivities", name_of(scene.study)),
                       "use \"mc\", \"lhs\" or \"sobol\", or kind = \"tolerance\""});
    }
    bool const any = std::any_of(scene.variations.begin(), scene.variations.end(), varies);
    if (kind != DesignKind::mc && kind != DesignKind::table && !any) {
        refuse(*node, {"nothing varies", "add keys to [study.vary], or remove it"});
    }
    return kind;
}

/// The design says how many members there are; study.members may say the same.
void set_members(Node const& root, Scene& scene, std::uint64_t count, std::string_view how) {
    Node const* const node = root.find_path("study.members");
    if (node != nullptr && scene.members != count) {
        refuse(*node, {fmt::format("the design has {}, {}", count, how), "remove it"});
    }
    scene.members = count;
}

void read_base(Node const& root, Scene& scene) {
    Node const* const node = root.find_path("study.base");
    if (node == nullptr) {
        refuse_missing(*root.find_path("study.design"), "study.base",
                       "\"saltelli\" has base rows of one member and one more of each key and another",
                       "add base = 256");
    }
    std::uint64_t const base = read_count(*node, setting("study.base"));
    std::uint64_t const row = scene.variations.size() + 2;
    if (base > most_members / row) {
        refuse(*node, {fmt::format("with {} members a row there would be {}", row, base * row),
                       fmt::format("use a value <= {}", most_members / row)});
    }
    if (!std::has_single_bit(base)) {
        scene.warnings.push_back(
            fmt::format("study.base is {} and no power of two, where points are spread less evenly; use {} or {}", base,
                        std::bit_floor(base), std::bit_ceil(base)));
    }
    // Percentile intervals of 95 % cover 83 to 88 % at 16 rows, 88 to 90 % at 64, 99 % at 256 (indices of first order).
    constexpr std::uint64_t enough = 128;
    if (base < enough) {
        scene.warnings.push_back(
            fmt::format("study.base is {}: the intervals of so few rows are too narrow; use {} or more", base, enough));
    }
    scene.design.base = base;
    set_members(root, scene, base * row, fmt::format("study.base times {}", row));
}

void read_levels(Node const& root, Scene& scene) {
    Node const* const common = root.find_path("study.levels");
    constexpr std::string_view meaning = "number of levels";
    std::uint64_t const levels = common != nullptr ? read_count(*common, meaning, 1, most_members) : 0;
    std::uint64_t product = 1;
    for (VariedNode const& entry : varied_nodes(root)) {
        Distribution const& distribution = scene.variations[scene.design.levels.size()].distribution;
        Node const* const own = entry.node->find("levels");
        std::uint64_t count = levels;
        if (distribution.kind == Distribution::Kind::constant) {
            count = 1;
        } else if (distribution.kind == Distribution::Kind::values) {
            count = distribution.list.size();
        } else if (own != nullptr) {
            count = read_count(*own, meaning, 1, most_members);
        } else if (common == nullptr) {
            refuse_missing(*entry.node, fmt::format("{}.levels", entry.node->name),
                           "a grid takes each key at as many values", "add levels = 5 to it, or to [study]");
        }
        if (count > most_members / product) {
            refuse(own != nullptr      ? *own
                   : common != nullptr ? *common
                                       : *entry.node,
                   {fmt::format("the grid would have more than {} members", most_members), "use fewer levels"});
        }
        product *= count;
        scene.design.levels.push_back(count);
    }
    set_members(root, scene, product, "the product of the levels");
}

/// Keys that count with another design alone: what an option replaced may leave them in the file.
void warn_of_idle_design_keys(Node const& root, Scene& scene) {
    DesignKind const kind = scene.design.kind;
    auto const warn = [&](Node const* node) {
        if (node == nullptr) return;
        scene.warnings.push_back(fmt::format("{} has no effect with design \"{}\"", node->name, name_of(kind)));
    };
    Node const* const base = kind != DesignKind::saltelli ? root.find_path("study.base") : nullptr;
    bool const counts_itself = kind == DesignKind::grid || kind == DesignKind::table;
    if (base != nullptr && !counts_itself && root.find_path("study.members") == nullptr) {
        refuse(*base, {fmt::format("design \"{}\" has no rows of members, and study.members is not given", name_of(kind)),
                       "add members = 1024, or use design = \"saltelli\""});
    }
    warn(base);
    if (kind == DesignKind::grid) return;
    warn(root.find_path("study.levels"));
    for (VariedNode const& entry : varied_nodes(root)) warn(entry.node->find("levels"));
}

}  // namespace

void read_design(Node const& root, Scene& scene) {
    Design& design = scene.design;
    design.kind = read_kind(root, scene);
    Node const* const table = root.find_path("study.table");
    if (design.kind == DesignKind::table) {
        if (table == nullptr) {
            refuse_missing(*root.find_path("study.design"), "study.table", "the design is the rows of a table",
                           "add table = \"members.csv\"");
        }
        read_member_table(*table, root, scene);
    } else if (table != nullptr) {
        refuse(*table, {fmt::format("design \"{}\" reads no table", name_of(design.kind)),
                        "use design = \"table\", or remove it"});
    }
    if (design.kind == DesignKind::saltelli) read_base(root, scene);
    if (design.kind == DesignKind::grid) read_levels(root, scene);
    warn_of_idle_design_keys(root, scene);
    read_correlation(root, scene);
}

}  // namespace slideway
