// Every numeric key of a scene's physics in one table: reading, --set, [study.vary], probe columns, the resolved
// scene and the variables of result files all go by it.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/descriptors.hpp"
#include "kernels/inputs.hpp"

namespace slideway {

/// Whether a key means anything for a mechanism, whatever its law.
bool counts_for(Key const& key, Mechanism mechanism);
/// The same with the scene's law.
bool counts_for(Key const& key, Parts const& parts);
/// Whether the drive is why it does not: another kind has it, or a profile says how fast.
bool is_replaced_by_drive(Key const& key, Parts const& parts);

/// Every numeric key as it stands where it is defined, which is for good: one per input, in the order of `Inputs`, with what laws and mechanisms have of
/// their own, those of modules too; and behind them those that set two inputs at once, joint.clearance and contact.young_modulus.
std::span<Key const* const> every_key();
inline constexpr std::size_t twin_count = 2;

inline auto keys_behind(std::span<Key const* const> pointers) {
    return pointers | std::views::transform([](Key const* key) -> Key const& { return *key; });
}
inline auto keys() { return keys_behind(every_key().first(every_key().size() - twin_count)); }
inline auto twin_keys() { return keys_behind(every_key().last(twin_count)); }
inline auto numeric_keys() { return keys_behind(every_key()); }
std::vector<std::string_view> numeric_key_names();
/// One of them; nullptr when there is none.
Key const* find_key(std::string_view dotted_name);

/// How a number follows that a scene does not give, in words of the last parts of keys; empty of one that follows from none.  Where a rod's or
/// a crank's section is as it is when nobody gives it, with that of the paper.
/// @param inputs of the scene: they say which solid the slider is
std::string derivation_of(Key const& key, Parts const& parts, Inputs const& inputs);
/// All ways in which it may follow, with any mechanism: one, or several that "or" joins.
std::string derivations_of(Key const& key);
/// Whether a key counts for nothing but what follows from it (material.density, joint.wall …), and a scene gives all of that.
bool is_idle_source(Key const& key, Parts const& parts, Inputs const& inputs);

/// What contact.restitution replaces.
inline constexpr std::string_view rates_of_damping[] = {"contact.eta", "contact.chi_line", "contact.chi_surface"};

/// Whether a key says where the way's faces lie: way.* and the clearances of single faces.
bool lays_way(Key const& key);
/// Whether a key says where the slider's centre of mass or its pin lies: slider.*.
bool is_of_body(Key const& key);

/// Puts in the kernel part that `key` needs if it is to differ from its default or between members: the way's pose
/// for way.* and clearances of single faces, mass centre and pin for slider.*, the rates for contact.chi_*, restitution for contact.restitution, friction for friction.*.
/// @param key that counts for the parts
void require_part(Parts& parts, Key const& key);

/// The inputs with what a law, or a mechanism too, has of its own as it is when nobody gives it.
Inputs with_presets(Inputs inputs, Law law);
Inputs with_presets(Inputs inputs, Parts const& parts);

/// Why a set of inputs cannot be used, in words ("joint.clearance_y is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm"),
/// or nothing.  Checks every key's rule and those between keys of the mechanism (slip_speed > stick_speed …).
std::optional<std::string> defect(Inputs const& inputs, Parts const& parts = {});

// Why a number cannot be used: the words behind `defect`, in the parts that the reader needs for its positions.

/// `reason` goes into the parentheses of a message, `advice` after the semicolon.
struct Problem {
    std::string reason;
    std::string advice;
};

/// What a number may be; the words of a refusal come from the limits.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_included = true;

    bool contains(double value) const { return (low_included ? value >= low : value > low) && value <= high; }
};

/// What a rule allows.
Range range_of(Rule rule);

/// The problem of one value with its key's rule; NaN and infinity break every rule.
std::optional<Problem> broken_rule(Key const& key, double value);

/// What numbers of a key usually are, by magnitude where it may be negative.  A number outside may be right, and is likelier a slip.
Range usual_range(Key const& key);

/// What is unusual about a number, in words ("is 1 m (usually 1e-08 to 0.01 m); did you mean \"1 mm\"?"), or nothing.
std::optional<std::string> unusual(Key const& key, double value, bool has_unit = false);

/// The same of numbers that are usual each and not together: a clearance that is large beside the way, a fast crank pin.  With the key to blame.
std::optional<std::pair<Key const*, std::string>> unusual_pair(Inputs const& inputs, Parts const& parts);

/// What `defect` found: the key to blame, and another one whose value it clashes with (nullptr if none).
struct Defect {
    Key const* key;
    Key const* other;
    double value;
    Problem problem;
};
std::optional<Defect> find_defect(Inputs const& inputs, Parts const& parts);

/// "0.05 m"; a plain number for the unit "1".
std::string with_unit(double value, std::string_view unit);

}  // namespace slideway
