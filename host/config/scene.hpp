// A scene: what to integrate, how, and what to keep.  Read from TOML, validated, in SI units.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/config/keys.hpp"
#include "host/sampling/design.hpp"
#include "kernels/block.hpp"

namespace slideway {

enum class StudyKind { ensemble, lyapunov, poincare, sweep, tolerance };

inline constexpr std::string_view study_kind_names[] = {"ensemble", "lyapunov", "poincare", "sweep", "tolerance"};
constexpr std::string_view name_of(StudyKind kind) { return study_kind_names[static_cast<int>(kind)]; }

/// Every member from the start to the end time, with or without a time series; the others study orbits.
constexpr bool runs_to_end(StudyKind kind) { return kind == StudyKind::ensemble || kind == StudyKind::tolerance; }

/// What a result keeps: a row of each member, or what they come to together.
enum class Store { members, statistics };

inline constexpr std::string_view store_names[] = {"members", "statistics"};
constexpr std::string_view name_of(Store store) { return store_names[static_cast<int>(store)]; }

class SceneLoads;
struct SceneDrive;

/// A length of time: seconds, or revolutions of the member's own crank, periods of what drives it.
struct Span {
    double value = 0;
    bool revolutions = false;

    /// @param period of the drive [s]; infinite, so is what is asked in revolutions
    double seconds(double period) const { return !revolutions || value == 0 ? value : value * period; }
    friend bool operator==(Span const&, Span const&) = default;
};

using CrossingDirection = CrossingPlan::Direction;

inline constexpr std::string_view crossing_direction_names[] = {"rising", "falling", "both"};
constexpr std::string_view name_of(CrossingDirection direction) {
    return crossing_direction_names[static_cast<int>(direction)];
}

/// Where a section of the orbit is taken: at a phase of the drive, a known time, where a state or a gap crosses a level, or at the
/// impacts of rigid contacts, before and after each.
/// A gap is the penetration of an apex, negated: > 0 apart.
struct SectionSurface {
    enum class On { phase, state, gap_y, gap_z, impacts };
    On on = On::phase;
    int index = 0;  // in the mechanism's state (mechanism_info.hpp), or of the apex, P1…P8 from 0
    double level = 0;  // crank angle, or phase of a carriage or a profile [rad], any turn; else the state's unit, or [m] of the gap
    CrossingDirection direction = CrossingDirection::rising;  // a phase has none

    bool is_phase() const { return on == On::phase; }
    friend bool operator==(SectionSurface const&, SectionSurface const&) = default;
};

/// How scenes name impacts as a section.
inline constexpr std::string_view impacts_name = "impacts";

/// SI unit of a section's level, as keys have it.
std::string_view section_unit(SectionSurface const& section, Mechanism mechanism);

/// How many parts of this length fit into the whole, but for rounding.  Where both count revolutions, or both seconds,
/// all members have as many.
inline double parts_of(Span const& whole, Span const& part, double period) {
    bool const same = whole.revolutions == part.revolutions;
    double const parts = same ? whole.value / part.value : whole.seconds(period) / part.seconds(period);
    return std::floor(parts * (1 + 1e-12) + 1e-9);
}

/// Each study reads what it names; the rest stays as it is here.
struct ChaosSettings {
    Span transient;                    // left out before anything is recorded
    Span span;                         // recorded after it
    SectionSurface section;            // poincare; sweep: a phase
    std::size_t max_crossings = 1000;  // recorded of a member; poincare, not of a phase
    int exponents = 0;                 // the largest ones; sweep: 0 for none; at most most_shadows
    // Distances of neighbours, in the scales of integrator.atol.
    double d0 = 1e-6;
    // A single neighbour is rescaled beyond them.  They are near d0: a resting slider has other places to rest some 1e-5 away.
    double d0_lower = 3e-7, d0_upper = 3e-6;
    Span dt;                  // between rescalings; sweep: a whole fraction of a revolution
    std::size_t history = 0;  // points of the convergence history; lyapunov
    // sweep
    Key const* parameter = nullptr;
    std::vector<double> values;  // SI
    bool continued = false;      // a column starts from the last states of the one before
};

/// A table in a file that a scene names, as it was read.
struct TableFile {
    std::string key;    // study.table, load.<name>.table
    std::string given;  // as the scene names it, from its folder on
    std::string path;   // from the root
    std::string name;   // for messages
    std::shared_ptr<std::string const> text;
    std::uint64_t checksum = 0;  // FNV-1a of the text
};

struct Scene {
    std::string path;  // as the user gave it
    std::string title;
    std::vector<std::string> modules;  // folders of [modules] search, from the root
    Inputs inputs;  // as given; entries that follow others are NaN
    Parts parts;
    std::shared_ptr<SceneLoads const> loads;  // those of the parts; none: nullptr
    std::shared_ptr<SceneDrive const> drive;  // the table of the parts' drive; none: nullptr
    std::vector<TableFile> tables;            // all that it reads
    IntegratorSettings integrator;  // end_time and max_step resolved
    StudyKind study = StudyKind::ensemble;
    ChaosSettings chaos;  // of the studies that ask for it
    std::uint64_t members = 1;
    std::uint64_t seed = 1;
    Store store = Store::members;      // what the result file keeps
    std::vector<double> sample_times;  // empty: no time series
    Selection quantities = 0;
    Selection series = 0;                    // state series included when sample_times is not empty
    std::vector<Variation> variations;       // in the order of the file
    Design design;                           // how members are spread over them
    std::shared_ptr<Sampler const> sampler;  // of the design, by prepare_sampler; none: made for each draw
    std::vector<Limit> limits;               // [study.limits]
    /// Members that run again to check the others, whatever it costs; none: what a tenth of the study's work allows.
    std::optional<std::uint64_t> verify;
    std::vector<std::string> warnings;       // one line each: what was given and has no effect, and what was not given and matters

    bool stores_members() const { return store == Store::members; }
    /// Whether members end, stop and are sampled by what their crank has turned (BlockBase::by_turns): revolutions of one that turns freely.  Sample
    /// times are then angles [rad], and integrator.end_time is study.time_limit.
    bool goes_by_turns() const { return parts.drive.turns_freely() && chaos.span.revolutions; }
    /// Whether each member of an ensemble or a tolerance study ends after revolutions of its own drive, whose periods differ.
    bool has_own_ends() const { return runs_to_end(study) && chaos.span.revolutions && !goes_by_turns(); }
};

using Overrides = std::vector<std::pair<std::string, std::string>>;  // --set key=value, in order

/// Reads and validates a scene.  @throws SceneError with file, line and key, also for a file that cannot be read (a
/// scene that is not there is bad usage); FileError when the units database of UDUNITS-2 is missing.
Scene read_scene(std::string const& path, Overrides const& overrides = {});

/// The same from the text of a scene; `name` stands for the path in messages.
/// @param former the scene of the same text with other overrides: tables that it has are taken from it, and no file is read again
Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides = {}, Scene const* former = nullptr);

/// A numeric key of the physics or of the scene's loads; nullptr when there is none.
Key const* find_key(std::string_view dotted_name, Scene const& scene);
std::vector<std::string_view> numeric_key_names(Scene const& scene);
/// The table that a key of the scene names; nullptr when it names none.
TableFile const* find_table(Scene const& scene, std::string_view key);

/// Makes the members those of given inputs: design "table" without a file.  What the keys varied by before counts no more.
/// @param names dotted keys  @param values in SI, one member a row  @throws SceneError if one of them is no such key, or the study's design is
/// given otherwise
void take_members(Scene& scene, std::vector<std::string> const& names, std::span<double const> values);

/// Members of all columns of a sweep, else `members`.
std::uint64_t member_count(Scene const& scene);

/// Makes the sampler of the design as it is now; to be called again when variations, design, seed or members change.
/// @throws SceneError if the design cannot have them.
void prepare_sampler(Scene& scene);

/// Inputs of one member, complete; `defect` tells whether the draw can be used.  Depends on the scene and the member's
/// number only (its design, seed and key names), so any member can be drawn alone, on any thread or machine.
/// In a sweep members [0, members) are the starts of the first column, and so on: each column has the same starts.
Inputs member_inputs(Scene const& scene, std::uint64_t member);

/// A period of the scene's drive in what its members go by: seconds, or, by turns, 2π.
double turn_length(Scene const& scene);

/// Why the place of a drive is not known well enough at the end, or nothing: it follows from the time alone, and the last bit of a double moves a crank
/// pin after N revolutions by 2π N ε r.
std::optional<Problem> unresolved_drive(Parts const& parts, Inputs const& inputs, double seconds);

/// The value that member draws for a variation, in SI units.
double draw(Scene const& scene, Variation const& variation, std::uint64_t member);

/// What columns of text of the scene's table call a member: "A-001, lot 7"; "" where there are none.
std::string label_of(Scene const& scene, std::uint64_t member);

/// A number of the scene that is not given and follows from others; members whose sizes vary have their own.
struct DerivedNumber {
    Key const* key;
    double value;       // SI; NaN of what only a kernel knows
    std::string words;  // of the last parts of keys
};
std::vector<DerivedNumber> derived_numbers(Scene const& scene);
/// The scene's numbers, those that members vary in among the given ones, as 1.
Inputs given_or_varied(Scene const& scene);

/// The scene with every key written out in SI units, as TOML that reads back to the same scene.
std::string resolved_toml(Scene const& scene);

}  // namespace slideway
