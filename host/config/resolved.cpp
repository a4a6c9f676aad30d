// A scene as TOML with every key in SI units.  Numbers are the shortest that read back to the same double.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/config/scene.hpp"
#include "host/config/scene_text.hpp"
#include "host/config/settings.hpp"
#include "host/sampling/distribution.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

bool is_written(Key const& key, Scene const& scene) {
    Parts const& parts = scene.parts;
    if (!counts_for(key, parts)) return false;
    if (is_idle_source(key, parts, given_or_varied(scene)) && key.get(scene.inputs) == key.preset) return false;
    bool const restitution = parts.damping == Damping::restitution;
    if (key.name.starts_with("way.")) return parts.misaligned_way;
    if (key.name == "contact.restitution") return restitution;
    return !restitution || std::ranges::count(rates_of_damping, key.name) == 0;
}

/// Of what is derived from other keys: "# slider_mass = 0.1872  # kg, derived: density x slider_length x way_width x way_depth".  A comment, so that
/// it is derived anew where they vary.
std::string derived_line(std::string_view name, Key const& key, Scene const& scene, double value) {
    std::string const words = derivation_of(key, scene.parts, scene.inputs);
    if (std::isnan(value)) return fmt::format("# {}  # derived: {}\n", name, words);
    std::string const unit = unit_comment(key.unit);
    return fmt::format("# {} = {}{}derived: {}\n", name, toml_number(value), unit.empty() ? "  # " : unit + ", ", words);
}

/// Keys of one table.
std::string physics_table(Scene const& scene, Inputs const& complete, std::string_view table, std::string_view first) {
    std::string text(first);
    for (Key const& key : keys()) {
        auto const dot = key.name.find('.');
        if (key.name.substr(0, dot) != table || !is_written(key, scene)) continue;
        std::string_view const name = key.name.substr(dot + 1);
        bool const given = !std::isnan(key.get(scene.inputs));
        text += given ? number_line(name, key.get(scene.inputs), key.unit) : derived_line(name, key, scene, key.get(complete));
    }
    return text.empty() ? text : fmt::format("\n[{}]\n{}", table, text);
}

/// Of a module the hash of its source: another one is another scene.
std::string source_comment(OwnModule const* module) { return module == nullptr ? std::string() : fmt::format("  # source {}", module->source); }

std::string quantities_text(Scene const& scene) {
    std::string text;
    auto const add = [&](std::string_view name) { text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name); };
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (QuantityInfo const& quantity : selected(outputs.quantities, scene.quantities)) add(quantity.name);
    for (SeriesInfo const& series : selected(outputs.series, scene.series & ~info(scene.parts.mechanism).always)) add(series.name);
    return text;
}

/// Of a bound setting: "max_step = 0.001  # s".
std::string line_of(Setting const& row, Scene const& scene) {
    return fmt::format("{} = {}{}\n", row.key(), value_text(row, scene), unit_comment(row.unit));
}

/// Only what counts with the scene's method.
std::string integrator_table(Scene const& scene) {
    std::string text = fmt::format("\n[integrator]\nmethod = \"{}\"\n", name_of(scene.integrator.method));
    for (Setting const& row : settings()) {
        if (row.table() == "integrator" && row.is_bound() && has_effect(row, scene.integrator.method, scene.parts)) text += line_of(row, scene);
    }
    return text;
}

std::string span_line(Span const& span, std::string_view turns, std::string_view time) {
    return span.revolutions ? number_line(turns, span.value, "1") : number_line(time, span.value, "s");
}

std::string section_line(SectionSurface const& section, Mechanism mechanism) {
    using On = SectionSurface::On;
    if (section.on == On::phase) return number_line("phase", section.level, "rad");
    if (section.on == On::impacts) {
        return fmt::format("section = {{ on = \"{}\", direction = \"{}\" }}\n", impacts_name, name_of(section.direction));
    }
    std::string const on = section.on == On::state
                               ? std::string(state_info(info(mechanism), section.index).name)
                               : fmt::format("{}[P{}]", section.on == On::gap_y ? "gap_y" : "gap_z", section.index + 1);
    return fmt::format("section = {{ on = \"{}\", value = {}, direction = \"{}\" }}  # {}\n", on,
                       toml_number(section.level), name_of(section.direction), section_unit(section, mechanism));
}

std::string neighbours_text(ChaosSettings const& chaos) {
    std::string text = fmt::format("exponents = {}\n", chaos.exponents);
    if (chaos.exponents == 0) return text;
    text += number_line("d0", chaos.d0, "1");
    if (chaos.exponents == 1) text += number_line("d0_lower", chaos.d0_lower, "1") + number_line("d0_upper", chaos.d0_upper, "1");
    if (!chaos.dt.revolutions) return text + number_line("dt", chaos.dt.value, "s");
    return text + fmt::format("rescalings_per_revolution = {:.0f}\n", std::round(1 / chaos.dt.value));
}

std::string sweep_text(ChaosSettings const& chaos) {
    std::string text = fmt::format("parameter = \"{}\"\nvalues = [", chaos.parameter->name);
    // Lines of a scene have a longest length.
    for (double const value : chaos.values) text += fmt::format("\n    {},", toml_number(value));
    text += fmt::format("\n]{}\n", unit_comment(chaos.parameter->unit));
    return text + fmt::format("start = \"{}\"\n", setting("study.start").choices[chaos.continued ? 1 : 0]);
}

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

std::string_view unit_of(Limit const& limit, Mechanism mechanism) {
    for (QuantityInfo const& info : outputs_of(mechanism).quantities) {
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
            high ? fmt::format("max = {}", toml_number(limit.high)) : std::string(), unit_comment(unit_of(limit, scene.parts.mechanism)));
    }
    return text.empty() ? text : "\n[study.limits]\n" + text;
}

/// Lines of [study]: design, base, table.
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

/// [study.vary], [study.correlation] and [study.limits], where the scene has them.
std::string members_text(Scene const& scene) {
    return variations_text(scene) + correlation_text(scene) + limits_text(scene);
}

/// Only what counts in the scene's study.
std::string study_table(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    std::string text = fmt::format("\n[study]\nkind = \"{}\"\n", name_of(scene.study));
    for (Setting const& row : settings()) {
        if (row.table() == "study" && row.is_bound() && (row.studies & set_of(scene.study)) != 0) text += line_of(row, scene);
    }
    if (runs_to_end(scene.study)) {
        text += number_line("duration", scene.integrator.end_time, "s") + fmt::format("samples = {}\n", scene.sample_times.size());
    } else {
        text += span_line(chaos.transient, "transient_revolutions", "Ttr");
        text += span_line(chaos.span, "revolutions", "duration");
    }
    if (scene.verify) text += fmt::format("verify = {}\n", *scene.verify);
    if (!scene.stores_members()) text += fmt::format("store = \"{}\"\n", name_of(scene.store));
    if (scene.study == StudyKind::sweep) text += sweep_text(chaos);
    if (scene.study == StudyKind::poincare || scene.study == StudyKind::sweep)
        text += section_line(chaos.section, scene.parts.mechanism);
    if (chaos.section.on != SectionSurface::On::phase) text += fmt::format("max_crossings = {}\n", chaos.max_crossings);
    if (scene.study == StudyKind::lyapunov || scene.study == StudyKind::sweep) text += neighbours_text(chaos);
    if (scene.study == StudyKind::lyapunov) text += fmt::format("history = {}\n", chaos.history);
    return text + fmt::format("quantities = [{}]\n", quantities_text(scene)) + design_text(scene);
}

}  // namespace

std::string resolved_toml(Scene const& scene) {
    Inputs const complete = complete_inputs(scene.inputs, info(scene.parts.mechanism));
    std::string text = fmt::format("schema = 1\ntitle = {}\n", toml_string(scene.title));
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    if (!scene.modules.empty()) {
        std::string folders;
        for (std::string const& folder : scene.modules) folders += fmt::format("{}{}", folders.empty() ? "" : ", ", toml_string(folder));
        text += fmt::format("\n[modules]\nsearch = [{}]\n", folders);
    }
    std::string kind = fmt::format("kind = \"{}\"{}\n", mechanism.name, source_comment(module_of(scene.parts.mechanism)));
    if (mechanism.free_crank) {
        kind += fmt::format("crank = \"{}\"\n", scene.parts.free_crank ? "free" : "driven");
    }
    text += physics_table(scene, complete, "mechanism", kind);
    text += physics_table(scene, complete, "joint", "") + physics_table(scene, complete, "material", "");
    if (scene.parts.misaligned_way) text += physics_table(scene, complete, "way", "");
    text += physics_table(scene, complete, "contact",
                          mechanism.spatial || scene.parts.rigid
                              ? fmt::format("law = \"{}\"{}\n", contact_info(scene.parts).name, scene.parts.rigid ? "" : source_comment(module_of(scene.parts.law)))
                              : std::string());
    text += physics_table(scene, complete, "friction", fmt::format("enabled = {}\n", scene.parts.friction));
    text += physics_table(scene, complete, "initial", "");
    text += integrator_table(scene);
    text += study_table(scene);
    return text + members_text(scene);
}

}  // namespace slideway
