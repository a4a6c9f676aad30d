// Every key of a scene that is no number of the physics (those are in keys.hpp), said once: reading, suggestions, --set, the resolved scene,
// `slideway list`, the JSON Schema, docs/keys.md and Python's help follow from these rows.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "host/config/keys.hpp"
#include "host/config/scene.hpp"

namespace slideway {

/// A set of studies: bit i for StudyKind i.
using StudySet = unsigned;
constexpr StudySet set_of(StudyKind kind) { return 1u << static_cast<int>(kind); }

namespace study_sets {
inline constexpr StudySet ensemble = set_of(StudyKind::ensemble), lyapunov = set_of(StudyKind::lyapunov),
                          poincare = set_of(StudyKind::poincare), sweep = set_of(StudyKind::sweep),
                          tolerance = set_of(StudyKind::tolerance);
inline constexpr StudySet chaos = lyapunov | poincare | sweep, to_end = ensemble | tolerance, all = to_end | chaos;
}  // namespace study_sets

/// A set of methods: bit i for Method i.
using MethodSet = unsigned;
constexpr MethodSet set_of(Method method) { return 1u << static_cast<int>(method); }

namespace method_sets {
inline constexpr MethodSet all = (1u << method_count) - 1, fixed = set_of(Method::rk4) | set_of(Method::moreau_jean), controlled = all & ~fixed,
                           stiff = set_of(Method::automatic) | set_of(Method::ros34pw2),
                           explicit_pairs = controlled & ~set_of(Method::ros34pw2);
}  // namespace method_sets

struct Setting {
    enum class Type { truth, count, number, choice, text, list, table };

    std::string_view name;  // dotted
    Type type;
    std::string_view unit;     // SI, of a number; "1" for a plain one
    std::string_view meaning;  // one sentence
    std::string_view preset;   // what it is where nobody gives it; "": as `Scene` has it; "-": nothing
    StudySet studies = study_sets::all;
    std::string_view what = {};                                                            // in refusals: "number of members"
    Range range = {};                                                                      // of a number
    std::uint64_t least = 0, most = std::numeric_limits<std::int64_t>::max();              // of a count
    std::span<std::string_view const> choices = {};                                        // of a choice
    std::span<std::string_view const> (*known)() = nullptr;                                // of one that modules add to, in the place of choices
    std::array<std::string_view, 4> rivals = {};                                           // say the same in other words: given later, one replaces them
    MethodSet methods = method_sets::all;                                                  // that read it
    bool of_faces = false;                                                                 // a mechanism whose corners are points does not
    // Where it goes in a scene, if that is one number: then it is read and written by its row.
    double& (*number)(Scene&) = nullptr;
    std::uint64_t& (*count)(Scene&) = nullptr;
    bool& (*truth)(Scene&) = nullptr;

    constexpr std::string_view table() const { return name.substr(0, name.find('.')); }
    constexpr std::string_view key() const { return name.substr(name.find('.') + 1); }
    std::span<std::string_view const> all_choices() const { return known != nullptr ? known() : choices; }
    bool is_bound() const { return number != nullptr || count != nullptr || truth != nullptr; }
};

using Settings = std::span<Setting const>;
/// In the order in which a scene has them.
Settings settings();

/// @throws std::logic_error if there is no such row
Setting const& setting(std::string_view name, Settings rows = settings());

/// Whether a scene's method, mechanism and contacts read a setting of [integrator].
bool has_effect(Setting const& setting, Method method, Parts const& parts);

/// What a scene has of a bound setting, as TOML; the default where nobody gives one, where that is a value: "1e-06", "false"
std::string value_text(Setting const& setting, Scene const& scene);
std::string preset_text(Setting const& setting);

/// Steps of a member that reaches its end by `fixed_step`; a whole number.
double fixed_steps(IntegratorSettings const& settings);

/// Largest study.members.
inline constexpr std::uint64_t most_members = 1'000'000'000;
inline constexpr std::uint64_t most_verified = 1'000'000;  // members that run again
/// Largest integrator.max_steps.
inline constexpr std::uint64_t most_steps = 1'000'000'000'000'000;
/// Longest study [s].
inline constexpr double longest_time = 1e9;

}  // namespace slideway
