// The keys of a study of orbits: for how long, what of them is recorded, and how neighbours go along.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/config/reader.hpp"

namespace slideway {
namespace {

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

}  // namespace slideway
