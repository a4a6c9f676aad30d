// All keys of a scene as one list, whatever table they come from, and what is made of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/config/settings.hpp"

namespace slideway {

/// A key with all that a user may ask of it, whether it is a number of the physics or a setting.
struct KeyReference {
    std::string_view name, unit, meaning;
    Setting::Type type = Setting::Type::number;
    Range range;                                // of numbers and counts
    Range usual;                                // of numbers of the physics, by magnitude
    std::vector<std::string_view> choices;
    std::string preset;                         // "" for nothing
    std::vector<std::string_view> mechanisms, laws, studies, methods;  // that know it; empty: all

    /// "" of those at the top
    std::string_view table() const { return key() == name ? std::string_view() : name.substr(0, name.find('.')); }
    std::string_view key() const { return name.substr(name.find('.') + 1); }
};

/// In the order of a scene's tables; of these settings.
std::vector<KeyReference> key_references(Settings rows);
/// Of all settings.
std::vector<KeyReference> const& known_keys();

/// "number", "integer", "true or false", "one of", …
std::string_view name_of(Setting::Type type);
/// "> 0", "from 0 to 1, 1 included"; "" where any number will do.
std::string domain_text(KeyReference const& key);

/// "0.0001 to 10"; "" where any number is usual.
std::string usual_text(KeyReference const& key);

/// "slider_crank, carriage; law paper": who knows it; "" where all do.
std::string owners_text(KeyReference const& key);

/// "clearance per side: > 0; default 0.0001 (law paper)"
std::string described(KeyReference const& key);

/// What `slideway list --json` prints: laws and mechanisms by name, with folder, source and compiler of those of modules; one object per key: name, type, unit, minimum or exclusive_minimum, maximum, choices, default, mechanisms, laws, studies, methods, meaning.
std::string keys_json(std::vector<KeyReference> const& keys = known_keys());
/// JSON Schema (draft 7) of scenes, for editors of TOML.
std::string scene_schema(std::vector<KeyReference> const& keys = known_keys());
/// docs/keys.md.
std::string keys_markdown(std::vector<KeyReference> const& keys = known_keys());

}  // namespace slideway
