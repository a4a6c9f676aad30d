#include "host/config/resolved_members.hpp"

#include <cmath>
#include <span>

#include <fmt/format.h>

#include "host/config/scene_text.hpp"
#include "host/sampling/distribution_forms.hpp"

namespace slideway {
namespace {

/// Lines of a scene have a longest length: long lists take several.
std::string list_text(std::span<double const> values) {
    constexpr std::size_t per_line = 8;
    bool const lines = values.size() > per_line;
    std::string text = "[";
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::string_view const before = lines && i % per_line == 0 ? "\n    " : i == 0 ? "" : " ";
        std::string_view const after = lines || i + 1 < values.size() ? "," : "";
        text += fmt::format("{}{}{}", before, toml_number(values[i]), after);
    }
    return text + (lines ? "\n]" : "]");
}

/// @param levels of a grid; 0 elsewhere
std::string distribution_text(Distribution const& distribution, std::uint64_t levels) {
    DistributionForm const& form = form_of(distribution.kind);
    std::string text = fmt::format("{{ dist = \"{}\"", form.name);
    for (DistributionArgument const& argument : form.arguments) {
        text += fmt::format(
            ", {} = {}", argument.name,
            argument.member == nullptr ? list_text(distribution.list) : toml_number(distribution.*argument.member));
    }
    if (levels > 0 && form.has_levels()) text += fmt::format(", levels = {}", levels);
    return text + " }";
}

std::string variations_text(Scene const& scene) {
    std::string text;
    for (std::size_t i = 0; i < scene.variations.size(); ++i) {
        Variation const& variation = scene.variations[i];
        if (variation.column != Variation::no_column) continue;
        std::uint64_t const levels = scene.design.kind == DesignKind::grid ? scene.design.levels.at(i) : 0;
        text += fmt::format("\"{}\" = {}{}\n", variation.key->name, distribution_text(variation.distribution, levels),
                            unit_comment(variation.key->unit));
    }
    return text.empty() ? text : "\n[study.vary]\n" + text;
}

std::string correlation_text(Scene const& scene) {
    Correlation const& correlation = scene.design.correlation;
    std::size_t const n = correlation.variations.size();
    if (n == 0) return {};
    std::string keys, rows;
    for (std::size_t i = 0; i < n; ++i) {
        keys += fmt::format("\n    \"{}\",", scene.variations[correlation.variations[i]].key->name);
        rows += fmt::format("\n    {},", list_text(std::span(correlation.matrix).subspan(i * n, n)));
    }
    return fmt::format("\n[study.correlation]\nkeys = [{}\n]\nmatrix = [{}\n]\n", keys, rows);
}

std::string_view unit_of(Limit const& limit) {
    for (QuantityInfo const& info : quantity_table) {
        if (limit.quantity == info.name) return info.unit;
    }
    return "1";
}

std::string limits_text(Scene const& scene) {
    std::string text;
    for (Limit const& limit : scene.limits) {
        bool const low = std::isfinite(limit.low), high = std::isfinite(limit.high);
        text += fmt::format(
            "\"{}\" = {{ {}{}{} }}{}\n", limit.name(),
            low ? fmt::format("min = {}", toml_number(limit.low)) : std::string(), low && high ? ", " : "",
            high ? fmt::format("max = {}", toml_number(limit.high)) : std::string(), unit_comment(unit_of(limit)));
    }
    return text.empty() ? text : "\n[study.limits]\n" + text;
}

}  // namespace

std::string toml_number(double value) {
    std::string text = fmt::format("{}", value);
    // Without a point TOML reads an integer, and -0 loses its sign.
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string unit_comment(std::string_view unit) { return unit.empty() || unit == "1" ? std::string() : fmt::format("  # {}", unit); }

std::string number_line(std::string_view name, double value, std::string_view unit) {
    return fmt::format("{} = {}{}\n", name, toml_number(value), unit_comment(unit));
}

std::string design_text(Scene const& scene) {
    Design const& design = scene.design;
    std::string text = fmt::format("design = \"{}\"\n", name_of(design.kind));
    if (design.kind == DesignKind::saltelli) text += fmt::format("base = {}\n", design.base);
    if (design.kind == DesignKind::table) {
        // The checksum tells a changed table from the one that was run.
        MemberTable const& table = *design.table;
        text += fmt::format("table = {}  # {} rows, FNV-1a {:016x}\n", toml_string(table.path), table.rows(),
                            table.checksum);
    }
    return text;
}

std::string members_text(Scene const& scene) {
    return variations_text(scene) + correlation_text(scene) + limits_text(scene);
}

}  // namespace slideway
