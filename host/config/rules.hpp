// What keys of a scene ask of one another: a table beside that of the keys, which the reader walks as it gets to know the scene.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/config/settings.hpp"

namespace slideway {

struct Reading;

/// What of a scene is read when a rule is looked at, one after the other.
enum class Known {
    mechanism,
    contacts,
    variation,   // a key that varies: of its rules alone
    study_kind,
    members,     // how they are spread
    orbits,      // their lengths of time
    study,       // all of [study]
    method,      // on which contacts
    integrator,  // all of [integrator]
    all
};

struct KeyRule {
    enum class What {
        excludes,  // refused where it is given: "contact.eta is 0.1 (contact.restitution replaces it); remove one of the two"
        foreign,   // the same of what the mechanism has not: "way has no meaning for kind = "free_slider"; remove it"
        cannot,    // refused given or not: "study.phase is not given (…); give study.section"
        needs,     // refused where it is not given: "study.base is missing (…); add base = 256"
        idle,      // a warning where it is given: "study.levels has no effect with design "mc""
        warns      // a warning, whether or not it is given: "why; instead"
    };
    Known after;
    std::string_view key;  // dotted
    bool (*when)(Reading const& reading);
    What what;
    std::string_view why = {}, instead = {};     // "{mechanism}", "{law}" … stand for the scene's (rules.cpp)
    std::string_view asking = "study.kind";  // of `needs`: where the message points
};

using KeyRules = std::span<KeyRule const>;
KeyRules key_rules();

/// The scene of a text, by other tables than its own (scene.hpp).
Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides, Settings rows, KeyRules rules, Scene const* former = nullptr);

/// Does what the rules of a stage say.  @throws SceneError
void apply_rules(Reading& reading, Known known);
/// Of a key that varies: refuses it at `node`, where a rule excludes it.
void apply_rules(Reading const& reading, Key const& varied, Node const& node);

/// Methods that there are for a mechanism with its contacts: those that no rule excludes.
MethodSet methods_of(Parts const& parts);

}  // namespace slideway
