// Every numeric key of a scene's physics in one table: reading, --set, [study.vary], probe columns, the resolved
// scene and the variables of result files all go by it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kernels/inputs.hpp"

namespace slideway {

/// A set of mechanisms: bit i for Mechanism i.
using MechanismSet = unsigned;
constexpr MechanismSet set_of(Mechanism mechanism) { return 1u << static_cast<int>(mechanism); }

/// What values a key may take.
enum class Rule {
    any,
    positive,        // > 0
    not_negative,    // >= 0
    gap,             // > 0, the reason being the joint's clearance
    unit_interval,   // [0, 1]
    half_open_unit,  // (0, 1]
    poisson_ratio,   // (-1, 0.5]
    hertz_exponent,  // [1, 3]
    right_angle,     // [-π/2, π/2]
};

struct Key {
    std::string_view name;  // dotted, as in the scene: "mechanism.crank_length"
    double Inputs::*member;
    std::string_view unit;  // SI, UDUNITS-2 syntax; "1" for a plain number
    Rule rule;
    std::string_view meaning;        // "crank length r"
    MechanismSet mechanisms;         // for which it counts
    double Inputs::*twin = nullptr;  // a second input that the key sets too: joint.clearance, contact.young_modulus

    bool counts_for(Mechanism mechanism) const { return (mechanisms & set_of(mechanism)) != 0; }
    double get(Inputs const& inputs) const { return inputs.*member; }
    void set(Inputs& inputs, double value) const {
        inputs.*member = value;
        if (twin != nullptr) inputs.*twin = value;
    }
    bool overlaps(Key const& other) const;  // do both set the same input?
};

/// One key per input, in the order of `Inputs`.
std::span<Key const> keys();
/// The keys that set two inputs at once: joint.clearance, contact.young_modulus.
std::span<Key const> twin_keys();
/// Any of both; nullptr when there is none.
Key const* find_key(std::string_view dotted_name);

/// Puts in the kernel part that `key` needs if it is to differ from its default or between members: the way's pose
/// for way.*, the rates for contact.chi_*, restitution for contact.restitution, friction for friction.*.
void require_part(Parts& parts, Key const& key);

/// Fills what was left to follow from other inputs (masses, inertias, thicknesses, point stiffness; model.md 2).
Inputs complete_inputs(Inputs given);

/// Why a set of inputs cannot be used, in words ("joint.clearance_y is 0 m (the joint needs a gap); use a value > 0"),
/// or nothing.  Checks every key's rule and those between keys of the mechanism (slip_speed > stick_speed …).
std::optional<std::string> defect(Inputs const& inputs, Parts const& parts = {});

}  // namespace slideway
