// What is told of the keys of a scene: lists, JSON, JSON Schema and pages, all of them loops over the table of keys.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/settings.hpp"

namespace slideway {

/// Mechanisms, laws, studies and methods that know a key; none where all do.
std::array<std::vector<std::string_view>, 4> owners_of(Setting const& key);

/// "number", "integer", "true or false", "one of", …
std::string_view name_of(Setting::Type type);
/// "> 0", "from 0 to 1, 1 included"; "" where any number will do.
std::string domain_text(Setting const& key);

/// "0.0001–10"; "" where any number is usual.
std::string usual_text(Setting const& key);

/// "slider_crank, carriage; law paper": who knows it; "" where all do.
/// @param briefly with a word for mechanisms in space, or for all but one
std::string owners_text(Setting const& key, bool briefly = false);

/// "clearance per side: > 0; default 0.0001 (law paper)"
std::string described(Setting const& key);

/// What `slideway list --json` prints: laws and mechanisms by name, with folder, source and compiler of those of modules; one object per key: name, type, unit, minimum or exclusive_minimum, maximum, choices, default, mechanisms, laws, studies, methods, meaning.
std::string keys_json(Settings keys = known_keys());
/// JSON Schema (draft 7) of scenes, for editors of TOML.
std::string scene_schema(Settings keys = known_keys());
/// docs/reference/keys.md.
std::string keys_markdown(Settings keys = known_keys());

}  // namespace slideway
