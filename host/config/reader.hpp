// The parts of `read_scene`, in the order they run.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/document.hpp"
#include "host/config/scene.hpp"
#include "host/config/settings.hpp"

namespace slideway {

class CsvReader;
struct Reading;

// What keys of a scene ask of one another: a table beside that of the keys, which the reader walks as it gets to know the scene.

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

/// A document on its way to a scene, by the tables of keys and of their rules.
struct Reading {
    Node const& root;
    Scene& scene;
    Settings keys = known_keys();
    KeyRules rules = key_rules();
    Scene const* former = nullptr;  // whose tables count (parse_scene)

    Node const* given(std::string_view name) const { return root.find_path(name); }
    /// The first of them that is given.
    Node const* given_of(std::initializer_list<std::string_view> names) const;
    /// What is given of the keys of a table that know their places.
    void read_table(std::string_view table);
    void warn(std::string line) { scene.warnings.push_back(std::move(line)); }
    /// The name of a quantity at a node as it is now, with a word where an earlier version had it.
    std::string_view named_now(Node const& node, std::string_view name);
};

/// Whether what is below a table of the scene are tables of any name, which read_loads or read_linkage know.
bool has_named_tables(std::string_view table);

/// A node that holds a numeric key of the physics.
struct GivenKey {
    Key const* key;
    Node const* node;
};
/// In the order in which they take effect: those of the file, then the options.
std::vector<GivenKey> given_keys(Reading const& reading);

/// The file of a table that a node names, from the scene's folder on, at most 256 MiB: from then on among Scene::tables.  One that is given from the
/// root on and is not there, as in the resolved scene of a study that was moved, may lie beside the scene.
TableFile read_table_file(Reading& reading, Node const& node);
/// A field of its row for messages: `members.csv:3: name is "text" (…); …`.
Node field_node(CsvReader const& table, std::string name, std::string text);

/// drive.kind: Parts::drive, and the mechanism whose crank turns freely.
void choose_drive(Reading& reading);
/// The rest of [drive]: Scene::drive.
void read_drive(Reading& reading);
/// What follows from a profile, once the numbers are known.
void finish_drive(Scene& scene);
/// Refuses a profile that ends before the run.  @param longest of a member [s]
void check_profile(Reading const& reading, double longest);
/// All of load_tables, [load.<name>] to [film]: Scene::loads, and the keys of their numbers; needs the mechanism.
void read_loads(Reading& reading);
/// [modules], and which mechanism and law a scene names: modules that they are of are opened, and their keys are known from here on.
void read_modules(Reading& reading);
/// Numeric keys, damping, friction and way pose; everything of Scene::inputs and Scene::parts but [study.vary].
void read_physics(Reading& reading);
/// Warns of keys from which masses would follow, where all of those are given.
void warn_of_idle_sources(Reading& reading);
/// [study.vary]; adds the kernel parts that the varied keys need.
void read_variations(Reading& reading);
/// The entries of [study.vary], in the order of Scene::variations.
std::vector<Node const*> varied_nodes(Node const& root);
/// Which study, of how many members, and what it is asked for; adds the kernel parts that a swept key needs.
void read_study(Reading& reading);
/// How the members are spread: Scene::design, and how many members follow from it; needs the study and what varies.
void read_design(Reading& reading);
/// study.table: Scene::design.table and a variation for each of its columns.
void read_member_table(Reading& reading, Node const& node);
/// The keys of a study of orbits: Scene::chaos.
void read_orbits(Reading& reading);
/// What a sweep sweeps, through which values.
void read_sweep(Reading& reading);
/// [integrator]; needs the period of the drive and the study.
void read_integrator(Reading& reading);
/// Until when, and what of [study] is recorded on the way; needs everything above.
void read_recording(Reading& reading);
/// Warns of numbers that no mechanism has, likely slips of a unit (docs/how_to/troubleshooting.md): given ones, rows of a table, draws, columns of a sweep.
void warn_of_unusual(Reading& reading);

/// How long the members of a study of orbits run [s], and how often their steps end at known times.
struct RunLength {
    double seconds;  // of the scene's own member
    double longest;
    double stops;
};
RunLength run_length(Scene const& scene);
/// How many steps a member may take: IntegratorSettings::max_steps.  Refuses steps that come to no end.
void read_steps(Reading& reading, RunLength const& length);

/// Whether a key may differ between members or columns: nothing else varies it, and it counts beside the scene's other ones.
/// @param of_option why an option that sets it is refused  @throws SceneError at `node`, or at a key that it replaces
void check_varied(Reading const& reading, Node const& node, Key const& key, Problem const& of_option);
/// Whether members or columns differ in a key.
bool varies(Scene const& scene, std::string_view name);
/// Whether a key says where a member starts.
bool is_of_start(Key const& key);
/// What to write instead of a name that is no numeric key of the scene.
std::string key_advice(std::string_view name, Scene const& scene);
/// Refuses a name of a load's number that the scene does not give: it has no place among those of a member.
void refuse_ungiven(std::string_view where, std::string_view name, Scene const& scene);

/// Periods of the drive that members may have [s]; the most is infinite where a limit lets it stand still.
struct PeriodRange {
    double least, most;
    Key const* varied;  // why they may differ between members; nullptr: they do not
};
PeriodRange drive_periods(Scene const& scene);
/// That of the drive at its fastest: a sweep goes by its fastest column, draws by the fastest member, a profile by where it is steepest, a motor by the faster of its start and
/// its no-load speed; infinite of what is at rest.
double fastest_period(Scene const& scene);
/// The least reversal_time that members of a carriage may have [s], > 0.
double shortest_reversal(Scene const& scene);

/// Most numbers of one kind in a result file, 80 GB.
inline constexpr double most_values = 1e10;

// Refusals that have words of their own.

/// A key, or a table, that does not count for the scene's mechanism, at a position.
[[noreturn]] void refuse_meaningless(std::string_view where, std::string_view name, Mechanism mechanism);
/// A key that the scene's drive does not have, or has in other words.
[[noreturn]] void refuse_replaced(Node const& node, Key const& key, Parts const& parts);
/// A key that the scene's law does not know.
[[noreturn]] void refuse_strange(Node const& node, Parts const& parts);
/// What `node` gives, or the study whose default it is; `key` is the dotted name.
[[noreturn]] void refuse_study(Node const& root, Node const* node, std::string_view key, Problem const& problem);
/// A node that no part of the scene reads.
[[noreturn]] void refuse_unknown(Node const& node, std::string_view what, std::span<std::string_view const> known);
/// What asks for a key that is not there: "study.points is missing (how many columns there are); add points = 50".
[[noreturn]] void refuse_missing(Node const& asking, std::string_view key, std::string_view why, std::string_view advice);
/// What is no argument of an inline table.  @param what it describes: "limit"
void check_arguments(Node const& table, std::string_view what, std::initializer_list<std::string_view> known);

// Values of nodes as the reader wants them, or an error at the node's position.

/// A finite number, or a text with a unit that converts to `unit`; in SI units.  @throws SceneError
double read_number(Node const& node, std::string_view unit);
/// The same for a key of the physics, within its rule, and for a setting, within its limits.
double read_number(Node const& node, Key const& key);
double read_number(Node const& node, Setting const& setting);
/// One or more of them.  @param example for refusals: "[1, 2]"
std::vector<double> read_list(Node const& list, Key const& key, std::uint64_t most, std::string_view example);
/// An integer (or a real number that is one) from low to high.
std::uint64_t read_count(Node const& node, std::string_view meaning, std::uint64_t low, std::uint64_t high);
std::uint64_t read_count(Node const& node, Setting const& setting);
bool read_boolean(Node const& node);
std::string const& read_text_value(Node const& node);
/// Index of the text in `names`.  @throws SceneError naming the nearest or all.
std::size_t read_choice(Node const& node, std::string_view meaning, std::span<std::string_view const> names);
/// "; did you mean x?" where a name is near enough, else "use one of a, b, c".
std::string choice_advice(std::string_view name, std::span<std::string_view const> names);

}  // namespace slideway
