#include "host/config/key_reference.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace slideway {
namespace {

using Json = nlohmann::ordered_json;
using Type = Setting::Type;

/// Names of those of a list that know a key; none where all do.
template <class Infos, class Knows> std::vector<std::string_view> owners(Infos const& infos, Knows knows) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < std::size(infos); ++i) {
        if (knows(i)) names.push_back(infos[i]);
    }
    if (names.size() == std::size(infos)) names.clear();
    return names;
}

KeyReference reference_of(Setting const& row) {
    KeyReference key{.name = row.name, .unit = row.unit, .meaning = row.meaning, .type = row.type, .range = row.range, .usual = {}, .choices = {},
                     .preset = preset_text(row), .mechanisms = {}, .laws = {}, .studies = {}, .methods = {}};
    if (row.type == Type::count) key.range = {static_cast<double>(row.least), static_cast<double>(row.most)};
    key.choices.assign(row.all_choices().begin(), row.all_choices().end());
    key.studies = owners(study_kind_names, [&](std::size_t i) { return (row.studies & set_of(static_cast<StudyKind>(i))) != 0; });
    key.methods = owners(setting("integrator.method").choices, [&](std::size_t i) { return (row.methods & set_of(static_cast<Method>(i))) != 0; });
    bool const of_free_cranks = row.name == "mechanism.crank", of_laws = row.name == "contact.law";
    key.mechanisms = owners(mechanism_names(), [&](std::size_t i) {
        if (of_laws) return mechanisms()[i].spatial || may_be_rigid(static_cast<Mechanism>(i));
        return (!row.of_faces || mechanisms()[i].spatial) && (!of_free_cranks || mechanisms()[i].free_crank);
    });
    return key;
}

KeyReference reference_of(Key const& of) {
    KeyReference key{.name = of.name, .unit = of.unit, .meaning = of.meaning, .type = Type::number, .range = range_of(of.rule), .usual = usual_range(of), .choices = {},
                     .preset = {}, .mechanisms = {}, .laws = {}, .studies = {}, .methods = {}};
    key.preset = of.member == &Inputs::restitution ? "" : std::isnan(of.preset) ? "derived: " + derivations_of(of) : fmt::format("{:.10g}", of.preset);
    key.mechanisms = owners(mechanism_names(), [&](std::size_t i) { return counts_for(of, static_cast<Mechanism>(i)); });
    key.laws = of.group == KeyGroup::mechanism ? std::vector<std::string_view>() : owners(contact_law_names(), [&](std::size_t i) {
        Parts parts;
        parts.rigid = i == law_names().size();
        if (!parts.rigid) parts.law = static_cast<Law>(i);
        return counts_for(of, parts) || !counts_for(of, parts.mechanism);
    });
    return key;
}

void put_range(Json& to, Range const& range, char const* least, char const* above, char const* most) {
    if (std::isfinite(range.low)) to[range.low_included ? least : above] = range.low;
    if (std::isfinite(range.high)) to[most] = range.high;
}

Json number_schema(KeyReference const& key) {
    Json number{{"type", "number"}};
    put_range(number, key.range, "minimum", "exclusiveMinimum", "maximum");
    // UDUNITS-2 is no regular expression: a number and something behind it, which is not a number again.
    char const* const with_unit = "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?\\s*([^-+.,0-9\\s].*)?$";
    return {{"anyOf", Json::array({number, Json{{"type", "string"}, {"pattern", with_unit}}})}};
}

Json value_schema(KeyReference const& key) {
    switch (key.type) {
        case Type::truth: return {{"type", "boolean"}};
        case Type::count: {
            Json count{{"type", "integer"}};
            put_range(count, key.range, "minimum", "exclusiveMinimum", "maximum");
            return count;
        }
        case Type::number: return number_schema(key);
        case Type::choice: return {{"enum", key.choices}};
        case Type::text: return {{"type", "string"}};
        case Type::list: return {{"type", "array"}};
        case Type::table: return {{"type", "object"}};
    }
    return Json::object();
}

/// "; default 0.0001 (law paper)"
std::string preset_and_owners(KeyReference const& key) {
    std::string const owners = owners_text(key);
    return fmt::format("{}{}", key.preset.empty() ? "" : "; default " + key.preset, owners.empty() ? "" : fmt::format(" ({})", owners));
}

}  // namespace

std::string_view name_of(Type type) {
    static constexpr std::string_view names[] = {"boolean", "integer", "number", "choice", "text", "list", "table"};
    return names[static_cast<int>(type)];
}

std::string domain_text(KeyReference const& key) {
    if (!key.choices.empty()) return fmt::format("{}", fmt::join(key.choices, ", "));
    std::string text;
    if (std::isfinite(key.range.low)) text = fmt::format("{} {:.10g}", key.range.low_included ? "≥" : ">", key.range.low);
    // Of what only keeps integers apart nobody asks.
    if (std::isfinite(key.range.high) && key.range.high < 1e18) text += fmt::format("{}≤ {:.10g}", text.empty() ? "" : ", ", key.range.high);
    return text;
}

std::string usual_text(KeyReference const& key) {
    if (!std::isfinite(key.usual.high)) return {};
    return key.usual.low > 0 ? fmt::format("{:g} to {:g}", key.usual.low, key.usual.high) : fmt::format("≤ {:g}", key.usual.high);
}

std::string owners_text(KeyReference const& key) {
    std::string text;
    auto const add = [&](char const* what, std::vector<std::string_view> const& names) {
        if (!names.empty()) text += fmt::format("{}{}{}", text.empty() ? "" : "; ", what, fmt::join(names, ", "));
    };
    add("", key.mechanisms);
    add("law ", key.laws);
    add("", key.studies);
    add("", key.methods);
    return text;
}

std::vector<KeyReference> key_references(Settings rows) {
    std::vector<KeyReference> all;
    for (Setting const& row : rows) all.push_back(reference_of(row));
    for (Key const& key : numeric_keys()) all.push_back(reference_of(key));
    static constexpr std::string_view tables[] = {"", "modules", "mechanism", "joint", "material", "way", "contact", "friction", "initial", "integrator", "study"};
    std::ranges::stable_sort(all, {}, [](KeyReference const& key) { return std::ranges::find(tables, key.table()) - tables; });
    return all;
}

std::vector<KeyReference> const& known_keys() {
    static OfAllKnown<std::vector<KeyReference>> all([] { return key_references(settings()); });
    return all();
}

std::string described(KeyReference const& key) {
    std::string const domain = domain_text(key);
    return fmt::format("{}{}{}", key.meaning, domain.empty() ? "" : ": " + domain, preset_and_owners(key));
}

std::string keys_json(std::vector<KeyReference> const& keys) {
    Json list = Json::array();
    for (KeyReference const& key : keys) {
        Json one{{"name", key.name}, {"type", name_of(key.type)}};
        if (!key.unit.empty()) one["unit"] = key.unit;
        put_range(one, key.range, "minimum", "exclusive_minimum", "maximum");
        put_range(one, key.usual, "usual_minimum", "usual_minimum", "usual_maximum");
        if (!key.choices.empty()) one["choices"] = key.choices;
        if (!key.preset.empty()) one["default"] = key.preset;
        for (auto const& [what, names] : {std::pair{"mechanisms", &key.mechanisms}, {"laws", &key.laws}, {"studies", &key.studies}, {"methods", &key.methods}}) {
            if (!names->empty()) one[what] = *names;
        }
        one["meaning"] = key.meaning;
        list.push_back(std::move(one));
    }
    // Which laws and mechanisms there are, and of modules where they come from.
    auto const known = [](auto const& infos, auto const& words, auto module_at) {
        Json all = Json::array();
        for (std::size_t i = 0; i < infos.size(); ++i) {
            Json one{{"name", infos[i].name}, {"meaning", words(infos[i])}};
            if (OwnModule const* const own = module_at(i))
                one["module"] = {{"folder", own->folder.string()}, {"source", own->source}, {"compiler", own->described->compiler}};
            all.push_back(std::move(one));
        }
        return all;
    };
    Json of_laws = known(laws(), [](LawInfo const& one) { return one.words; }, [](std::size_t i) { return module_of(static_cast<Law>(i)); });
    Json of_mechanisms = known(mechanisms(), [](MechanismInfo const& one) { return one.meaning; }, [](std::size_t i) { return module_of(static_cast<Mechanism>(i)); });
    return Json{{"schema_version", 1}, {"keys", std::move(list)}, {"laws", std::move(of_laws)}, {"mechanisms", std::move(of_mechanisms)}}.dump(2) + "\n";
}

std::string scene_schema(std::vector<KeyReference> const& keys) {
    Json properties = Json::object();
    for (KeyReference const& key : keys) {
        Json value = value_schema(key);
        std::string const unit = key.unit.empty() || key.unit == "1" ? std::string() : fmt::format(" [{}]", key.unit);
        value["description"] = fmt::format("{}{}{}", key.meaning, unit, preset_and_owners(key));
        if (key.table().empty()) {
            properties[std::string(key.name)] = std::move(value);
            continue;
        }
        Json& table = properties[std::string(key.table())];
        table["type"] = "object";
        table["additionalProperties"] = false;
        table["properties"][std::string(key.key())] = std::move(value);
    }
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                {"title", "Scene of slideway"},
                {"type", "object"},
                {"required", {"schema"}},
                {"additionalProperties", false},
                {"properties", std::move(properties)}};
    return schema.dump(2) + "\n";
}

std::string keys_markdown(std::vector<KeyReference> const& keys) {
    std::string text =
        "# Keys of a scene\n\nEvery key that a scene may have. `slideway list --markdown` writes this page, `slideway list --json` the same for programs, and "
        "`slideway list --schema` a JSON Schema to editors of TOML\n(put `#:schema scene.schema.json` into a scene's first line for Taplo and Even Better "
        "TOML). Numbers are in SI units, or texts with a unit: `\"0.1 mm\"`, `\"30 rpm\"`.\n"
        "Outside its usual range a number, its sign aside, is a warning ([troubleshooting.md](troubleshooting.md#warnings-of-unusual-numbers)).\n";
    std::string_view table = "none yet";
    for (KeyReference const& key : keys) {
        if (key.table() != table) {
            table = key.table();
            text += table.empty() ? "\n## At the top\n" : fmt::format("\n## [{}]\n", table);
            text += "| key | type | unit | domain | usual | default | meaning | applies to |\n|---|---|---|---|---|---|---|---|\n";
        }
        auto const cell = [](std::string_view words) {
            std::string safe;
            for (char const c : words) safe += c == '|' ? std::string("\\|") : std::string(1, c);
            return safe;
        };
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} |\n", key.key(), name_of(key.type),
                            key.unit == "1" ? "" : key.unit, cell(domain_text(key)), usual_text(key), cell(key.preset), cell(key.meaning), owners_text(key));
    }
    return text;
}

}  // namespace slideway
