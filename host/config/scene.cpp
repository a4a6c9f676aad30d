#include "host/config/scene.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/document.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/outputs.hpp"
#include "host/config/settings.hpp"
#include "host/sampling/distribution.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

/// Values of all variations.
std::vector<double> draw_values(Scene const& scene, std::uint64_t member) {
    std::vector<double> values(scene.variations.size());
    if (scene.sampler != nullptr) {
        scene.sampler->draw(member, values);
    } else {
        Sampler(scene.design, scene.variations, scene.seed, scene.members).draw(member, values);
    }
    return values;
}

}  // namespace

void prepare_sampler(Scene& scene) {
    try {
        scene.sampler = std::make_shared<Sampler const>(scene.design, scene.variations, scene.seed, scene.members);
    } catch (SceneError const& error) {
        throw SceneError(scene.path + ": " + error.what());
    }
}

double draw(Scene const& scene, Variation const& variation, std::uint64_t member) {
    auto const values = draw_values(scene, member);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (scene.variations[i].key == variation.key) return values[i];
    }
    throw std::invalid_argument("draw: the scene does not vary this key");
}

Key const* find_key(std::string_view dotted_name, Scene const& scene) {
    Key const* own = scene.loads != nullptr ? scene.loads->find_key(dotted_name) : nullptr;
    if (Linkage const* const linkage = linkage_of(scene.parts.mechanism); linkage != nullptr && own == nullptr) own = linkage->find_key(dotted_name);
    return own != nullptr ? own : find_key(dotted_name);
}

std::vector<std::string_view> numeric_key_names(Scene const& scene) {
    std::vector<std::string_view> names = numeric_key_names();
    for (std::size_t i = 0; scene.loads != nullptr && i < scene.loads->keys().size(); ++i) names.push_back(scene.loads->keys()[i].name);
    if (Linkage const* const linkage = linkage_of(scene.parts.mechanism)) {
        for (Key const& key : linkage->keys) names.push_back(key.name);
    }
    return names;
}

TableFile const* find_table(Scene const& scene, std::string_view key) {
    auto const found = std::ranges::find(scene.tables, key, &TableFile::key);
    return found == scene.tables.end() ? nullptr : &*found;
}

std::uint64_t member_count(Scene const& scene) {
    return scene.study == StudyKind::sweep ? scene.members * scene.chaos.values.size() : scene.members;
}

std::string label_of(Scene const& scene, std::uint64_t member) {
    MemberTable const* const table = scene.design.table.get();
    return table != nullptr && member < table->labels.size() ? table->labels[static_cast<std::size_t>(member)] : std::string();
}

Inputs given_or_varied(Scene const& scene) {
    Inputs inputs = scene.inputs;
    for (Variation const& variation : scene.variations) variation.key->set(inputs, 1);
    if (scene.chaos.parameter != nullptr) scene.chaos.parameter->set(inputs, 1);
    return inputs;
}

std::vector<DerivedNumber> derived_numbers(Scene const& scene) {
    Inputs const complete = complete_inputs(scene.inputs, info(scene.parts.mechanism)), given = given_or_varied(scene);
    Inputs other = scene.inputs;
    for (Variation const& variation : scene.variations) variation.key->set(other, 1.5 * variation.key->get(other));
    Inputs const others = complete_inputs(other, info(scene.parts.mechanism));
    std::vector<DerivedNumber> numbers;
    for (Key const& key : keys()) {
        if (!counts_for(key, scene.parts) || !std::isnan(key.get(given)) || lays_way(key)) continue;  // faces are as their axis says
        std::string words = derivation_of(key, scene.parts, scene.inputs);
        // What follows from what members vary in is not what any of them has.
        if (auto const note = words.find(" ("); key.get(others) != key.get(complete) && !std::isnan(key.get(complete)))
            words = words.substr(0, note) + "; members have their own";
        numbers.push_back({&key, key.get(complete), std::move(words)});
    }
    return numbers;
}

Inputs member_inputs(Scene const& scene, std::uint64_t member) {
    Inputs inputs = scene.inputs;
    std::uint64_t start = member;
    if (scene.study == StudyKind::sweep) {
        start = member % scene.members;
        scene.chaos.parameter->set(inputs, scene.chaos.values.at(static_cast<std::size_t>(member / scene.members)));
    }
    auto const values = draw_values(scene, start);
    for (std::size_t i = 0; i < values.size(); ++i) scene.variations[i].key->set(inputs, values[i]);
    return complete_inputs(inputs, info(scene.parts.mechanism));
}

// A scene as TOML with every key in SI units.  Numbers are the shortest that read back to the same double.

namespace {

bool is_written(Key const& key, Scene const& scene) {
    Parts const& parts = scene.parts;
    if (key.twin != nullptr || !counts_for(key, parts)) return false;
    if (is_idle_source(key, parts, given_or_varied(scene)) && key.get(scene.inputs) == key.preset) return false;
    bool const restitution = parts.damping == Damping::restitution;
    // A scene with all of its faces does not say what is the same of both.
    Inputs const& in = scene.inputs;
    if (key.member == &Inputs::clearance_y && !std::isnan(in.clearance_y_plus + in.clearance_y_minus)) return false;
    if (key.member == &Inputs::clearance_z && !std::isnan(in.clearance_z_plus + in.clearance_z_minus)) return false;
    if (lays_way(key)) return parts.misaligned_way;
    if (is_of_body(key)) return parts.offset_slider;
    if (key.name == "contact.restitution") return restitution;
    return !restitution || std::ranges::count(rates_of_damping, key.name) == 0;
}

/// Of a module the hash of its source: another one is another scene.
std::string source_comment(OwnModule const* module) { return module == nullptr ? std::string() : fmt::format("  # source {}", module->source); }

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
        text += fmt::format(", {} = {}", argument.name,
                            argument.member == nullptr ? list_text(distribution.list) : toml_number(distribution.*argument.member));
    }
    if (levels > 0 && form.has_levels()) text += fmt::format(", levels = {}", levels);
    return text + " }";
}

/// What the resolved scene has of a key: a line, a comment of what is derived from others (so that it is derived anew where they vary), a table, or nothing.
std::string lines_of(Setting const& row, Scene const& scene) {
    bool const counts = (row.studies & set_of(scene.study)) != 0 && has_effect(row, scene.integrator.method, scene.parts);
    if (row.value.text == nullptr || !counts || (row.is_said != nullptr && !row.is_said(scene))) return {};
    std::string const text = row.value.text(scene, row);
    if (text.empty()) return text;
    if (row.type == Setting::Type::table && !text.starts_with('{')) return fmt::format("\n[{}]\n{}", row.name, text);
    if (row.physics == nullptr || !std::isnan(row.physics->get(scene.inputs))) return fmt::format("{} = {}{}\n", row.key(), text, unit_comment(row.unit));
    std::string const unit = text == "nan" ? std::string() : unit_comment(row.unit);
    return fmt::format("# {}{}{}derived: {}\n", row.key(), text == "nan" ? std::string() : " = " + text, unit.empty() ? "  # " : unit + ", ",
                       derivation_of(*row.physics, scene.parts, scene.inputs));
}

/// Of a table in a file.  The checksum tells a changed one from the one that was run.
std::string file_text(std::string const& path, std::size_t rows, std::uint64_t checksum) {
    return fmt::format("{}  # {} rows, FNV-1a {:016x}", toml_string(path), rows, checksum);
}

/// What a load's table says beside numbers and files.
std::string load_choices(Load const& load) {
    bool const on_crank = load.crank_torque != Load::none;
    switch (load.kind) {
        case LoadKind::push:
            return fmt::format("on = \"{}\"\n", load_bodies[on_crank ? 1 : 0]) +
                   (on_crank ? std::string() : fmt::format("frame = \"{}\"\n", load_frames[load.turns_with_slider ? 1 : 0]));
        case LoadKind::spring: return fmt::format("along = \"{}\"\n", spring_directions[load.along ? 1 : 0]);
        case LoadKind::stop: return fmt::format("blocks = \"{}\"\n", stop_sides[load.side > 0 ? 0 : 1]);
        case LoadKind::way_profile: {
            auto const named = std::ranges::find(profiled_face_bits, load.faces) - std::begin(profiled_face_bits);
            return fmt::format("faces = \"{}\"\n", profiled_faces[named]);
        }
        case LoadKind::ground_motion:
        case LoadKind::way_ends:
        case LoadKind::film: break;
    }
    return {};
}

std::string load_file(TableFile const& file, LoadTable const& table, Load const& load) {
    std::string text = fmt::format("table = {}\n", file_text(file.path, table.rows, file.checksum));
    if (load.kind == LoadKind::push) text += fmt::format("over = \"{}\"\n", load_arguments[static_cast<int>(load.over) - 1]);
    if (load.kind != LoadKind::ground_motion) text += fmt::format("column = {}\n", toml_string(table.column));
    return text + fmt::format("interpolation = \"{}\"\nrepeats = {}\n", interpolation_names[static_cast<int>(table.interpolation)], load.table.repeats);
}

/// [load.name] and its like, one after the other.
std::string loads_text(Scene const& scene) {
    std::string text;
    if (Linkage const* const linkage = linkage_of(scene.parts.mechanism)) {
        for (Linkage::Row const& row : linkage->rows) {
            text += fmt::format("\n[{}]\n{}", row.name, row.words);
            for (std::size_t const i : row.keys) {
                Key const& key = linkage->keys[i];
                text += number_line(key.name.substr(row.name.size() + 1), key.get(scene.inputs), key.unit);
            }
        }
    }
    if (scene.loads == nullptr) return text;
    auto const rows = scene.loads->rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        auto const& [name, table, words] = rows[i];
        Load load = scene.loads->load(i);
        if (i == 0 || rows[i - 1].name != name) text += fmt::format("\n[{}]\n", name) + (words.empty() ? load_choices(load) : words);
        for (LoadNumber const& number : load_numbers()) {
            int const place = number.kind == load.kind ? number.place(load) : Load::none;
            if (place != Load::none) text += number_line(number.name, scene.inputs.*load_inputs[place], number.unit);
        }
        // The ground has one file for its axes.
        bool const is_last = i + 1 == rows.size() || rows[i + 1].name != name;
        if (table.function != nullptr && is_last) text += load_file(*find_table(scene, name + ".table"), table, load);
    }
    return text;
}

}  // namespace

std::string resolved_toml(Scene const& scene, Settings keys) {
    std::string text;
    std::string_view table;
    for (Setting const& row : keys) {
        if (row.table() == "integrator" && row.table() != table) text += loads_text(scene);
        std::string const lines = lines_of(row, scene);
        if (!lines.empty() && row.table() != table) text += fmt::format("\n[{}]\n", table = row.table());
        text += lines;
    }
    return text;
}

std::string resolved_toml(Scene const& scene) { return resolved_toml(scene, known_keys()); }

namespace resolved {

std::string schema(Scene const&, Setting const&) { return "1"; }
std::string title(Scene const& scene, Setting const&) { return toml_string(scene.title); }

std::string folders(Scene const& scene, Setting const&) {
    std::vector<std::string> quoted;
    for (std::string const& folder : scene.modules) quoted.push_back(toml_string(folder));
    return quoted.empty() ? std::string() : fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string mechanism(Scene const& scene, Setting const&) {
    return fmt::format("\"{}\"{}", kind_of(scene.parts.mechanism), source_comment(module_of(scene.parts.mechanism)));
}

std::string drive_body(Scene const& scene, Setting const&) {
    Linkage const* const linkage = linkage_of(scene.parts.mechanism);
    return linkage == nullptr || linkage->driven.empty() ? std::string() : toml_string(linkage->driven);
}
std::string drive_table(Scene const& scene, Setting const&) {
    TableFile const& file = *find_table(scene, "drive.table");
    return file_text(file.path, scene.drive->table.rows, file.checksum);
}
std::string drive_column(Scene const& scene, Setting const&) { return toml_string(scene.drive->table.column); }
std::string drive_argument(Scene const& scene, Setting const&) {
    if (scene.parts.drive.by != DriveBy::torque) return {};
    LoadArgument const over = scene.parts.drive.over;
    return fmt::format("\"{}\"", load_arguments[static_cast<int>(over) - 1]);
}
std::string drive_gives(Scene const& scene, Setting const&) {
    return scene.parts.drive.by == DriveBy::profile ? fmt::format("\"{}\"", profile_names[static_cast<int>(scene.drive->gives)]) : std::string();
}
std::string drive_interpolation(Scene const& scene, Setting const&) {
    return fmt::format("\"{}\"", interpolation_names[static_cast<int>(scene.drive->table.interpolation)]);
}
std::string drive_repeats(Scene const& scene, Setting const&) { return fmt::format("{}", scene.parts.drive.table->repeats); }

std::string law(Scene const& scene, Setting const&) {
    if (!info(scene.parts.mechanism).spatial && !scene.parts.rigid) return {};
    return fmt::format("\"{}\"{}", contact_info(scene.parts).name, source_comment(contact_module(scene.parts)));
}

std::string number(Scene const& scene, Setting const& row) {
    if (!is_written(*row.physics, scene)) return {};
    double const value = row.physics->get(complete_inputs(scene.inputs, info(scene.parts.mechanism)));
    return std::isnan(value) ? "nan" : toml_number(value);
}

std::string samples(Scene const& scene, Setting const&) { return fmt::format("{}", scene.sample_times.size()); }

std::string quantities(Scene const& scene, Setting const&) {
    std::vector<std::string> names;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (QuantityInfo const& quantity : selected(outputs.quantities, scene.quantities)) names.push_back(toml_string(quantity.name));
    for (SeriesInfo const& series : selected(outputs.series, scene.series & ~info(scene.parts.mechanism).always)) names.push_back(toml_string(series.name));
    return fmt::format("[{}]", fmt::join(names, ", "));
}

std::string phase(Scene const& scene, Setting const&) {
    return scene.chaos.section.is_phase() ? toml_number(scene.chaos.section.level) : std::string();
}

std::string section(Scene const& scene, Setting const&) {
    SectionSurface const& section = scene.chaos.section;
    using On = SectionSurface::On;
    if (section.is_phase()) return {};
    std::string_view const direction = name_of(section.direction);
    if (section.on == On::impacts) return fmt::format("{{ on = \"{}\", direction = \"{}\" }}", impacts_name, direction);
    std::string const on = section.on == On::state ? std::string(state_info(info(scene.parts.mechanism), section.index).name)
                                                   : fmt::format("{}[P{}]", section.on == On::gap_y ? "gap_y" : "gap_z", section.index + 1);
    return fmt::format("{{ on = \"{}\", value = {}, direction = \"{}\" }}  # {}", on, toml_number(section.level), direction,
                       section_unit(section, scene.parts.mechanism));
}

std::string exponents(Scene const& scene, Setting const&) { return fmt::format("{}", scene.chaos.exponents); }
std::string history(Scene const& scene, Setting const&) { return fmt::format("{}", scene.chaos.history); }

std::string rescalings(Scene const& scene, Setting const&) {
    return scene.chaos.dt.revolutions ? fmt::format("{:.0f}", std::round(1 / scene.chaos.dt.value)) : std::string();
}

std::string parameter(Scene const& scene, Setting const&) { return fmt::format("\"{}\"", scene.chaos.parameter->name); }

std::string values(Scene const& scene, Setting const&) {
    std::string text = "[";
    // Lines of a scene have a longest length.
    for (double const value : scene.chaos.values) text += fmt::format("\n    {},", toml_number(value));
    return text + "\n]" + unit_comment(scene.chaos.parameter->unit);
}

std::string base(Scene const& scene, Setting const&) {
    return scene.design.kind == DesignKind::saltelli ? fmt::format("{}", scene.design.base) : std::string();
}

std::string member_table(Scene const& scene, Setting const&) {
    if (scene.design.kind != DesignKind::table) return {};
    MemberTable const& table = *scene.design.table;
    return file_text(table.path, table.rows(), table.checksum);
}

std::string variations(Scene const& scene, Setting const&) {
    std::string text;
    for (std::size_t i = 0; i < scene.variations.size(); ++i) {
        Variation const& variation = scene.variations[i];
        if (variation.column != Variation::no_column) continue;
        std::uint64_t const levels = scene.design.kind == DesignKind::grid ? scene.design.levels.at(i) : 0;
        text += fmt::format("\"{}\" = {}{}\n", variation.key->name, distribution_text(variation.distribution, levels), unit_comment(variation.key->unit));
    }
    return text;
}

std::string correlation(Scene const& scene, Setting const&) {
    Correlation const& correlation = scene.design.correlation;
    std::size_t const n = correlation.variations.size();
    std::string keys, rows;
    for (std::size_t i = 0; i < n; ++i) {
        keys += fmt::format("\n    \"{}\",", scene.variations[correlation.variations[i]].key->name);
        rows += fmt::format("\n    {},", list_text(std::span(correlation.matrix).subspan(i * n, n)));
    }
    return n == 0 ? std::string() : fmt::format("keys = [{}\n]\nmatrix = [{}\n]\n", keys, rows);
}

std::string limits(Scene const& scene, Setting const&) {
    std::string text;
    for (Limit const& limit : scene.limits) {
        auto const& quantities = outputs_of(scene.parts.mechanism).quantities;
        auto const of = std::ranges::find_if(quantities, [&](QuantityInfo const& one) { return limit.quantity == one.name; });
        std::vector<std::string> ends;
        if (std::isfinite(limit.low)) ends.push_back("min = " + toml_number(limit.low));
        if (std::isfinite(limit.high)) ends.push_back("max = " + toml_number(limit.high));
        text += fmt::format("\"{}\" = {{ {} }}{}\n", limit.name(), fmt::join(ends, ", "), unit_comment(of->unit));
    }
    return text;
}

}  // namespace resolved

}  // namespace slideway
