#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/outputs.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// Refuses what the study does not read, and the later one of two keys that say the same.
void check_keys(Reading& reading) {
    StudyKind const kind = reading.scene.study;
    apply_rules(reading, Known::study_kind);
    for (Setting const& key : reading.keys) {
        Node const* const node = reading.given(key.name);
        if (node == nullptr) continue;
        if ((key.studies & set_of(kind)) == 0) {
            std::vector<std::string> owners;
            for (std::size_t i = 0; i < std::size(study_kind_names); ++i) {
                if ((key.studies >> i & 1u) != 0) owners.push_back(fmt::format("\"{}\"", study_kind_names[i]));
            }
            refuse(*node, {fmt::format("it has no effect with kind = \"{}\"", name_of(kind)),
                           fmt::format("remove it, or use kind = {}", fmt::join(owners, " or "))});
        }
        for (std::string_view const rival : key.rivals) {
            // study.members may say what a design comes to.
            Node const* const other = rival.empty() || rival == "study.members" ? nullptr : reading.given(rival);
            if (other == nullptr) continue;
            bool const is_later = std::pair(node->order, node->line) > std::pair(other->order, other->line);
            refuse(is_later ? *node : *other, {fmt::format("{} says it too", is_later ? rival : key.name), "remove one of the two"});
        }
    }
}

/// Until when members run that have a known end.
double read_end_time(Reading const& reading) {
    Scene& scene = reading.scene;
    double const turn = drive_period(scene.parts, scene.inputs);
    Node const* const node = reading.given_of({"study.duration", "study.revolutions"});
    bool const has_limit = reading.given("study.time_limit") != nullptr;
    if (node == nullptr) scene.chaos.span = {1, has_limit || std::isfinite(turn)};
    if (has_limit) return scene.integrator.end_time;
    // Who asks for revolutions of drives that scatter has each member's own.
    auto const periods = drive_periods(scene);
    bool const differ = reading.given("study.revolutions") != nullptr && periods.varied != nullptr;
    if (differ && !std::isfinite(periods.most))
        refuse(*node, {fmt::format("{} may be 0, where revolutions do not end", periods.varied->name), "vary it within limits of one sign, or use study.duration"});
    double const longest = differ ? periods.most : turn, seconds = scene.chaos.span.seconds(longest);
    if (seconds > 0 && seconds <= longest_time) return seconds;
    std::string const reason = fmt::format("it lasts {} s, with {} s for each", seconds, longest), advice = fmt::format("stay below {} s", longest_time);
    if (node != nullptr) refuse(*node, {reason, advice});
    throw SceneError(fmt::format("{}: study.revolutions is 1 ({}); {}", reading.root.where, reason, advice));
}

void check_drive_is_resolved(Reading const& reading, double seconds) {
    // A crank that turns freely ends after its turns, however long it may take.
    if (reading.scene.goes_by_turns()) seconds = reading.scene.chaos.span.seconds(steady_period(reading.scene.parts, reading.scene.inputs));
    auto const problem = unresolved_drive(reading.scene.parts, reading.scene.inputs, seconds);
    if (!problem) return;
    if (Node const* const node = reading.given_of({"study.revolutions", "study.duration"})) refuse(*node, *problem);
    throw SceneError(fmt::format("{}: the study is too long: {}; {}", reading.root.where, problem->reason, problem->advice));
}

/// How many times a time series has.  @param length until when, in what members go by
std::size_t read_samples(Reading const& reading, double length) {
    Scene const& scene = reading.scene;
    double const most = static_cast<double>(setting("study.samples").most);  // of one member: they stay in memory while it runs
    if (Node const* const node = reading.given("study.samples")) {
        std::uint64_t const count = read_count(*node, setting("study.samples"));
        if (count == 1) refuse(*node, {"the first and the last time are both stored", "use 0 or at least 2"});
        if (count > 1 && length / static_cast<double>(count) < std::numeric_limits<double>::min())
            refuse(*node, {fmt::format("no numbers tell the times of {} s apart", length), "use a longer study.duration"});
        return count;
    }
    Node const* const node = reading.given("study.samples_per_revolution");
    std::uint64_t const per_turn = node != nullptr ? read_count(*node, setting("study.samples_per_revolution")) : 0;
    if (per_turn == 0) return 0;
    double const turn = turn_length(scene);
    if (!std::isfinite(turn)) refuse(*node, {why_no_period(scene.parts) + ", so there are no revolutions", "use study.samples instead"});
    double const turns = scene.chaos.span.revolutions ? scene.chaos.span.value : length / turn;
    double const intervals = std::max(1.0, std::round(static_cast<double>(per_turn) * turns));
    if (intervals >= most) refuse(*node, {fmt::format("that makes {} samples of each member", intervals + 1), fmt::format("ask for at most {}", most)});
    return static_cast<std::size_t>(intervals) + 1;
}

/// `count` times from 0 to the end, both included; count is 0 or at least 2.
std::vector<double> uniform_times(double end, std::size_t count) {
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i) times[i] = end * static_cast<double>(i) / static_cast<double>(count - 1);
    if (count > 0) times.back() = end;
    return times;
}

/// Until when members run that have a known end, and when they are sampled on the way.
void read_times(Reading const& reading, double end) {
    Scene& scene = reading.scene;
    double const length = scene.goes_by_turns() ? scene.chaos.span.seconds(turn_length(scene)) : end;
    scene.sample_times = uniform_times(length, read_samples(reading, length));
    if (scene.goes_by_turns()) return;
    Key const* const varied = drive_periods(scene).varied;
    if (reading.given("study.revolutions") == nullptr || varied == nullptr) scene.chaos.span = {end, false};
    else if (Node const* const samples = reading.given_of({"study.samples", "study.samples_per_revolution"}); samples != nullptr && !scene.sample_times.empty())
        refuse(*samples, {fmt::format("members are sampled at common times, and their revolutions last differently: {} is drawn", varied->name), "use study.duration in place of study.revolutions"});
}

/// A quantity or a series that the scene's mechanism does not have.
[[noreturn]] void refuse_foreign_quantity(Node const& node, std::string_view name, Mechanism mechanism) {
    throw SceneError(fmt::format("{}: {} is no quantity of a {}; see `slideway list`", node.where, name, kind_of(mechanism)));
}

Problem const untold_by_rigid_contacts{"rigid contacts tell their normal forces in sum alone", "remove it, or use another contact.law"};

/// Why the scene's members do not have a quantity of their mechanism, where it is so.
std::optional<Problem> why_unknown(Quantity quantity, Scene const& scene) {
    if (scene.parts.rigid && selects(selections::force_quantities & without_rigid_contact, quantity)) return untold_by_rigid_contacts;
    if (scene.integrator.method == Method::moreau_jean && selects(of_single_impacts, quantity))
        return Problem{"moreau_jean knows impulses of whole steps, and no single impacts", "remove it, or use method = \"auto\""};
    if (scene.parts.rigid && selects(without_rigid_contact, quantity))
        return Problem{"rigid contacts have neither peaks nor a potential", "remove it, or use another contact.law"};
    if (!scene.parts.rigid && selects(of_rigid_contact, quantity))
        return Problem{"only impacts of rigid contacts have a bound of their energy", "remove it, or use contact.law = \"rigid\""};
    if (quantity == Quantity::switching_energy && makes_energy(scene.parts) && !scene.integrator.locate_modes)
        return Problem{"it is known where steps end at the switches, and here they leap over them", "remove it, or leave [integrator] to its defaults"};
    return {};
}

void read_series(Node const& node, std::size_t place, Scene& scene) {
    if (scene.sample_times.empty()) {
        refuse(node, {"it is a time series and the study stores none",
                      scene.study == StudyKind::ensemble ? "set study.samples_per_revolution or study.samples" : "remove it, or use kind = \"ensemble\""});
    }
    if (scene.integrator.method == Method::moreau_jean && selects(series_without_time_stepping, static_cast<Series>(place)))
        refuse(node, {"moreau_jean knows impulses of whole steps, and no forces of an instant", "remove it, or use method = \"auto\""});
    if (scene.parts.rigid && selects(force_series, static_cast<Series>(place))) refuse(node, untold_by_rigid_contacts);
    scene.series |= Selection{1} << place;
}

void read_quantities(Reading& reading, Node const& list) {
    Scene& scene = reading.scene;
    if (list.type != Node::Type::array) refuse(list, {"not a list of names", "write for example [\"mean_normal_force\", \"energy_residual\"]"});
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    std::vector<std::string_view> names;
    for (QuantityInfo const& quantity : outputs.quantities) names.emplace_back(quantity.name);
    std::vector<std::size_t> places;  // of series; those of a linkage have gaps between them
    for (std::size_t i = 0; i < outputs.series.size(); ++i) {
        if (outputs.series[i].name[0] == '\0') continue;
        names.emplace_back(outputs.series[i].name);
        places.push_back(i);
    }
    for (Node const& given : list.children) {
        Node node = given;
        node.text = reading.named_now(given, given.text);
        std::size_t const index = read_choice(node, "quantity", names);
        bool const is_series = index >= outputs.quantities.size();
        std::size_t const place = is_series ? places[index - outputs.quantities.size()] : index;
        if (((is_series ? outputs.has_series : outputs.has_quantities) >> place & 1u) == 0) refuse_foreign_quantity(node, names[index], scene.parts.mechanism);
        if (is_series) {
            read_series(node, place, scene);
            continue;
        }
        if (auto const why = why_unknown(static_cast<Quantity>(place), scene)) refuse(node, *why);
        scene.quantities |= Selection{1} << place;
    }
}

void check_size(Reading const& reading) {
    Scene const& scene = reading.scene;
    double const values = static_cast<double>(scene.members) * static_cast<double>(scene.sample_times.size()) * std::popcount(scene.series);
    if (values <= most_values) return;
    refuse(*reading.given_of({"study.samples", "study.samples_per_revolution"}),
           {fmt::format("the time series of {} members would hold {:.3g} numbers", scene.members, values),
            fmt::format("ask for fewer samples, members or series, at most {:g} numbers", most_values)});
}

[[noreturn]] void refuse_name(Node const& node, std::string const& why, std::string const& advice) { refuse_that(node, "cannot be limited", {why, advice}); }

/// Of "mode_time[free]" or "peak_normal_force": its place among the outputs of the mechanism, and the label.
std::pair<std::size_t, std::string> read_name(Reading& reading, Node const& node) {
    Scene const& scene = reading.scene;
    std::string_view const name = node.key;
    auto const bracket = name.find('[');
    std::string_view const quantity = reading.named_now(node, name.substr(0, bracket));
    std::vector<std::string_view> names;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (QuantityInfo const& info : outputs.quantities) names.emplace_back(info.name);
    auto const found = std::ranges::find(names, quantity);
    if (found == names.end()) {
        if (std::ranges::any_of(outputs.series, [&](SeriesInfo const& info) { return quantity == info.name; }))
            refuse_name(node, "it is a time series", "limit a quantity, see `slideway list`");
        refuse_name(node, "there is no such quantity", choice_advice(quantity, names));
    }
    auto const place = static_cast<std::size_t>(found - names.begin());
    if ((outputs.has_quantities >> place & 1u) == 0) refuse_foreign_quantity(node, quantity, scene.parts.mechanism);
    if (auto const why = why_unknown(static_cast<Quantity>(place), scene)) refuse_name(node, why->reason, why->advice);
    QuantityInfo const& info = outputs.quantities[place];
    if (info.dimension == nullptr) {
        if (bracket != name.npos) refuse_name(node, "it is one number", fmt::format("write \"{}\"", quantity));
        return {place, {}};
    }
    auto const labels = labels_of(info.dimension);
    std::string const advice = fmt::format("write \"{}[{}]\", one of {}", quantity, labels.front(), fmt::join(labels, ", "));
    if (bracket == name.npos) refuse_name(node, fmt::format("it has a value for each {}", info.dimension), advice);
    std::string_view label = name.substr(bracket + 1);
    bool const closed = label.ends_with(']');
    if (closed) label.remove_suffix(1);
    if (!closed || std::ranges::find(labels, label) == labels.end()) refuse_name(node, fmt::format("there is no such {}", info.dimension), advice);
    return {place, std::string(label)};
}

Limit read_limit(Node const& node, QuantityInfo const& info, std::string label) {
    std::string const example = "write for example { min = 0, max = 1 }, or one of the two";
    if (!node.is_table()) refuse(node, {"not a limit", example});
    check_arguments(node, "limit", {"min", "max"});
    Node const *const low = node.find("min"), *const high = node.find("max");
    if (low == nullptr && high == nullptr) refuse_that(node, "has neither min nor max", {"it would be met always", example});
    Limit limit{info.name, std::move(label)};
    if (low != nullptr) limit.low = read_number(*low, info.unit);
    if (high != nullptr) limit.high = read_number(*high, info.unit);
    if (limit.low > limit.high)
        refuse(*high, with_unit(limit.high, info.unit), {fmt::format("below min, {}", with_unit(limit.low, info.unit)), "use min <= max"});
    return limit;
}

/// [study.limits]; adds their quantities to those asked for.
void read_limits(Reading& reading) {
    Node const* const table = reading.given("study.limits");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"it must be a table", "write [study.limits] and its quantities below"});
    Scene& scene = reading.scene;
    for (Node const& node : table->children) {
        auto const [place, label] = read_name(reading, node);
        QuantityInfo const& quantity = outputs_of(scene.parts.mechanism).quantities[place];
        auto const is_of_same = [&](Limit const& other) { return other.quantity == quantity.name && other.label == label; };
        if (std::ranges::any_of(scene.limits, is_of_same)) refuse_name(node, fmt::format("{} is limited already", quantity.name), "remove one of the two");
        scene.limits.push_back(read_limit(node, quantity, label));
        scene.quantities |= Selection{1} << place;
    }
}

}  // namespace

std::optional<Problem> unresolved_drive(Parts const& parts, Inputs const& inputs, double seconds) {
    double const turn = steady_period(parts, inputs);
    if (!std::isfinite(turn)) return {};
    bool const cranks = info(parts.mechanism).drive == DriveKind::crank;
    double const radius = cranks ? inputs.crank_length : inputs.stroke / 2;
    constexpr double of_clearance = 1e-6;
    double const per_turn = 2 * std::numbers::pi * std::numeric_limits<double>::epsilon() * radius;
    double const most = of_clearance * play_y(inputs) / per_turn, turns = seconds / turn;
    if (!(turns > most)) return {};
    return Problem{fmt::format("after {:.3g} {} the last bit of a number of double precision moves the drive by {:.2g} of the clearance", turns,
                               cranks ? "revolutions" : "cycles", of_clearance * turns / most),
                   fmt::format("stay below {:.2g} s, or run several members", most * turn)};
}

void read_study(Reading& reading) {
    Scene& scene = reading.scene;
    if (Node const* const kind = reading.given("study.kind")) read_value(*kind, setting("study.kind"), scene.study);
    check_keys(reading);
    reading.read_table("study");
    read_design(reading);
    if (scene.study == StudyKind::sweep) read_sweep(reading);
    if (runs_to_end(scene.study)) apply_rules(reading, Known::orbits);
    else read_orbits(reading);
    apply_rules(reading, Known::study);
}

void read_recording(Reading& reading) {
    Scene& scene = reading.scene;
    bool const samples = runs_to_end(scene.study);
    double const end = samples ? read_end_time(reading) : run_length(scene).seconds;
    RunLength const length = samples ? RunLength{end, end, 0} : run_length(scene);
    scene.integrator.end_time = end;
    read_steps(reading, length);
    check_drive_is_resolved(reading, length.longest);
    if (samples) read_times(reading, end);
    if (!scene.sample_times.empty()) scene.series = info(scene.parts.mechanism).always;
    Node const* const list = reading.given("study.quantities");
    if (list != nullptr) read_quantities(reading, *list);
    read_limits(reading);
    if (scene.study == StudyKind::tolerance && scene.quantities == 0) {
        refuse_missing(list != nullptr ? *list : *reading.given("study.kind"), "a quantity", "a tolerance study tells how quantities scatter",
                       "add quantities = [\"mean_normal_force\", \"friction_loss\"], or see `slideway list`");
    }
    // The audit runs anyway, and whoever takes such a method should see what it says.
    if (is_always_audited(scene.integrator.method)) scene.quantities |= selection_of(Quantity::energy_residual);
    check_size(reading);
    apply_rules(reading, Known::all);
}

}  // namespace slideway
