#include "host/config/reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/loads.hpp"

namespace slideway {

namespace key_rule_table {
namespace {

using enum KeyRule::What;
using R = Reading const&;

bool rigid(R r) { return r.scene.parts.rigid; }
bool spatial(R r) { return info(r.scene.parts.mechanism).spatial; }
bool is_shaped(R r) { return r.given("way_profile") != nullptr || r.given("way_ends") != nullptr; }
bool turns_freely(R r) { return r.scene.parts.drive.turns_freely(); }
bool by_turns(R r) { return turns_freely(r) && r.given("study.time_limit"); }
bool turns(R r) { return by_turns(r) || std::isfinite(drive_period(r.scene.parts, r.scene.inputs)); }
bool to_end(R r) { return runs_to_end(r.scene.study); }
bool is_sweep(R r) { return r.scene.study == StudyKind::sweep; }
bool may_have_exponents(R r) { return is_sweep(r) || r.scene.study == StudyKind::lyapunov; }
bool asks_for_exponents(R r) {
    Node const* const count = is_sweep(r) ? r.given("study.exponents") : nullptr;
    return may_have_exponents(r) && (count == nullptr || read_count(*count, setting("study.exponents").what, 0, most_shadows) > 0);
}
bool of(R r, DesignKind design) { return r.scene.design.kind == design; }
bool by(R r, Method method) { return r.scene.integrator.method == method; }
bool by_restitution(R r) { return r.scene.parts.damping == Damping::restitution; }
bool gives_restitution(R r) { return by_restitution(r) && r.given("contact.restitution"); }
bool at_rest(R r) { return !turns(r); }
bool by_phase(R r) { return (is_sweep(r) || r.scene.study == StudyKind::poincare) && r.scene.chaos.section.is_phase(); }
bool no_values(R r) { return is_sweep(r) && !r.given("study.values"); }
bool no_exponents(R r) { return may_have_exponents(r) && r.scene.chaos.exponents == 0; }
bool several_exponents(R r) { return may_have_exponents(r) && r.scene.chaos.exponents > 1; }
bool is_whole(Span const& span) { return span.revolutions && span.value == std::floor(span.value); }
bool begins_anywhere(R r) { return is_sweep(r) && r.scene.chaos.continued && r.scene.chaos.transient.value != 0 && !is_whole(r.scene.chaos.transient); }
/// Of a crank that turns freely its speed is where it starts.
bool starts_by_parameter(R r) {
    Key const& key = *r.scene.chaos.parameter;
    return is_of_start(key) || (turns_freely(r) && key.name == "mechanism.crank_speed");
}
/// Whether the parameter moves faces otherwise than the starts of columns follow (continued_sweep.cpp): those of a way that is straight and along X.
bool starts_by_faces(R r) {
    auto const is_parameter = [&](std::string_view beginning) { return r.scene.chaos.parameter->name.starts_with(beginning); };
    constexpr std::array angles{"way.roll", "way.yaw", "way.pitch"};
    bool const askew = is_shaped(r) || std::ranges::any_of(angles, [&](char const* key) { return r.given(key) || varies(r.scene, key); });
    constexpr std::array fit{"joint.clearance", "joint.slider_length", "joint.way_", "mechanism.crank_length", "mechanism.rod_length", "slider.pin_"};
    return is_parameter("way_") || std::ranges::any_of(angles, is_parameter) || (askew && std::ranges::any_of(fit, is_parameter));
}
bool steps_in_time(R r) { return by(r, Method::moreau_jean); }
bool by_drive(R r, DriveBy by) { return r.scene.parts.drive.by == by; }
bool on_profile(R r) { return by_drive(r, DriveBy::profile); }
bool on_motor(R r) { return by_drive(r, DriveBy::torque); }
bool turns_on_profile(R r) { return on_profile(r) && info(r.scene.parts.mechanism).drive == DriveKind::crank; }
bool gives_drive_table(R r) { return r.given("drive.table") != nullptr; }
bool no_drive_table(R r) { return !gives_drive_table(r); }
bool keeps_statistics(R r) { return !r.scene.stores_members(); }
bool is_drawn(R r) { return of(r, DesignKind::mc) || of(r, DesignKind::lhs) || of(r, DesignKind::sobol); }
bool not_grid(R r) { return !of(r, DesignKind::grid); }
bool located(R r) { return r.scene.integrator.locate_modes; }
bool can_locate(R r) { return has_effect(setting("integrator.locate_modes"), r.scene.integrator.method, r.scene.parts); }
bool leaps(R r) { return has_switches(r.scene.parts) && !located(r); }
/// The switches that are leapt over separate neighbours: in trials exponents came out up to half as large again.
bool loses_exponents(R r) { return leaps(r) && r.scene.chaos.exponents > 0; }

bool nothing_varies(R r) {
    return std::ranges::none_of(r.scene.variations, [](Variation const& variation) {
        return variation.column != Variation::no_column || variation.distribution.kind != Distribution::Kind::constant;
    });
}

/// Whether both faces of an axis have clearances of their own, given or varied.
bool has_both_faces(R r, std::string const& axis) {
    return std::ranges::all_of(std::array{"_plus", "_minus"}, [&](char const* side) {
        std::string const key = "joint.clearance_" + axis + side;
        return r.given(key) || varies(r.scene, key);
    });
}
bool both_y(R r) { return has_both_faces(r, "y"); }
bool both_z(R r) { return has_both_faces(r, "z"); }
bool all_faces(R r) { return both_y(r) && both_z(r); }

bool no_restitution(R r) {
    constexpr std::string_view name = "contact.restitution";
    return needs_restitution(r.scene.parts) && !r.given(name) && !varies(r.scene, name);
}

/// Whether nobody said how much contacts take that could take some by χ and have no damping of their own.
bool rings(R r) {
    LawInfo const& law = contact_info(r.scene.parts);
    return spatial(r) && r.scene.parts.damping == Damping::point && has_group(law.groups, KeyGroup::surfaces) &&
           !has_group(law.groups, KeyGroup::point_damping) && !r.given("contact.chi_surface");
}

bool has_one_section(R r) {
    ChaosSettings const& chaos = r.scene.chaos;
    double const turn = turn_length(r.scene);
    return is_sweep(r) && chaos.exponents > 0 && chaos.transient.value == 0 && chaos.span.seconds(turn) < 2 * turn;
}

constexpr std::string_view each_face = "where all of its faces have their own", own_faces = "its faces have their own", vary_faces = "vary those";
constexpr std::string_view replaced = "contact.restitution replaces it", one_of_two = "remove one of the two";
constexpr std::string_view no_series = "kind = \"{study}\" stores no time series", with_series = "remove it, or use kind = \"ensemble\"";
constexpr std::string_view values_of_sweep = "a sweep needs its values", give_values = "give study.values, or study.from, study.to and study.points";
constexpr std::string_view no_revolutions = "{rest}, so there are no revolutions", no_angle = "{rest}, so no crank angle comes round";
constexpr std::string_view may_not_turn = "a crank that turns freely may never turn so far", give_limit = "add time_limit = \"60 s\"",
                           counts_turns = "with study.time_limit revolutions are counted";
constexpr std::string_view drawn_designs = "use \"mc\", \"lhs\" or \"sobol\"", uncorrelated = "remove it, or use \"mc\", \"lhs\" or \"sobol\"";
constexpr std::string_view with_design = "with design \"{design}\"", without_exponents = "with study.exponents = 0";
constexpr std::string_view rescaled = "with several exponents: their neighbours are rescaled every time";
constexpr std::string_view columns_begin = "with start = \"continue\" columns begin at the crank angle where the one before ended",
                           whole_transient = "use a whole number of study.transient_revolutions";

using enum Known;

constexpr std::string_view other_drive = "drive.kind \"{drive}\" does not have it", another_drive = "remove it, or use another kind";
constexpr std::string_view what_profile = "what the profile's column is", of_table = "it is of a table, and there is none", give_table = "give table, or remove it";

constexpr KeyRule rows[] = {
    {mechanism, "drive.torque", on_motor, needs, "what the motor turns with", "add torque = \"2 N m\"", "drive.kind"},
    {mechanism, "drive.gives", turns_on_profile, needs, what_profile, "add gives = \"angle\" or \"speed\"", "drive.kind"},
    {mechanism, "drive.gives", on_profile, needs, what_profile, "add gives = \"position\" or \"speed\"", "drive.kind"},
    {mechanism, "drive.gives", [](R r) { return !on_profile(r); }, excludes, other_drive, another_drive},
    {mechanism, "drive.table", on_profile, needs, "a profile is a table over time", "add table = \"profile.csv\"", "drive.kind"},
    {mechanism, "drive.table", [](R r) { return !on_profile(r) && !on_motor(r); }, excludes, other_drive, another_drive},
    {mechanism, "drive.column", gives_drive_table, needs, "which of the table's columns the drive has", "add column = \"speed\", or what it is called", "drive.kind"},
    {mechanism, "drive.over", [](R r) { return on_motor(r) && gives_drive_table(r); }, needs, "what the torque is read over", "add over = \"crank_speed\"", "drive.kind"},
    {mechanism, "drive.over", [](R r) { return !on_motor(r); }, excludes, other_drive, another_drive},
    {mechanism, "drive.over", no_drive_table, excludes, of_table, give_table},
    {mechanism, "drive.column", no_drive_table, excludes, of_table, give_table},
    {mechanism, "drive.interpolation", no_drive_table, excludes, of_table, give_table},
    {mechanism, "drive.repeats", no_drive_table, excludes, of_table, give_table},

    {mechanism, "contact.law", [](R r) { return rigid(r) && !may_be_rigid(r.scene.parts.mechanism); }, excludes,
     "the contacts of a {mechanism} give way", "use another law, or mechanism.kind = {rigid_mechanisms}"},
    {mechanism, "way", [](R r) { return !spatial(r); }, foreign},
    {mechanism, "way_profile", [](R r) { return !spatial(r); }, foreign},
    {mechanism, "way_ends", [](R r) { return !spatial(r); }, foreign},
    {mechanism, "way_ends", rigid, excludes, "rigid contacts are with a way without ends", "use another contact.law, or remove it"},
    {mechanism, "way_profile", rigid, excludes, "rigid contacts are with straight faces", "use another contact.law, or remove it"},
    {mechanism, "film", [](R r) { return !spatial(r); }, foreign},
    {mechanism, "film", rigid, excludes, "the equations of rigid contacts know no film", "use another contact.law, or remove it"},
    {mechanism, "film", is_shaped, excludes, "the film is reckoned between straight faces without ends", "remove it, or [way_profile] and [way_ends]"},
    {mechanism, "contact.law", [](R r) { return !spatial(r) && !rigid(r) && !may_be_rigid(r.scene.parts.mechanism); }, foreign},
    {mechanism, "contact.law", [](R r) { return !spatial(r) && !rigid(r); }, excludes,
     "the corners of a {mechanism} have one law", "remove it, or use \"rigid\""},

    {contacts, "contact.eta", gives_restitution, excludes, replaced, one_of_two},
    {contacts, "contact.chi_line", gives_restitution, excludes, replaced, one_of_two},
    {contacts, "contact.chi_surface", gives_restitution, excludes, replaced, one_of_two},

    {variation, "joint.clearance_y", both_y, excludes, own_faces, vary_faces},
    {variation, "joint.clearance_z", both_z, excludes, own_faces, vary_faces},
    {variation, "joint.clearance", all_faces, excludes, own_faces, vary_faces},
    {variation, "friction.", [](R r) { return !r.scene.parts.friction; }, excludes, "friction is off", "add a [friction] table"},
    {variation, "contact.eta", by_restitution, excludes, replaced, one_of_two},
    {variation, "contact.chi_", by_restitution, excludes, replaced, one_of_two},

    {study_kind, "study.samples_per_revolution", [](R r) { return !to_end(r); }, excludes, no_series, with_series},
    {study_kind, "study.samples", [](R r) { return !to_end(r); }, excludes, no_series, with_series},
    {study_kind, "study.duration", is_sweep, excludes, "a sweep records whole revolutions", "use study.revolutions"},
    {study_kind, "study.section", is_sweep, excludes, "a sweep takes its sections at a phase of the drive", "use study.phase"},
    {study_kind, "study.dt", is_sweep, excludes, "rescalings of a sweep fall on its sections", "use study.rescalings_per_revolution"},
    {study_kind, "study.max_crossings", [](R r) { return r.scene.study == StudyKind::poincare && !r.given("study.section"); }, excludes,
     "a phase comes once a revolution", "remove it, or give study.section"},
    {study_kind, "study.kind", [](R r) { return asks_for_exponents(r) && r.scene.parts.linkage != nullptr && !info(r.scene.parts.mechanism).has_exponents; }, excludes,
     "no exponents are computed of linkages whose ideal joints close loops", "use \"ensemble\" or \"poincare\", or give a joint of each loop clearance"},
    {study_kind, "study.kind", [](R r) { return asks_for_exponents(r) && !info(r.scene.parts.mechanism).has_exponents; }, excludes,
     "nothing drives a {mechanism}, and no exponents are computed of it", "use \"ensemble\" or \"poincare\""},
    {study_kind, "study.kind", [](R r) { return asks_for_exponents(r) && rigid(r) && info(r.scene.parts.mechanism).driven_form != nullptr; }, excludes,
     "with rigid contacts no exponents are computed of a {kind} whose crank turns freely", "use \"ensemble\", exponents = 0 in a sweep, another contact.law, or mechanism.kind = planar_slider_crank"},
    {study_kind, "study.parameter", is_sweep, needs, "a sweep changes one key", "add parameter = \"joint.clearance\""},
    {study_kind, "study.from", no_values, needs, values_of_sweep, give_values},
    {study_kind, "study.to", no_values, needs, values_of_sweep, give_values},
    {study_kind, "study.points", no_values, needs, "how many columns there are", "add points = 50"},

    {members, "study.design", [](R r) { return is_sweep(r) && !is_drawn(r); }, excludes, "a sweep draws the starts of its columns", drawn_designs},
    {members, "study.design", [](R r) { return of(r, DesignKind::saltelli) && !to_end(r); }, excludes,
     "kind = \"{study}\" asks for no sensitivities", "use \"mc\", \"lhs\" or \"sobol\", or kind = \"tolerance\""},
    {members, "study.design", [](R r) { return !of(r, DesignKind::mc) && !of(r, DesignKind::table) && nothing_varies(r); }, excludes,
     "nothing varies", "add keys to [study.vary], or remove it"},
    {members, "study.table", [](R r) { return of(r, DesignKind::table); }, needs,
     "the design is the rows of a table", "add table = \"members.csv\"", "study.design"},
    {members, "study.table", [](R r) { return !of(r, DesignKind::table); }, excludes,
     "design \"{design}\" reads no table", "use design = \"table\", or remove it"},
    {members, "study.base", [](R r) { return of(r, DesignKind::saltelli); }, needs,
     "\"saltelli\" has base rows of one member and one more of each key and another", "add base = 256", "study.design"},
    {members, "study.base", [](R r) { return is_drawn(r) && !r.given("study.members"); }, excludes,
     "design \"{design}\" has no rows of members, and study.members is not given", "add members = 1024, or use design = \"saltelli\""},
    {members, "study.base", [](R r) { return !of(r, DesignKind::saltelli); }, idle, with_design},
    {members, "study.levels", not_grid, idle, with_design},
    {members, "study.correlation", [](R r) { return of(r, DesignKind::saltelli); }, excludes,
     "sensitivities of design \"saltelli\" are of keys that vary alone", uncorrelated},
    {members, "study.correlation", [](R r) { return of(r, DesignKind::grid); }, excludes, "a grid takes its levels of each key alone", uncorrelated},

    {orbits, "study.time_limit", [](R r) { return !turns_freely(r); }, excludes, "revolutions of the drive last as long as they do", "remove it"},
    {orbits, "study.time_limit", [](R r) { return r.given("study.duration") != nullptr; }, excludes, "study.duration ends members before", one_of_two},
    {orbits, "study.time_limit", [](R r) { return turns_freely(r) && r.given("study.revolutions"); }, needs, may_not_turn, give_limit, "study.revolutions"},
    {orbits, "study.time_limit", [](R r) { return turns_freely(r) && by_phase(r); }, needs, may_not_turn, give_limit, "study.kind"},
    {orbits, "study.Ttr", by_turns, excludes, counts_turns, "use study.transient_revolutions"},
    {orbits, "study.dt", by_turns, excludes, counts_turns, "use study.rescalings_per_revolution"},
    {orbits, "study.transient_revolutions", at_rest, excludes, no_revolutions, "use study.Ttr instead"},
    {orbits, "study.revolutions", at_rest, excludes, no_revolutions, "use study.duration instead"},
    {orbits, "study.phase", [](R r) { return at_rest(r) && by_phase(r) && !is_sweep(r); }, cannot, no_angle, "give study.section"},
    {orbits, "study.phase", [](R r) { return at_rest(r) && is_sweep(r) && on_profile(r); }, cannot, no_angle, "use drive.kind = \"speed\", or a profile that repeats"},
    {orbits, "study.phase", [](R r) { return at_rest(r) && is_sweep(r); }, cannot, no_angle, "give the crank a speed"},
    {orbits, "study.rescalings_per_revolution", at_rest, excludes, no_revolutions, "use study.dt instead"},
    {orbits, "study.d0", no_exponents, idle, without_exponents},
    {orbits, "study.d0_lower", no_exponents, idle, without_exponents},
    {orbits, "study.d0_upper", no_exponents, idle, without_exponents},
    {orbits, "study.rescalings_per_revolution", no_exponents, idle, without_exponents},
    {orbits, "study.d0_lower", several_exponents, idle, rescaled},
    {orbits, "study.d0_upper", several_exponents, idle, rescaled},
    {orbits, "study.revolutions", [](R r) { return is_sweep(r) && !is_whole(r.scene.chaos.span); }, excludes,
     "a sweep records whole revolutions", "use an integer"},
    {orbits, "study.Ttr", begins_anywhere, excludes, columns_begin, whole_transient},
    {orbits, "study.transient_revolutions", begins_anywhere, excludes, columns_begin, whole_transient},
    {orbits, "study.start", [](R r) { return is_sweep(r) && r.scene.chaos.continued && starts_by_parameter(r); }, excludes,
     "{parameter} is where a member starts, and columns start where the one before ended", "use start = \"fresh\", or another parameter"},
    {orbits, "study.start", [](R r) { return r.scene.chaos.continued && r.scene.parts.linkage != nullptr; }, excludes,
     "a linkage is put together anew for each value", "use start = \"fresh\""},
    {orbits, "study.start", [](R r) { return r.scene.chaos.continued && starts_by_faces(r); }, excludes,
     "{parameter} moves the faces of the way, and columns start where the one before ended", "use start = \"fresh\", or another parameter"},
    {orbits, "study.start",
     [](R r) { return r.scene.chaos.continued && info(r.scene.parts.mechanism).drive == DriveKind::carriage && r.scene.chaos.section.level != 0; }, excludes,
     "a carriage starts at phase 0, and columns would end at study.phase", "use start = \"fresh\", or phase = 0"},
    {orbits, "study.start", [](R r) { return r.scene.chaos.continued && on_profile(r); }, excludes,
     "columns begin at time 0, where the drive's profile begins anew", "use start = \"fresh\""},
    {orbits, "study.start",
     [](R r) { return r.scene.chaos.continued && on_motor(r) && r.scene.drive != nullptr && jumps_at_columns(r.scene.parts.drive.over, r.scene.drive->table); }, excludes,
     "columns begin at time 0 in the first turn, where the motor's table would jump", "use start = \"fresh\", or a table over crank_angle that repeats every turn"},
    {orbits, "study.start", [](R r) { return r.scene.chaos.continued && !jumping_load(r.scene.loads.get()).empty(); }, excludes,
     "columns begin at time 0 in the first turn, where the table of {jumping_load} would jump",
     "use start = \"fresh\", or a table over crank_angle that repeats every turn"},
    {orbits, "study.revolutions", has_one_section, cannot, "exponents are taken between its sections, and there is one", "use at least 2, or a transient"},
    {study, "contact.law", [](R r) { return rigid(r) && no_restitution(r); }, excludes, "rigid contacts need contact.restitution", "give it, from 0 to 1"},
    {study, "contact.law", no_restitution, excludes, "{law} needs contact.restitution", "give it, from 0 to 1"},
    {study, "contact.law", [](R r) { return spatial(r) && !r.given("contact.law"); }, warns, "contact.law is not given and is \"{law}\": {words}", "name it"},
    {study, "contact.chi_surface", rings, warns,
     "neither contact.restitution nor contact.chi_surface is given: contacts of \"{law}\" then take no energy, and what touches rings for ever",
     "give one of the two"},

    {method, "integrator.method", [](R r) { return steps_in_time(r) && !rigid(r); }, excludes,
     "time stepping is of rigid contacts", "use contact.law = \"rigid\", or method = \"auto\""},
    {method, "integrator.method", [](R r) { return by(r, Method::rk4) && by_restitution(r); }, excludes,
     "contact.restitution wants the speed at each touch, where the method's steps do not end", "use method {methods}"},
    {method, "integrator.method", [](R r) { return by(r, Method::ros34pw2) && rigid(r); }, excludes,
     "the method has no Jacobian of a {mechanism} with rigid contacts", "use method {methods}"},
    {method, "integrator.method", [](R r) { return by(r, Method::ros34pw2) && !spatial(r); }, excludes,
     "the method has no Jacobian of a {mechanism}", "use method {methods}"},
    {method, "integrator.method", [](R r) { return rigid(r) && (by(r, Method::bs32) || by(r, Method::dop853)); }, excludes,
     "rigid contacts end steps so often that a method of another order gains nothing", "use method {methods}"},

    {integrator, "integrator.method", [](R r) { return has_fixed_step(r.scene.integrator.method) && !r.given("integrator.step"); }, excludes,
     "the method has no step control", "give integrator.step"},
    {integrator, "integrator.method", [](R r) { return steps_in_time(r) && r.scene.chaos.exponents > 0; }, excludes,
     "time stepping takes no neighbours along, which exponents are of", "use method {pairs}"},
    {integrator, "integrator.method", [](R r) { return steps_in_time(r) && r.scene.chaos.section.on == SectionSurface::On::impacts; }, excludes,
     "time stepping knows impulses of whole steps, and no impacts", "use method {pairs}"},
    {integrator, "friction.static",
     [](R r) { return steps_in_time(r) && r.scene.parts.friction && r.scene.inputs.friction_static != r.scene.inputs.friction_kinetic; },
     idle, "with method moreau_jean, whose contacts stick up to friction.kinetic"},
    {integrator, "integrator.locate_modes", [](R r) { return leaps(r) && by(r, Method::verner65) && r.scene.chaos.exponents == 0; }, excludes,
     "verner65 ends its steps at contacts in any case", "remove it, or use method \"dopri5\""},
    {integrator, "integrator.locate_modes", [](R r) { return located(r) && rigid(r); }, excludes,
     "rigid contacts end steps at their touches already", "remove it"},
    {integrator, "integrator.locate_modes", [](R r) { return located(r) && !spatial(r); }, excludes, "nothing switches in a {mechanism}", "remove it"},
    {integrator, "integrator.locate_modes", [](R r) { return located(r) && !contact_info(r.scene.parts).switches; }, excludes,
     "contact.law \"{law}\" has no modes to switch between", "remove it"},
    {integrator, "integrator.locate_modes", [](R r) { return located(r) && by_restitution(r); }, excludes,
     "contact.restitution ends steps at its touches already", one_of_two},
    {integrator, "integrator.locate_modes", [](R r) { return located(r) && !can_locate(r); }, excludes,
     "{method} cannot end its steps there", "use method {any_pair}"},
    {integrator, "integrator.locate_modes", [](R r) { return loses_exponents(r) && can_locate(r); }, warns,
     "integrator.locate_modes is false{leaping}", "leave it out"},
    {integrator, "integrator.method", [](R r) { return loses_exponents(r) && !can_locate(r); }, warns,
     "integrator.method is {method}{leaping}", "use method {any_pair}"},

    {all, "joint.clearance_y", both_y, idle, each_face},
    {all, "joint.clearance_z", both_z, idle, each_face},
    {all, "joint.clearance", all_faces, idle, each_face},
    {all, "study.store", [](R r) { return keeps_statistics(r) && of(r, DesignKind::saltelli); }, excludes,
     "sensitivity indices need every member's values", "use store = \"members\""},
    {all, "study.store", [](R r) { return keeps_statistics(r) && !r.scene.sample_times.empty(); }, excludes,
     "time series are of single members", "remove the samples, or use store = \"members\""},
    {all, "study.store", [](R r) { return keeps_statistics(r) && r.scene.quantities == 0; }, excludes,
     "there is no quantity to make statistics of", "add quantities = [\"mean_normal_force\"], or see `slideway list`"},
};

}  // namespace
}  // namespace key_rule_table

KeyRules key_rules() { return key_rule_table::rows; }

// The walk over the rules between keys.

namespace {

/// "a", "b" or "c".
std::string listed(MethodSet methods) {
    std::vector<std::string> names;
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        if ((methods & set_of(method)) != 0) names.push_back(fmt::format("\"{}\"", name_of(method)));
    }
    if (names.empty()) return {};
    std::string const last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

std::string rigid_mechanisms() {
    std::vector<std::string_view> rigid;
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (may_be_rigid(static_cast<Mechanism>(i)) && mechanisms()[i].driven_form == nullptr) rigid.push_back(mechanism_names()[i]);
    }
    return fmt::format("{}", fmt::join(rigid, " or "));
}

/// What texts of rules may say of a scene in braces.
constexpr struct {
    std::string_view name;
    std::string (*text)(Scene const& scene);
} words[] = {
    {"mechanism", [](Scene const& s) { return std::string(info(s.parts.mechanism).name); }},
    {"rigid_mechanisms", [](Scene const&) { return rigid_mechanisms(); }},
    {"law", [](Scene const& s) { return std::string(contact_info(s.parts).name); }},
    {"words", [](Scene const& s) { return std::string(contact_info(s.parts).words); }},
    {"study", [](Scene const& s) { return std::string(name_of(s.study)); }},
    {"design", [](Scene const& s) { return std::string(name_of(s.design.kind)); }},
    {"parameter", [](Scene const& s) { return std::string(s.chaos.parameter->name); }},
    {"drive", [](Scene const& s) { return std::string(drive_names[static_cast<int>(s.parts.drive.by)]); }},
    {"kind", [](Scene const& s) { return std::string(kind_of(s.parts.mechanism)); }},
    {"jumping_load", [](Scene const& s) { return std::string(jumping_load(s.loads.get())); }},
    {"rest", [](Scene const& s) { return why_no_period(s.parts); }},
    {"method", [](Scene const& s) { return std::string(name_of(s.integrator.method)); }},
    {"methods", [](Scene const& s) { return listed(methods_of(s.parts)); }},
    {"pairs", [](Scene const& s) { return listed(methods_of(s.parts) & method_sets::explicit_pairs); }},
    {"any_pair", [](Scene const&) { return listed(method_sets::explicit_pairs); }},
    {"leaping", [](Scene const& s) {
         return fmt::format(": steps leap over mode switches of contact.law \"{}\" and miss how they separate neighbours, so that exponents come out wrong",
                            contact_info(s.parts).name);
     }},
};

/// A text of a rule with the scene's words in the place of their names.
std::string filled(std::string_view text, Scene const& scene) {
    std::string filled;
    for (auto open = text.find('{'); open != text.npos; open = text.find('{')) {
        auto const close = text.find('}', open);
        auto const word = std::ranges::find(words, text.substr(open + 1, close - open - 1), [](auto const& one) { return one.name; });
        if (word == std::end(words)) throw std::logic_error(fmt::format("rules have no word for {}", text.substr(open)));
        filled.append(text.substr(0, open)).append(word->text(scene));
        text.remove_prefix(close + 1);
    }
    return filled.append(text);
}

}  // namespace

void apply_rules(Reading& reading, Known known) {
    using enum KeyRule::What;
    Scene& scene = reading.scene;
    for (KeyRule const& rule : reading.rules) {
        if (rule.after != known) continue;
        Node const* const node = reading.given(rule.key);
        bool const may_hold = rule.what == cannot || rule.what == warns || (rule.what == needs) == (node == nullptr);
        if (!may_hold || !rule.when(reading)) continue;
        Problem const problem{filled(rule.why, scene), filled(rule.instead, scene)};
        switch (rule.what) {
            case excludes: refuse(*node, problem);
            case foreign: refuse_meaningless(node->where, node->name, scene.parts.mechanism);
            case cannot: refuse_study(reading.root, node, rule.key, problem);
            case needs: refuse_missing(*reading.given(rule.asking), rule.key, problem.reason, problem.advice);
            case idle: scene.warnings.push_back(fmt::format("{} has no effect {}", rule.key, problem.reason)); break;
            case warns: scene.warnings.push_back(fmt::format("{}; {}", problem.reason, problem.advice));
        }
    }
}

void apply_rules(Reading const& reading, Key const& varied, Node const& node) {
    for (KeyRule const& rule : reading.rules) {
        bool const whole = !rule.key.ends_with('.') && !rule.key.ends_with('_');  // a key, or how several begin
        bool const meant = whole ? varied.name == rule.key : varied.name.starts_with(rule.key);
        if (rule.after == Known::variation && meant && rule.when(reading))
            refuse(node, {filled(rule.why, reading.scene), filled(rule.instead, reading.scene)});
    }
}

MethodSet methods_of(Parts const& parts) {
    MethodSet methods = 0;
    Scene scene;
    scene.parts = parts;
    Node const nothing;
    Reading const reading{nothing, scene};
    for (int i = 0; i < method_count; ++i) {
        scene.integrator.method = static_cast<Method>(i);
        auto const excludes = [&](KeyRule const& rule) { return rule.after == Known::method && rule.when(reading); };
        if (std::ranges::none_of(reading.rules, excludes)) methods |= set_of(scene.integrator.method);
    }
    return methods;
}

}  // namespace slideway
