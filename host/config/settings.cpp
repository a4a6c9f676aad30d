#include "host/config/settings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "host/config/document.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"

namespace slideway {
namespace {

/// Whether lasting contact may need the stiff method: vibrating faces, or friction against a slow slip in space.
bool may_be_stiff(Parts const& parts) { return info(parts.mechanism).spatial; }

using Type = Setting::Type;
using namespace study_sets;

constexpr std::string_view spacing_names[] = {"linear", "log"};
constexpr std::string_view start_names[] = {"fresh", "continue"};
constexpr auto method_names = [] {
    std::array<std::string_view, method_count> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = method_table[i].name;
    return names;
}();

// Below some 50 roundings of a double the error estimate is noise.
constexpr Range relative_tolerance{1e-14, 0.1}, absolute_tolerance{0, 0.1, false};
constexpr Range time_of_steps{.low = 0, .low_included = false}, length_of_time{0, longest_time, false};
// Distances of some 1e-15 are rounding, and at 1 an offset is as large as the joint.
constexpr Range distance{1e-11, 1e-2}, bound_of_distance{1e-14, 1};
constexpr StudySet with_exponents = lyapunov | sweep;

template <auto member> constexpr Access of_integrator = at<&Scene::integrator, member>;
template <auto member> constexpr Access of_chaos = at<&Scene::chaos, member>;
bool has_drive_table(Scene const& scene) { return scene.drive != nullptr; }
bool has_neighbours(Scene const& scene) { return scene.chaos.exponents > 0; }
bool has_one_neighbour(Scene const& scene) { return scene.chaos.exponents == 1; }

}  // namespace

Settings settings() {
    static Setting const rows[] = {
        {.name = "schema", .type = Type::count, .unit = "1", .meaning = "format of the scene", .preset = "-", .least = 1, .most = 1,
         .value = {.text = resolved::schema}},
        {.name = "title", .type = Type::text, .unit = "", .meaning = "one line for pages and summaries", .preset = "-", .value = {.text = resolved::title}},
        {.name = "modules.search", .type = Type::list, .unit = "",
         .meaning = "folders, from the scene's, in which laws and mechanisms of one's own lie, that slideway compile -o made; its own folder needs no word",
         .preset = "[]", .value = {.text = resolved::folders}},
        {.name = "mechanism.kind", .type = Type::choice, .unit = "", .meaning = "which mechanism", .preset = "slider_crank", .what = "mechanism",
         .known = mechanism_kinds, .value = {.text = resolved::mechanism}},
        {.name = "drive.kind", .type = Type::choice, .unit = "",
         .meaning = "what moves the mechanism: constant speed (of a carriage to and fro), a profile over time, a motor's torque, or nothing from the start on",
         .preset = "speed", .what = "drive", .choices = drive_names,
         .value = {.text = at<&Scene::parts, &Parts::drive, &DrivePlan::by>.text},
         .is_said = [](Scene const& scene) { return scene.parts.drive.by != DriveBy::speed; }},
        {.name = "drive.body", .type = Type::text, .unit = "", .meaning = "of a linkage: the body on the ground that the drive turns", .preset = "-",
         .value = {.text = resolved::drive_body}},
        {.name = "drive.table", .type = Type::text, .unit = "", .meaning = "file of a table, beside the scene: the profile, or what a motor's torque is multiplied by",
         .preset = "-", .value = {.text = resolved::drive_table}, .is_said = has_drive_table},
        {.name = "drive.over", .type = Type::choice, .unit = "", .meaning = "the table's column that a motor's torque is read over", .preset = "-",
         .what = "argument", .choices = drive_arguments, .value = {.text = resolved::drive_argument}, .is_said = has_drive_table},
        {.name = "drive.column", .type = Type::text, .unit = "", .meaning = "the table's column of values", .preset = "-",
         .value = {.text = resolved::drive_column}, .is_said = has_drive_table},
        {.name = "drive.gives", .type = Type::choice, .unit = "", .meaning = "what the column of a profile is, of a crank or of a carriage", .preset = "-",
         .what = "quantity", .choices = profile_names, .value = {.text = resolved::drive_gives}, .is_said = has_drive_table},
        {.name = "drive.interpolation", .type = Type::choice, .unit = "", .meaning = "how the column runs between the rows of the table", .preset = "spline",
         .what = "interpolation", .choices = interpolation_names, .value = {.text = resolved::drive_interpolation}, .is_said = has_drive_table},
        {.name = "drive.repeats", .type = Type::truth, .unit = "", .meaning = "whether the table begins anew behind its last row",
         .preset = "true over crank_angle, else false", .value = {.text = resolved::drive_repeats}, .is_said = has_drive_table},
        {.name = "contact.law", .type = Type::choice, .unit = "", .meaning = "contact law", .preset = info(default_law).name, .what = "contact law",
         .known = contact_law_names, .value = {.text = resolved::law}},
        {.name = "friction.enabled", .type = Type::truth, .unit = "", .meaning = "whether there is friction",
         .preset = "true where there is [friction], else false", .value = at<&Scene::parts, &Parts::friction>},
        {.name = "integrator.method", .type = Type::choice, .unit = "", .meaning = "integration method", .preset = "auto", .what = "method",
         .choices = method_names, .value = of_integrator<&IntegratorSettings::method>},
        {.name = "integrator.rtol", .type = Type::number, .unit = "1", .meaning = "largest error of a step, relative to the state", .preset = "",
         .what = "relative tolerance", .range = relative_tolerance, .methods = method_sets::controlled, .value = of_integrator<&IntegratorSettings::rtol>},
        {.name = "integrator.atol", .type = Type::number, .unit = "1",
         .meaning = "largest error of a step near zero, relative to clearance c, speed c ω, tilt 2c/L and tilt rate 2c ω/L, with ω the drive's rate",
         .preset = "rtol/10", .what = "absolute tolerance", .range = absolute_tolerance, .methods = method_sets::controlled,
         .value = of_integrator<&IntegratorSettings::atol>},
        {.name = "integrator.max_step", .type = Type::number, .unit = "s", .meaning = "largest step of the explicit methods",
         .preset = "1 ms, or a 2000th (verner65: a 200th) of the drive's period, or a 20th of a reversal; with rigid contacts 50 ms, or a 50th of the period",
         .what = "largest step", .range = time_of_steps, .methods = method_sets::controlled, .value = of_integrator<&IntegratorSettings::max_step>},
        {.name = "integrator.stiff_max_step", .type = Type::number, .unit = "s", .meaning = "largest step of the stiff method",
         .preset = "10 max_step; with rigid contacts a 50th of the period", .what = "largest step", .range = time_of_steps, .methods = method_sets::stiff,
         .of = may_be_stiff, .value = of_integrator<&IntegratorSettings::stiff_max_step>},
        {.name = "integrator.stiff_tolerance", .type = Type::number, .unit = "1",
         .meaning = "tolerance of vibrations that the stiff method damps, where rtol is smaller", .preset = "", .what = "least tolerance of ringing",
         .range = relative_tolerance, .methods = method_sets::stiff, .of = may_be_stiff, .value = of_integrator<&IntegratorSettings::stiff_tolerance>},
        {.name = "integrator.step", .type = Type::number, .unit = "s", .meaning = "the fixed step of rk4 and moreau_jean", .preset = "-",
         .what = "fixed step", .range = time_of_steps, .methods = method_sets::fixed, .value = of_integrator<&IntegratorSettings::fixed_step>},
        {.name = "integrator.locate_modes", .type = Type::truth, .unit = "", .meaning = "end steps where the contact mode switches; for laws that switch",
         .preset = "true under a law that switches, without restitution; else false",
         .methods = method_sets::explicit_pairs, .of = has_faces, .value = of_integrator<&IntegratorSettings::locate_modes>},
        {.name = "integrator.max_steps", .type = Type::count, .unit = "1",
         .meaning = "largest number of steps of a member, rejected ones included; a member that needs more ends as failed",
         .preset = "1e7, and as many for each second", .what = "number of steps", .least = 1, .most = most_steps,
         .value = of_integrator<&IntegratorSettings::max_steps>},
        {.name = "study.kind", .type = Type::choice, .unit = "", .meaning = "which study", .preset = "ensemble", .what = "study",
         .choices = study_kind_names, .value = at<&Scene::study>},
        {.name = "study.members", .type = Type::count, .unit = "1", .meaning = "members; sweep: members for each value of the parameter", .preset = "",
         .what = "number of members", .least = 1, .most = most_members, .value = at<&Scene::members>},
        {.name = "study.seed", .type = Type::count, .unit = "1", .meaning = "seed of what [study.vary] draws", .preset = "", .what = "seed",
         .value = at<&Scene::seed>},
        {.name = "study.transient_revolutions", .type = Type::number, .unit = "1",
         .meaning = "revolutions before the recorded ones, which are not recorded", .preset = "20; lyapunov 2", .studies = chaos,
         .what = "number of revolutions", .range = {0, longest_time}, .rivals = {"study.Ttr"}, .value = of_chaos<&ChaosSettings::transient>},
        {.name = "study.Ttr", .type = Type::number, .unit = "s", .meaning = "time before the recorded one, instead of study.transient_revolutions",
         .preset = "-", .studies = chaos, .what = "transient", .range = {0, longest_time}, .rivals = {"study.transient_revolutions"},
         .value = of_chaos<&ChaosSettings::transient>},
        {.name = "study.revolutions", .type = Type::number, .unit = "1",
         .meaning = "recorded revolutions of the crank, or strokes of a carriage forth and back", .preset = "1; lyapunov 10, poincare 150, sweep 50",
         .what = "number of revolutions", .range = length_of_time, .rivals = {"study.duration"}, .value = of_chaos<&ChaosSettings::span>},
        {.name = "study.duration", .type = Type::number, .unit = "s", .meaning = "recorded time, instead of study.revolutions", .preset = "-",
         .studies = all & ~sweep, .what = "duration", .range = length_of_time, .rivals = {"study.revolutions"}, .value = of_chaos<&ChaosSettings::span>},
        {.name = "study.time_limit", .type = Type::number, .unit = "s",
         .meaning = "longest time in which a crank on a motor, or a free one, makes its revolutions; a member that needs more ends as failed",
         .preset = "-", .what = "time limit", .range = length_of_time, .value = of_integrator<&IntegratorSettings::end_time>,
         .is_said = [](Scene const& scene) { return scene.goes_by_turns(); }},
        {.name = "study.samples_per_revolution", .type = Type::count, .unit = "1", .meaning = "samples of the time series in a revolution, 0 for none",
         .preset = "0", .studies = to_end, .what = "number of samples per revolution", .most = 1'000'000, .rivals = {"study.samples"}},
        {.name = "study.samples", .type = Type::count, .unit = "1",
         .meaning = "samples in all, first and last included, instead of study.samples_per_revolution", .preset = "-", .studies = to_end,
         .what = "number of samples", .most = 1'000'000, .rivals = {"study.samples_per_revolution"}, .value = {.text = resolved::samples}},
        {.name = "study.verify", .type = Type::count, .unit = "1",
         .meaning = "members that may run again, with a hundredth of the tolerance or with another method, until the integration error of the study's numbers is known; 0: none",
         .preset = "as many as a tenth of the study's work allows", .what = "number of members that run again", .most = most_verified,
         .value = at<&Scene::verify>},
        {.name = "study.store", .type = Type::choice, .unit = "",
         .meaning = "what the result keeps: the values of every member, or statistics alone (counts, moments, quantile sketches)", .preset = "members",
         .studies = to_end, .what = "store", .choices = store_names, .value = at<&Scene::store>,
         .is_said = [](Scene const& scene) { return !scene.stores_members(); }},
        {.name = "study.parameter", .type = Type::text, .unit = "", .meaning = "the key that the sweep varies", .preset = "-", .studies = sweep,
         .value = {.text = resolved::parameter}},
        {.name = "study.values", .type = Type::list, .unit = "", .meaning = "values of the parameter", .preset = "-", .studies = sweep,
         .rivals = {"study.from", "study.to", "study.points", "study.spacing"}, .value = {.text = resolved::values}},
        {.name = "study.from", .type = Type::number, .unit = "", .meaning = "first value of the parameter, instead of study.values", .preset = "-",
         .studies = sweep, .rivals = {"study.values"}},
        {.name = "study.to", .type = Type::number, .unit = "", .meaning = "last value of the parameter", .preset = "-", .studies = sweep,
         .rivals = {"study.values"}},
        {.name = "study.points", .type = Type::count, .unit = "1", .meaning = "number of values from the first to the last", .preset = "-",
         .studies = sweep, .what = "number of columns", .least = 2, .most = 10'000, .rivals = {"study.values"}},
        {.name = "study.spacing", .type = Type::choice, .unit = "", .meaning = "how these values are spaced", .preset = "linear", .studies = sweep,
         .what = "spacing", .choices = spacing_names},
        {.name = "study.start", .type = Type::choice, .unit = "",
         .meaning = "initial states of a value of the parameter: the scene's (fresh), or the last states of the value before (continue)", .preset = "fresh",
         .studies = sweep, .what = "start", .choices = start_names, .value = of_chaos<&ChaosSettings::continued>},
        {.name = "study.phase", .type = Type::number, .unit = "rad", .meaning = "crank angle of the sections, or phase of a carriage or a profile",
         .preset = "0", .studies = poincare | sweep, .rivals = {"study.section"}, .value = {.text = resolved::phase}},
        {.name = "study.section", .type = Type::table, .unit = "",
         .meaning = "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }: a state, in space a gap like gap_y[P1], or \"impacts\" of rigid contacts; rising, falling, both",
         .preset = "-", .studies = poincare, .rivals = {"study.phase"}, .value = {.text = resolved::section}},
        {.name = "study.max_crossings", .type = Type::count, .unit = "1", .meaning = "most crossings of study.section that are recorded of a member",
         .preset = "1000", .studies = poincare, .what = "number of crossings", .least = 1, .most = 1'000'000,
         .value = of_chaos<&ChaosSettings::max_crossings>, .is_said = [](Scene const& scene) { return !scene.chaos.section.is_phase(); }},
        {.name = "study.exponents", .type = Type::count, .unit = "1", .meaning = "how many Lyapunov exponents, sweep: 0 for none", .preset = "1",
         .studies = with_exponents, .what = "number of exponents", .most = most_shadows, .value = {.text = resolved::exponents}},
        {.name = "study.d0", .type = Type::number, .unit = "1",
         .meaning = "initial distance of the shadow trajectories from their member, in the scales of atol", .preset = "1e-6", .studies = with_exponents,
         .what = "distance of neighbours", .range = distance, .value = of_chaos<&ChaosSettings::d0>, .is_said = has_neighbours},
        {.name = "study.d0_lower", .type = Type::number, .unit = "1", .meaning = "a single shadow trajectory is rescaled when it is closer than this",
         .preset = "0.3 d0", .studies = with_exponents, .what = "least distance", .range = bound_of_distance, .value = of_chaos<&ChaosSettings::d0_lower>,
         .is_said = has_one_neighbour},
        {.name = "study.d0_upper", .type = Type::number, .unit = "1", .meaning = "a single shadow trajectory is rescaled when it is farther than this",
         .preset = "3 d0", .studies = with_exponents, .what = "largest distance", .range = bound_of_distance, .value = of_chaos<&ChaosSettings::d0_upper>,
         .is_said = has_one_neighbour},
        {.name = "study.rescalings_per_revolution", .type = Type::count, .unit = "1", .meaning = "rescalings of the shadow trajectories in a revolution",
         .preset = "2000", .studies = with_exponents, .what = "number of rescalings per revolution", .least = 1, .most = 1'000'000, .rivals = {"study.dt"},
         .value = {.text = resolved::rescalings}, .is_said = has_neighbours},
        {.name = "study.dt", .type = Type::number, .unit = "s", .meaning = "time between rescalings, instead of study.rescalings_per_revolution",
         .preset = "-", .studies = lyapunov, .what = "time between rescalings", .range = length_of_time, .rivals = {"study.rescalings_per_revolution"},
         .value = of_chaos<&ChaosSettings::dt>, .is_said = has_neighbours},
        {.name = "study.history", .type = Type::count, .unit = "1", .meaning = "points of the convergence history, 0 for none", .preset = "100",
         .studies = lyapunov, .what = "number of points", .most = 10'000'000, .value = {.text = resolved::history}},
        {.name = "study.quantities", .type = Type::list, .unit = "", .meaning = "names of quantities and, with samples, series", .preset = "[]",
         .value = {.text = resolved::quantities}},
        {.name = "study.design", .type = Type::choice, .unit = "", .meaning = "sampling design", .preset = "mc", .what = "design", .choices = design_names,
         .value = at<&Scene::design, &Design::kind>},
        {.name = "study.base", .type = Type::count, .unit = "1", .meaning = "rows of saltelli, a power of two; members = base (keys that vary + 2)",
         .preset = "-", .studies = to_end, .what = "number of rows", .least = 2, .most = most_members, .rivals = {"study.members"},
         .value = {.text = resolved::base}},
        {.name = "study.levels", .type = Type::count, .unit = "1", .meaning = "grid: levels of each key that has no levels = k of its own in [study.vary]",
         .preset = "-", .studies = all & ~sweep, .what = "number of levels", .least = 1, .most = most_members, .rivals = {"study.members"}},
        {.name = "study.table", .type = Type::text, .unit = "",
         .meaning = "file of the table, beside the scene: dotted keys, [unit] behind them, above a row for each member", .preset = "-",
         .studies = all & ~sweep, .value = {.text = resolved::member_table}},
        {.name = "study.vary", .type = Type::table, .unit = "", .meaning = "distributions of the keys that differ between members", .preset = "-",
         .value = {.text = resolved::variations}},
        {.name = "study.correlation", .type = Type::table, .unit = "",
         .meaning = "{ keys = [\"joint.clearance_y\", ...], matrix = [[1, 0.5], [0.5, 1]] } of keys that vary", .preset = "-",
         .value = {.text = resolved::correlation}},
        {.name = "study.limits", .type = Type::table, .unit = "",
         .meaning = "{ min = ..., max = ... } of a quantity, \"mode_time[free]\" where it has several values", .preset = "-", .studies = to_end,
         .value = {.text = resolved::limits}},
    };
    return rows;
}

std::vector<Setting> with_physics(Settings rows) {
    std::vector<Setting> all(rows.begin(), rows.end());
    for (Key const& key : numeric_keys()) {
        all.push_back({.name = key.name, .type = Type::number, .unit = key.unit, .meaning = key.meaning, .preset = "-", .range = range_of(key.rule),
                       .value = {.text = resolved::number}, .physics = &key});
    }
    std::ranges::copy(linkage_settings(), std::back_inserter(all));  // of bodies and links of any name
    std::ranges::copy(load_settings(), std::back_inserter(all));     // of loads
    static constexpr std::string_view tables[] = {"",        "modules",  "mechanism", "drive", "joint", "slider", "material",   "way",
                                                  "contact", "friction", "initial", "body", "link", "load",  "spring", "stop", "ground_motion", "way_profile", "way_ends", "film", "integrator", "study"};
    std::ranges::stable_sort(all, {}, [](Setting const& row) { return std::ranges::find(tables, row.table()) - tables; });
    return all;
}

Settings known_keys() {
    static OfAllKnown<std::vector<Setting>> all([] { return with_physics(settings()); });
    return all();
}

Setting const& setting(std::string_view name, Settings rows) {
    auto const found = std::ranges::find(rows, name, &Setting::name);
    if (found == rows.end()) throw std::logic_error(fmt::format("there is no setting {}", name));
    return *found;
}

bool has_effect(Setting const& setting, Method method, Parts const& parts) {
    return (setting.methods & set_of(method)) != 0 && (setting.of == nullptr || setting.of(parts));
}

std::string value_text(Setting const&, double value) { return toml_number(value); }
std::string value_text(Setting const&, std::uint64_t value) { return fmt::format("{}", value); }
std::string value_text(Setting const& row, bool value) { return row.type == Type::truth ? fmt::format("{}", value) : choice_text(row, value ? 1 : 0); }
std::string value_text(Setting const& row, std::optional<std::uint64_t> const& value) { return value ? value_text(row, *value) : std::string(); }
/// Of the two keys of a length of time the one in whose unit it is.
std::string value_text(Setting const& row, Span const& value) {
    return value.revolutions == (row.unit == "1") ? toml_number(value.value) : std::string();
}
std::string choice_text(Setting const& row, std::size_t choice) { return fmt::format("\"{}\"", row.all_choices()[choice]); }

std::string preset_text(Setting const& row) {
    if (row.physics != nullptr) {
        Key const& key = *row.physics;
        if (key.member == &Inputs::restitution) return {};
        return std::isnan(key.preset) ? "derived: " + derivations_of(key) : fmt::format("{:.10g}", key.preset);
    }
    if (row.preset.empty()) return row.value.text(Scene{}, row);
    return row.preset == "-" ? std::string() : std::string(row.preset);
}

double fixed_steps(IntegratorSettings const& settings) {
    // The kernels stretch the last step by up to a millionth rather than leave a crumb.
    return std::max(1.0, std::ceil(settings.end_time / settings.fixed_step - 1e-6));
}

}  // namespace slideway
