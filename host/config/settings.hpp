// The table of keys: every key of a scene once.  Those that are no number of the physics have their rows here, those of the physics stand in keys.hpp
// and get a row each.  Reading, suggestions, --set, the resolved scene, `slideway list`, the JSON Schema, docs/reference/keys.md and Python's help are loops over it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/config/keys.hpp"
#include "host/config/scene.hpp"

namespace slideway {

struct Node;

/// A set of studies: bit i for StudyKind i.
using StudySet = unsigned;
constexpr StudySet set_of(StudyKind kind) { return 1u << static_cast<int>(kind); }

namespace study_sets {
inline constexpr StudySet ensemble = set_of(StudyKind::ensemble), lyapunov = set_of(StudyKind::lyapunov), poincare = set_of(StudyKind::poincare),
                          sweep = set_of(StudyKind::sweep), tolerance = set_of(StudyKind::tolerance);
inline constexpr StudySet chaos = lyapunov | poincare | sweep, to_end = ensemble | tolerance, all = to_end | chaos;
}  // namespace study_sets

/// A set of methods: bit i for Method i.
using MethodSet = unsigned;
constexpr MethodSet set_of(Method method) { return 1u << static_cast<int>(method); }

namespace method_sets {
inline constexpr MethodSet all = (1u << method_count) - 1, fixed = set_of(Method::rk4) | set_of(Method::moreau_jean), controlled = all & ~fixed,
                           stiff = set_of(Method::automatic) | set_of(Method::ros34pw2), explicit_pairs = controlled & ~set_of(Method::ros34pw2);
}  // namespace method_sets

struct Setting;

/// How a key goes into a scene, and back into text.
struct Access {
    void (*read)(Scene& scene, Node const& node, Setting const& row) = nullptr;   // none: the reader has code for it
    std::string (*text)(Scene const& scene, Setting const& row) = nullptr;        // as TOML; "", or none: the resolved scene does not have it
};

struct Setting {
    enum class Type { truth, count, number, choice, text, list, table };

    std::string_view name;  // dotted
    Type type;
    std::string_view unit;     // SI, of a number; "1" for a plain one
    std::string_view meaning;  // one sentence
    std::string_view preset;   // what it is where nobody gives it; "": as `Scene` has it; "-": nothing
    StudySet studies = study_sets::all;
    std::string_view what = {};                                                // in refusals: "number of members"
    Range range = {};                                                          // of a number
    std::uint64_t least = 0, most = std::numeric_limits<std::int64_t>::max();  // of a count
    std::span<std::string_view const> choices = {};                            // of a choice
    std::span<std::string_view const> (*known)() = nullptr;                    // of one that modules add to, in the place of choices
    std::array<std::string_view, 4> rivals = {};                               // say the same in other words: given later, one replaces them
    MethodSet methods = method_sets::all;                                      // that read it
    bool (*of)(Parts const&) = nullptr;                                        // parts that it is for, if not all: never those whose corners are points
    Access value = {};                                                         // where a scene has it
    bool (*is_said)(Scene const& scene) = nullptr;                             // whether the resolved scene has it, where it counts; none: always
    Key const* physics = nullptr;                                              // the number that it is, of one of the physics

    /// "" of those at the top
    constexpr std::string_view table() const { return key() == name ? std::string_view() : name.substr(0, name.find('.')); }
    constexpr std::string_view key() const { return name.substr(name.find('.') + 1); }
    std::span<std::string_view const> all_choices() const { return known != nullptr ? known() : choices; }
};

using Settings = std::span<Setting const>;
/// Those that are no number of the physics, in the order in which a scene has them.
Settings settings();
/// These and the numbers of the physics, in the order of a scene's tables.
std::vector<Setting> with_physics(Settings rows);
Settings known_keys();
/// The resolved scene (scene.hpp), of these keys.
std::string resolved_toml(Scene const& scene, Settings keys);

/// @throws std::logic_error if there is no such row
Setting const& setting(std::string_view name, Settings rows = settings());

/// Whether a scene's method, mechanism and contacts read a setting of [integrator].
bool has_effect(Setting const& setting, Method method, Parts const& parts);

// One value of a scene, read and written by its type.
void read_value(Node const& node, Setting const& row, double& to);
void read_value(Node const& node, Setting const& row, std::uint64_t& to);
void read_value(Node const& node, Setting const& row, bool& to);
void read_value(Node const& node, Setting const& row, std::optional<std::uint64_t>& to);
void read_value(Node const& node, Setting const& row, Span& to);
std::string value_text(Setting const& row, double value);
std::string value_text(Setting const& row, std::uint64_t value);
std::string value_text(Setting const& row, bool value);
std::string value_text(Setting const& row, std::optional<std::uint64_t> const& value);
std::string value_text(Setting const& row, Span const& value);
std::size_t read_choice(Node const& node, Setting const& row);
std::string choice_text(Setting const& row, std::size_t choice);
template <class Choice> requires std::is_enum_v<Choice> void read_value(Node const& node, Setting const& row, Choice& to) {
    to = static_cast<Choice>(read_choice(node, row));
}
template <class Choice> requires std::is_enum_v<Choice> std::string value_text(Setting const& row, Choice value) {
    return choice_text(row, static_cast<std::size_t>(value));
}

/// A value's place in a scene: place<&Scene::chaos, &ChaosSettings::d0>(scene).
template <auto first, auto... rest> constexpr auto& place(auto& of) {
    if constexpr (sizeof...(rest) == 0) return of.*first;
    else return place<rest...>(of.*first);
}
template <auto... members> inline constexpr Access at{
    [](Scene& scene, Node const& node, Setting const& row) { read_value(node, row, place<members...>(scene)); },
    [](Scene const& scene, Setting const& row) { return value_text(row, place<members...>(scene)); }};

/// The default where nobody gives one: "1e-06", "false", "derived: density x ..."; "" for none
std::string preset_text(Setting const& row);

/// Steps of a member that reaches its end by `fixed_step`; a whole number.
double fixed_steps(IntegratorSettings const& settings);

/// Largest study.members.
inline constexpr std::uint64_t most_members = 1'000'000'000;
inline constexpr std::uint64_t most_verified = 1'000'000;  // members that run again
/// Largest integrator.max_steps.
inline constexpr std::uint64_t most_steps = 1'000'000'000'000'000;
/// Longest study [s].
inline constexpr double longest_time = 1e9;

// What the resolved scene says of keys whose value is more than one number or choice: texts in TOML, for the table of keys.
namespace resolved {

/// Of one: "0.05" of crank_length, "{ on = \"vy\", … }" of a section; "" where the scene has none.
using Text = std::string(Scene const& scene, Setting const& row);
Text schema, title, folders, mechanism, drive_body, drive_table, drive_column, drive_argument, drive_gives, drive_interpolation, drive_repeats, law, number, samples,
    quantities, phase, section, exponents, rescalings, history, parameter, values, base, member_table;
/// Lines of a table of their own: [study.vary] …
Text variations, correlation, limits;

}  // namespace resolved

}  // namespace slideway
