#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "host/config/reader.hpp"
#include "host/config/values.hpp"
#include "host/sampling/distribution_forms.hpp"

namespace slideway {
namespace {

bool varies(Variation const& variation) {
    return variation.column != Variation::no_column || variation.distribution.kind != Distribution::Kind::constant;
}

DesignKind read_kind(Node const& root, Scene const& scene) {
    Node const* const node = root.find_path("study.design");
    if (node == nullptr) return DesignKind::mc;
    auto const kind = static_cast<DesignKind>(read_choice(*node, setting("study.design")));
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
