// The keys of a study of orbits: for how long, what of them is recorded, and how neighbours go along.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/numbers.hpp"
#include "host/base/text.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

constexpr int apices = 8;

/// Names of what a section may be taken of: states, gaps, and at last impacts.
std::vector<std::string> surface_names(MechanismInfo const& mechanism) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(mechanism.states) + 2 * std::size_t{apices} + 1);
    for (int i = 0; i < mechanism.states; ++i) names.emplace_back(state_info(mechanism, i).name);
    for (char const* const face : {"gap_y", "gap_z"}) {
        for (int apex = 1; mechanism.spatial && apex <= apices; ++apex) names.push_back(fmt::format("{}[P{}]", face, apex));
    }
    names.emplace_back(impacts_name);
    return names;
}

/// Of compliant contacts an impact lasts, and a gap at a small level tells its beginning and its end.
void check_impacts(Node const& on, Node const* value, Parts const& parts) {
    if (!parts.rigid) {
        std::string_view const gap = info(parts.mechanism).spatial ? "on = \"gap_y[P1]\" with value = \"1 nm\", " : "";
        refuse(on, {"impacts of compliant contacts last", fmt::format("use {}the quantity contact_onsets, or contact.law = \"rigid\"", gap)});
    }
    if (value != nullptr) refuse(*value, {"an impact has no level", "remove it"});
}

/// Place of what crosses the section among `surface_names`.
int read_surface(Node const& on, MechanismInfo const& mechanism) {
    std::string const& name = read_text_value(on);
    auto const known = surface_names(mechanism);
    auto const found = std::ranges::find(known, name);
    if (found != known.end()) return static_cast<int>(found - known.begin());
    std::string_view const near = nearest_name(name, std::vector<std::string_view>(known.begin(), known.end()));
    auto const states = std::span(known).first(static_cast<std::size_t>(mechanism.states));
    std::string_view const gaps = mechanism.spatial ? ", gap_y[P1] to gap_y[P8], gap_z[P1] to gap_z[P8]" : "";
    refuse(on, {mechanism.spatial ? "neither a state nor a gap" : "no state of it",
                near.empty() ? fmt::format("use one of {}{}", fmt::join(states, ", "), gaps)
                             : fmt::format("did you mean \"{}\"?", near)});
}

/// study.section: where a poincare study takes its states.
void read_section(Node const& table, Scene& scene) {
    using On = SectionSurface::On;
    SectionSurface& section = scene.chaos.section;
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    std::string const example = "write for example { on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }";
    if (!table.is_table()) refuse(table, {"not a section", example});
    check_arguments(table, "section", {"on", "value", "direction"});
    Node const *const on = table.find("on"), *const value = table.find("value"), *const direction = table.find("direction");
    if (on == nullptr) refuse_that(table, "has no on", {"what crosses the section", example});
    int const index = read_surface(*on, mechanism), states = mechanism.states;
    if (on->text == impacts_name) {
        check_impacts(*on, value, scene.parts);
        section.on = On::impacts;
        section.direction = CrossingDirection::both;
    } else {
        section.on = index < states ? On::state : index < states + apices ? On::gap_y : On::gap_z;
        section.index = index < states ? index : (index - states) % apices;
        if (value != nullptr) section.level = read_number(*value, section_unit(section, scene.parts.mechanism));
    }
    // A crank may turn either way.
    if (section.on == On::state && mechanism.state[section.index] == Series::crank_angle) section.direction = CrossingDirection::both;
    if (direction != nullptr) section.direction = static_cast<CrossingDirection>(read_choice(*direction, "direction", crossing_direction_names));
}

constexpr double most_numbers = 1e7;  // of one member, which keeps them in memory while it runs

Node const* given_span(Reading const& reading) { return reading.given_of({"study.duration", "study.revolutions"}); }

/// Neighbours, their distances and how often they are rescaled.
void read_neighbours(Reading& reading) {
    Scene& scene = reading.scene;
    ChaosSettings& chaos = scene.chaos;
    int const least = scene.study == StudyKind::sweep ? 0 : 1, most = std::min(most_shadows, free_states(scene.parts));
    Node const *const count = reading.given("study.exponents"), *const lower = reading.given("study.d0_lower"), *const upper = reading.given("study.d0_upper");
    chaos.exponents = count != nullptr ? static_cast<int>(read_count(*count, setting("study.exponents").what, least, most)) : 1;
    if (lower == nullptr) chaos.d0_lower = std::max(chaos.d0 * 0.3, 1e-14);
    if (upper == nullptr) chaos.d0_upper = std::min(chaos.d0 * 3, 1.0);
    auto const beside = [&](std::string_view side) { return Problem{fmt::format("not {} study.d0, {}", side, chaos.d0), "use d0_lower < d0 < d0_upper"}; };
    if (lower != nullptr && !(chaos.d0_lower < chaos.d0)) refuse(*lower, beside("below"));
    if (upper != nullptr && !(chaos.d0_upper > chaos.d0)) refuse(*upper, beside("above"));
    Node const* const per_turn = reading.given("study.rescalings_per_revolution");
    if (!reading.given("study.dt")) {
        double const rescalings = per_turn != nullptr ? static_cast<double>(read_count(*per_turn, setting("study.rescalings_per_revolution"))) : 2000;
        chaos.dt = {1 / rescalings, std::isfinite(turn_length(scene))};
    }
    if (chaos.d0 < 1e-9)
        reading.warn(fmt::format("study.d0 is {} and below 1e-9 rounding shows: in impacts an offset's part in the positions is 1e-5 of it", chaos.d0));
    ChaosSettings const none;
    if (chaos.exponents == 0) chaos.d0 = none.d0, chaos.d0_lower = none.d0_lower, chaos.d0_upper = none.d0_upper, chaos.dt = none.dt;
    if (chaos.exponents > 1) chaos.d0_lower = chaos.d0 * 0.3, chaos.d0_upper = chaos.d0 * 3;
}

/// A block's members stop equally often: what they count by must not differ between them.
void check_common_count(Reading const& reading) {
    ChaosSettings const& chaos = reading.scene.chaos;
    bool const by_phase = reading.scene.study != StudyKind::lyapunov && chaos.section.is_phase();
    Key const* const varied = drive_periods(reading.scene).varied;
    if ((!by_phase && chaos.exponents == 0) || varied == nullptr) return;
    bool const turns = by_phase || chaos.dt.revolutions;
    auto const check = [&](Span const& span, std::string_view in_time, std::string_view in_turns) {
        if (span.value == 0 || span.revolutions == turns) return;
        std::string_view const counted = by_phase ? "sections" : "rescalings";
        std::string const reason = fmt::format("{} differs between members, and so would their number of {}", varied->name, counted);
        if (span.revolutions) refuse(*reading.given("study.dt"), {reason, "use study.rescalings_per_revolution"});
        refuse(*reading.given(in_time), {reason, fmt::format("use {}", in_turns)});
    };
    check(chaos.span, "study.duration", "study.revolutions");
    check(chaos.transient, "study.Ttr", "study.transient_revolutions");
}

void check_length(Reading const& reading) {
    ChaosSettings const& chaos = reading.scene.chaos;
    PeriodRange const periods = drive_periods(reading.scene);
    auto const refuse_length = [&](Problem const& problem) { refuse_study(reading.root, given_span(reading), "study.revolutions", problem); };
    if ((chaos.span.revolutions || chaos.transient.revolutions) && periods.varied != nullptr && !std::isfinite(periods.most))
        refuse_length({fmt::format("{} may be 0, where revolutions do not end", periods.varied->name), "vary it within limits of one sign"});
    double const longest = run_length(reading.scene).longest;
    if (!(longest <= longest_time)) {
        refuse_length({fmt::format("with the transient a member lasts {:.3g} s", longest), fmt::format("stay below {} s", longest_time)});
    }
}

void read_history(Reading& reading) {
    Scene& scene = reading.scene;
    ChaosSettings& chaos = scene.chaos;
    double const rescalings = parts_of(chaos.span, chaos.dt, turn_length(scene));
    if (!(rescalings >= 1)) {
        refuse_study(reading.root, given_span(reading), "study.revolutions",
                     {"it ends before the first rescaling", "record for longer, or rescale oftener"});
    }
    Node const* const node = reading.given("study.history");
    chaos.history = node != nullptr ? read_count(*node, setting("study.history")) : static_cast<std::size_t>(std::min(100.0, rescalings));
    if (static_cast<double>(chaos.history) > rescalings)
        refuse(*node, {fmt::format("there are {:.0f} rescalings", rescalings), fmt::format("use a value <= {:.0f}", rescalings)});
}

void check_memory(Reading const& reading) {
    Scene const& scene = reading.scene;
    ChaosSettings const& chaos = scene.chaos;
    double const period = turn_length(scene), numbers = info(scene.parts.mechanism).states;
    double sections = 0;
    if (scene.study != StudyKind::lyapunov) {
        sections = chaos.section.is_phase() ? parts_of(chaos.span, {1, true}, period) + 1 : static_cast<double>(chaos.max_crossings);
    }
    // Rescalings are recorded in sums, some thousands at most, or as many as the history asks for.
    double const records = std::min(parts_of(chaos.span, chaos.dt, period), std::max(4096.0, 2 * static_cast<double>(chaos.history)));
    double const growths = chaos.exponents > 0 ? records * chaos.exponents : 0;
    if (std::max(sections * numbers, growths) > most_numbers) {
        refuse_study(reading.root, given_span(reading), "study.revolutions",
                     {fmt::format("each member would hold {:.3g} numbers while it runs", std::max(sections * numbers, growths)),
                      fmt::format("record for a shorter time, or less often, at most {:g} numbers", most_numbers)});
    }
    double const columns = static_cast<double>(std::max<std::size_t>(chaos.values.size(), 1));
    double const values = static_cast<double>(scene.members) * columns * (sections * numbers + static_cast<double>(chaos.history) * chaos.exponents);
    if (values > most_values) {
        refuse_study(reading.root, reading.given("study.members"), "study.members",
                     {fmt::format("the results would hold {:.3g} numbers", values),
                      fmt::format("ask for fewer members or less of each, at most {:g} numbers", most_values)});
    }
}

}  // namespace

std::string_view section_unit(SectionSurface const& section, Mechanism mechanism) {
    if (section.is_phase()) return "rad";
    if (section.on != SectionSurface::On::state) return "m";
    SeriesInfo const& state = state_info(info(mechanism), section.index);
    Key const* const key = find_key(fmt::format("initial.{}", state.name));
    return key != nullptr ? key->unit : state.unit;
}

RunLength run_length(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    auto const at = [&](double period) { return chaos.transient.seconds(period) + chaos.span.seconds(period); };
    double const own = turn_length(scene);
    double const stops = chaos.exponents > 0 ? at(own) / chaos.dt.seconds(own) : chaos.section.is_phase() ? at(own) / own : 0;
    // Each angle is come to, tried again and gone on from.
    if (scene.goes_by_turns()) return {scene.integrator.end_time, scene.integrator.end_time, 4 * std::ceil(stops)};
    return {at(own), std::max(at(own), at(drive_periods(scene).most)), std::ceil(stops)};
}

void read_orbits(Reading& reading) {
    Scene& scene = reading.scene;
    ChaosSettings& chaos = scene.chaos;
    bool const lyapunov = scene.study == StudyKind::lyapunov, sweep = scene.study == StudyKind::sweep;
    // Where nothing turns there are no revolutions; each that would be the default is a second, as in an ensemble.
    bool const turns = reading.given("study.time_limit") != nullptr || std::isfinite(drive_period(scene.parts, scene.inputs));
    if (!reading.given_of({"study.Ttr", "study.transient_revolutions"})) chaos.transient = {lyapunov ? 2.0 : 20.0, turns};
    if (!given_span(reading)) chaos.span = {lyapunov ? 10.0 : sweep ? 50.0 : 150.0, turns};
    if (Node const* const table = lyapunov ? nullptr : reading.given("study.section")) read_section(*table, scene);
    else if (Node const* const phase = lyapunov ? nullptr : reading.given("study.phase")) chaos.section.level = read_number(*phase, "rad");
    if (lyapunov || sweep) read_neighbours(reading);
    apply_rules(reading, Known::orbits);
    check_common_count(reading);
    check_length(reading);
    if (lyapunov) read_history(reading);
    check_memory(reading);
}

namespace {

/// To 15 digits: the column at 0.1 mm then has the bits of a scene that says so.
double rounded(double value) { return parse_number<double>(fmt::format("{:.14e}", value)).value_or(value); }

std::vector<double> read_range(Reading const& reading, Key const& key) {
    Node const &first = *reading.given("study.from"), &last = *reading.given("study.to");
    double const from = read_number(first, key), to = read_number(last, key);
    std::uint64_t const points = read_count(*reading.given("study.points"), setting("study.points"));
    if (from == to) refuse(last, with_unit(to, key.unit), {"equal to study.from", "use another value, or study.values"});
    Node const* const spacing = reading.given("study.spacing");
    bool const logarithmic = spacing != nullptr && read_choice(*spacing, setting("study.spacing")) == 1;
    if (logarithmic && !(from * to > 0)) {
        refuse(*spacing, {fmt::format("from {} to {} there is no common ratio", with_unit(from, key.unit), with_unit(to, key.unit)),
                          "use ends of one sign, or \"linear\""});
    }
    std::vector<double> values(points);
    for (std::uint64_t i = 0; i < points; ++i) {
        double const part = static_cast<double>(i) / static_cast<double>(points - 1);
        values[i] = rounded(logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part);
    }
    values.front() = from;
    values.back() = to;
    return values;
}

/// Why a column cannot be run, if it is so.
std::optional<Problem> broken_column(Inputs inputs, Parts const& parts, Key const& key, double value) {
    key.set(inputs, value);
    if (key.name == "mechanism.crank_speed" && value == 0) return Problem{"a crank at rest comes to no section", "leave the value out"};
    auto const found = find_defect(inputs, parts);
    if (!found) return std::nullopt;
    return Problem{fmt::format("{} would be {}: {}", found->key->name, with_unit(found->value, found->key->unit), found->problem.reason),
                   found->problem.advice};
}

void check_values(Reading const& reading) {
    Scene const& scene = reading.scene;
    Key const& key = *scene.chaos.parameter;
    auto const& values = scene.chaos.values;
    Node const* const list = reading.given("study.values");
    for (std::size_t i = 0; i < values.size(); ++i) {
        auto const problem = broken_column(scene.inputs, scene.parts, key, values[i]);
        if (!problem) continue;
        std::string const shown = with_unit(values[i], key.unit);
        if (list != nullptr) refuse(list->children[i], shown, *problem);
        if (i == 0) refuse(*reading.given("study.from"), shown, *problem);
        if (i + 1 == values.size()) refuse(*reading.given("study.to"), shown, *problem);
        // An end that is wrong too says so first.
        if (auto const at_end = broken_column(scene.inputs, scene.parts, key, values.back()))
            refuse(*reading.given("study.to"), with_unit(values.back(), key.unit), *at_end);
        refuse(*reading.given("study.points"), {fmt::format("one is {}: {}", shown, problem->reason), "use study.values, or other limits"});
    }
}

}  // namespace

void read_sweep(Reading& reading) {
    Scene& scene = reading.scene;
    Node const& parameter = *reading.given("study.parameter");
    std::string const& name = read_text_value(parameter);
    Key const* const key = find_key(name, scene);
    if (key == nullptr) refuse_ungiven(parameter.where, name, scene);
    if (key == nullptr) refuse(parameter, {"only numeric keys of the physics can be swept", key_advice(name, scene)});
    check_varied(reading, parameter, *key, {"the sweep sets it in every column, so this has no effect", "use --set 'study.values=[...]'"});
    Node const* const list = reading.given("study.values");
    scene.chaos.parameter = key;
    scene.chaos.values = list != nullptr ? read_list(*list, *key, setting("study.points").most, "[\"0.1 mm\", \"0.2 mm\"]") : read_range(reading, *key);
    require_part(scene.parts, *key);
    check_values(reading);
}

}  // namespace slideway
