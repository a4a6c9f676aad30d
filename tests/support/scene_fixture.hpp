// Scenes as text for the tests of host/config.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/descriptors.hpp"
#include "host/config/scene.hpp"
#include "kernels/mechanisms/list.hpp"

namespace slideway::testing {

/// A scene that says nothing of its law has the paper's here, whose contacts have all keys.
inline Scene scene_of(std::string_view text, Overrides overrides = {}) {
    bool const of_text = text.find("law =") != text.npos || text.find("planar") != text.npos || text.find("\"linkage\"") != text.npos;
    bool const of_overrides = std::ranges::any_of(
        overrides, [](auto const& one) { return one.first == "contact.law" || one.second.find("planar") != one.second.npos; });
    if (!of_text && !of_overrides) overrides.insert(overrides.begin(), {"contact.law", "paper"});
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

/// Every mechanism as a scene names it, those with eight apices under every law.
inline std::vector<Parts> mechanisms_and_laws() {
    std::vector<Parts> all;
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (mechanisms()[i].driven_form != nullptr) continue;
        Parts parts;
        parts.mechanism = static_cast<Mechanism>(i);
        all.push_back(parts);
        for (std::size_t law = 1; mechanisms()[i].spatial && law < laws().size(); ++law) {
            parts.law = static_cast<Law>(law);
            all.push_back(parts);
        }
    }
    return all;
}

inline std::string name_of(Key const& key, Parts const& parts) {
    return std::string(key.name) + " of " + info(parts.mechanism).name + ", " + std::string(info(parts.law).name);
}

/// The slider-crank under every drive.
inline std::vector<Parts> drives() {
    Mechanism const turning = *turning_form(Mechanism::slider_crank);
    return {{.mechanism = turning, .drive = {.by = DriveBy::nothing}},
            {.mechanism = turning, .drive = {.by = DriveBy::torque}},
            {.mechanism = Mechanism::slider_crank, .drive = {.by = DriveBy::profile}}};
}

/// The first of them for which a key counts.  @throws std::logic_error if it counts for none
inline Parts parts_with(Key const& key) {
    auto all = mechanisms_and_laws();
    std::ranges::copy(drives(), std::back_inserter(all));
    for (Parts const& parts : all) {
        if (counts_for(key, parts)) return parts;
    }
    throw std::logic_error(std::string(key.name) + " counts for no mechanism and law");
}

inline std::string read_text(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace slideway::testing
