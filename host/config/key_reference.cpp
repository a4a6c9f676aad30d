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

/// Names of those of a list that know a key; none where all do.  @param stands whether one is in the list at all
template <class Infos, class Knows, class Stands> std::vector<std::string_view> owners(Infos const& infos, Knows knows, Stands stands) {
    std::vector<std::string_view> names;
    bool all = true;
    for (std::size_t i = 0; i < std::size(infos); ++i) {
        if (!stands(i)) continue;
        if (knows(i)) names.push_back(infos[i]);
        else all = false;
    }
    if (all) names.clear();
    return names;
}
template <class Infos, class Knows> std::vector<std::string_view> owners(Infos const& infos, Knows knows) {
    return owners(infos, knows, [](std::size_t) { return true; });
}

/// What its numbers may be.
Range range_of(Setting const& key) {
    return key.type == Type::count ? Range{static_cast<double>(key.least), static_cast<double>(key.most)} : key.range;
}

Range usual_range(Setting const& key) { return key.physics != nullptr ? usual_range(*key.physics) : Range{}; }

/// Whether a mechanism knows a key that is no number of the physics.
bool is_of(Setting const& key, std::size_t mechanism) {
    MechanismInfo const& of = mechanisms()[mechanism];
    if (key.name == "contact.law") return of.spatial || may_be_rigid(static_cast<Mechanism>(mechanism));
    if (key.name == "drive.body") return true;  // of linkages, as its meaning says
    return (key.of == nullptr || of.spatial) && (key.table() != "drive" || of.drive != DriveKind::none);
}

/// Whether a number of the physics counts with a law, where it counts at all.
bool is_of_law(Key const& key, std::size_t law) {
    if (key.group == KeyGroup::mechanism) return true;
    Parts parts;
    choose_contact(parts, contact_law_names()[law]);
    return counts_for(key, parts) || !counts_for(key, parts.mechanism);
}

void put_range(Json& to, Range const& range, char const* least, char const* above, char const* most) {
    if (std::isfinite(range.low)) to[range.low_included ? least : above] = range.low;
    if (std::isfinite(range.high)) to[most] = range.high;
}

Json number_schema(Setting const& key) {
    Json number{{"type", "number"}};
    put_range(number, range_of(key), "minimum", "exclusiveMinimum", "maximum");
    // UDUNITS-2 is no regular expression: a number and something behind it, which is not a number again.
    char const* const with_unit = "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?\\s*([^-+.,0-9\\s].*)?$";
    return {{"anyOf", Json::array({number, Json{{"type", "string"}, {"pattern", with_unit}}})}};
}

Json value_schema(Setting const& key) {
    switch (key.type) {
        case Type::truth: return {{"type", "boolean"}};
        case Type::count: {
            Json count{{"type", "integer"}};
            put_range(count, range_of(key), "minimum", "exclusiveMinimum", "maximum");
            return count;
        }
        case Type::number: return number_schema(key);
        case Type::choice: return {{"enum", key.all_choices()}};
        case Type::text: return {{"type", "string"}};
        case Type::list: return {{"type", "array"}};
        case Type::table: return {{"type", "object"}};
    }
    return Json::object();
}

/// "; default 0.0001 (law paper)"
std::string preset_and_owners(Setting const& key) {
    std::string const owners = owners_text(key), preset = preset_text(key);
    return fmt::format("{}{}", preset.empty() ? "" : "; default " + preset, owners.empty() ? "" : fmt::format(" ({})", owners));
}

}  // namespace

std::string_view name_of(Type type) {
    static constexpr std::string_view names[] = {"boolean", "integer", "number", "choice", "text", "list", "table"};
    return names[static_cast<int>(type)];
}

std::array<std::vector<std::string_view>, 4> owners_of(Setting const& key) {
    Key const* const physics = key.physics;
    auto const of_mechanism = [&](std::size_t i) {
        if (physics == nullptr) return is_of(key, i);
        auto const kind = static_cast<Mechanism>(i);
        auto const turning = turning_form(kind);
        return counts_for(*physics, kind) || (turning && counts_for(*physics, *turning));
    };
    return {owners(mechanism_names(), of_mechanism, [](std::size_t i) { return mechanisms()[i].driven_form == nullptr; }),
            owners(contact_law_names(), [&](std::size_t i) { return physics == nullptr || is_of_law(*physics, i); }),
            owners(study_kind_names, [&](std::size_t i) { return (key.studies & set_of(static_cast<StudyKind>(i))) != 0; }),
            owners(setting("integrator.method").choices, [&](std::size_t i) { return (key.methods & set_of(static_cast<Method>(i))) != 0; })};
}

std::string domain_text(Setting const& key) {
    if (!key.all_choices().empty()) return fmt::format("{}", fmt::join(key.all_choices(), ", "));
    Range const range = range_of(key);
    std::string text;
    if (std::isfinite(range.low)) text = fmt::format("{} {:.10g}", range.low_included ? "≥" : ">", range.low);
    // Of what only keeps integers apart nobody asks.
    if (std::isfinite(range.high) && range.high < 1e18) text += fmt::format("{}≤ {:.10g}", text.empty() ? "" : ", ", range.high);
    return text;
}

std::string usual_text(Setting const& key) {
    Range const usual = usual_range(key);
    if (!std::isfinite(usual.high)) return {};
    return usual.low > 0 ? fmt::format("{:g}–{:g}", usual.low, usual.high) : fmt::format("≤ {:g}", usual.high);
}

namespace {

/// Names of mechanisms: a word for all in space, and for all but one.
std::string in_brief(std::vector<std::string_view> const& names) {
    std::vector<std::string_view> in_space, others;
    for (MechanismInfo const& one : mechanisms()) {
        if (one.driven_form != nullptr) continue;
        if (one.spatial) in_space.emplace_back(one.name);
        if (std::ranges::find(names, one.name) == names.end()) others.emplace_back(one.name);
    }
    if (names == in_space) return "in space";
    return !names.empty() && others.size() == 1 ? fmt::format("not {}", others.front()) : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string owners_text(Setting const& key, bool briefly) {
    std::string text;
    auto const add = [&](std::string_view what, std::string const& names) {
        if (!names.empty()) text += fmt::format("{}{}{}", text.empty() ? "" : "; ", what, names);
    };
    auto const of = owners_of(key);
    for (std::size_t i = 0; i < of.size(); ++i) add(i == 1 ? "law " : "", briefly && i == 0 ? in_brief(of[i]) : fmt::format("{}", fmt::join(of[i], ", ")));
    return text;
}

std::string described(Setting const& key) {
    std::string const domain = domain_text(key);
    return fmt::format("{}{}{}", key.meaning, domain.empty() ? "" : ": " + domain, preset_and_owners(key));
}

std::string keys_json(Settings keys) {
    Json list = Json::array();
    for (Setting const& key : keys) {
        Json one{{"name", key.name}, {"type", name_of(key.type)}};
        if (!key.unit.empty()) one["unit"] = key.unit;
        put_range(one, range_of(key), "minimum", "exclusive_minimum", "maximum");
        put_range(one, usual_range(key), "usual_minimum", "usual_minimum", "usual_maximum");
        if (!key.all_choices().empty()) one["choices"] = key.all_choices();
        if (std::string const preset = preset_text(key); !preset.empty()) one["default"] = preset;
        static constexpr char const* kinds[] = {"mechanisms", "laws", "studies", "methods"};
        auto const of = owners_of(key);
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (!of[i].empty()) one[kinds[i]] = of[i];
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

std::string scene_schema(Settings keys) {
    Json properties = Json::object();
    for (Setting const& key : keys) {
        Json value = value_schema(key);
        std::string const unit = key.unit.empty() || key.unit == "1" ? std::string() : fmt::format(" [{}]", key.unit);
        value["description"] = fmt::format("{}{}{}", key.meaning, unit, preset_and_owners(key));
        if (key.table().empty()) {
            properties[std::string(key.name)] = std::move(value);
            continue;
        }
        Json* table = &properties[std::string(key.table())];
        (*table)["type"] = "object";
        std::string_view name = key.key();
        // Tables of any name, each with these keys.
        if (auto const dot = name.find(".", name.starts_with('<') ? 0 : name.npos); dot != name.npos) {
            table = &(*table)["additionalProperties"];
            (*table)["type"] = "object";
            name.remove_prefix(dot + 1);
        }
        (*table)["additionalProperties"] = false;
        (*table)["properties"][std::string(name)] = std::move(value);
    }
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                {"title", "Scene of slideway"},
                {"type", "object"},
                {"required", {"schema"}},
                {"additionalProperties", false},
                {"properties", std::move(properties)}};
    return schema.dump(2) + "\n";
}

std::string keys_markdown(Settings keys) {
    std::string text =
        "# Keys of a scene\n\nEvery key that a scene may have. `slideway list --markdown` writes this page, `slideway list --json` the same for programs, and "
        "`slideway list --schema` a JSON Schema to editors of TOML\n(put `#:schema scene.schema.json` into a scene's first line for Taplo and Even Better "
        "TOML). Numbers are in SI units, or texts with a unit: `\"0.1 mm\"`, `\"30 rpm\"`.\n"
        "Outside its usual range a number, its sign aside, is a warning ([troubleshooting.md](../how_to/troubleshooting.md#warnings-of-unusual-numbers)).\n";
    std::string_view table = "none yet";
    for (Setting const& key : keys) {
        if (key.table() != table) {
            table = key.table();
            text += table.empty() ? "\n## At the top\n" : fmt::format("\n## [{}]\n", table);
            text += "| key | unit | domain | usual | default | meaning | for |\n|---|---|---|---|---|---|---|\n";
        }
        auto const cell = [](std::string_view words) {
            std::string safe;
            for (char const c : words) safe += c == '|' ? std::string("\\|") : std::string(1, c);
            return safe;
        };
        // A number needs no word, and a choice is its list.
        std::string domain = domain_text(key);
        if (key.type != Type::number && key.type != Type::choice) domain = fmt::format("{}{}{}", name_of(key.type), domain.empty() ? "" : ", ", domain);
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", key.key(), key.unit == "1" ? "" : key.unit, cell(domain), usual_text(key),
                            cell(preset_text(key)), cell(key.meaning), owners_text(key, true));
    }
    return text;
}

}  // namespace slideway
