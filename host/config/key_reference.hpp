// All keys of a scene as one list, whatever table they come from, and what is made of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/config/settings.hpp"

namespace slideway {

/// A key with all that a user may ask of it.
struct KeyReference {
    std::string_view name, unit, meaning;
    Setting::Type type = Setting::Type::number;
    Range range;                                // of numbers and counts
    std::vector<std::string_view> choices;
    std::string preset;                         // "" for nothing
    std::vector<std::string_view> mechanisms, laws, studies, methods;  // that know it; empty: all
};

/// In the order of a scene's tables.
std::vector<KeyReference> key_references(Settings rows = settings());

/// What a rule of the physics allows.
Range range_of(Rule rule);
/// "number", "integer", "true or false", "one of", …
std::string_view name_of(Setting::Type type);
/// "> 0", "from 0 to 1, 1 included"; "" where any number will do.
std::string domain_text(KeyReference const& key);

/// "slider_crank, carriage; law paper": who knows it; "" where all do.
std::string owners_text(KeyReference const& key);

/// One object per key: name, type, unit, minimum or exclusive_minimum, maximum, choices, default, mechanisms, laws, studies, methods, meaning.
std::string keys_json(std::vector<KeyReference> const& keys = key_references());
/// JSON Schema (draft 7) of scenes, for editors of TOML.
std::string scene_schema(std::vector<KeyReference> const& keys = key_references());
/// docs/keys.md.
std::string keys_markdown(std::vector<KeyReference> const& keys = key_references());

}  // namespace slideway
