// What a numeric key of a scene is.  Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <string_view>

namespace slideway {

struct Inputs;

/// What values a key may take.
enum class Rule {
    any,
    positive,         // > 0
    not_negative,     // >= 0
    gap,              // of the joint; < 0: a preload that is elastic
    unit_interval,    // [0, 1]
    poisson_ratio,    // (-1, 0.5]
    hertz_exponent,   // [1, 3]
    right_angle,      // [-π/2, π/2]
};

/// What must be there for a key to mean anything.  A mechanism and a contact law say which groups they have.
enum class KeyGroup {
    slider,      // every mechanism has one
    spatial,     // a slider with eight apices on a way with four faces
    planar,      // a block between two walls, and its crank
    body,        // a slider whose centre of mass may lie anywhere
    pin,         // and its pin
    crank,       // what turns at crank_speed
    links,       // crank and rod
    turning,     // a crank whose own inertia counts
    drive,       // what turns or moves it
    rod_centre,  // a rod whose centre of mass need not lie in its middle
    carriage,    // a drive to and fro
    along,       // a slider that nothing holds along its way
    // of contacts
    elastic,        // two bodies of Young's moduli
    hertz,          // point contacts K δⁿ
    point_damping,  // η of point contacts
    edges,          // line contacts
    surfaces,       // χ of surface contacts
    restitution,    // a coefficient of restitution in place of η and χ
    law,            // what a contact law has of its own
    mechanism,      // what a mechanism has of its own
    load,           // what a scene's loads are
    smooth_friction,  // speeds over which friction rises and falls; rigid contacts have none
};
using KeyGroups = unsigned;
template <class... Groups> constexpr KeyGroups groups_of(Groups... groups) {
    return (0u | ... | (1u << static_cast<int>(groups)));
}
constexpr bool has_group(KeyGroups groups, KeyGroup group) { return (groups & groups_of(group)) != 0; }
/// Those of which contact.law says whether they count.
inline constexpr KeyGroups contact_groups =
    groups_of(KeyGroup::elastic, KeyGroup::hertz, KeyGroup::point_damping, KeyGroup::edges, KeyGroup::surfaces, KeyGroup::restitution);

struct Key {
    std::string_view name;  // dotted, as in the scene: "mechanism.crank_length"
    double Inputs::*member;
    std::string_view unit;  // SI, UDUNITS-2 syntax; "1" for a plain number
    Rule rule;
    KeyGroup group;
    std::string_view meaning;        // "crank length"
    double preset;                   // the value that it has when nobody gives one; NaN: it follows from others
    double Inputs::*twin = nullptr;  // a second input that the key sets too: joint.clearance, contact.young_modulus
    std::string_view derivation = {};  // of a law's own number without a preset: what the law takes for it

    constexpr double get(Inputs const& inputs) const;
    constexpr void set(Inputs& inputs, double value) const;
    constexpr bool sets(double Inputs::*input) const { return member == input || twin == input; }
    /// Whether both set the same input.
    constexpr bool overlaps(Key const& other) const {
        return sets(other.member) || (other.twin != nullptr && sets(other.twin));
    }
};

}  // namespace slideway
