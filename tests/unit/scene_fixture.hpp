// Scenes as text for the tests of host/scene.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "host/scene/scene.hpp"

namespace slideway::testing {

inline Scene scene_of(std::string_view text, Overrides const& overrides = {}) {
    return parse_scene(std::string(text), "scene.toml", overrides);
}

/// The line that refuses a scene; empty if the scene is accepted.
inline std::string error_of(std::string_view text, Overrides const& overrides = {}) {
    try {
        scene_of(text, overrides);
    } catch (SceneError const& error) {
        return error.what();
    }
    return {};
}

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

inline std::string read_text(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace slideway::testing
