#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/config/reader.hpp"

namespace slideway {
namespace {

constexpr double most_numbers = 1e7;                // of one member, which keeps them in memory while it runs

/// The two keys of a length of time.
struct SpanKeys {
    std::string_view time, turns;  // dotted names
};
constexpr SpanKeys span_keys{"study.duration", "study.revolutions"};
constexpr SpanKeys transient_keys{"study.Ttr", "study.transient_revolutions"};
constexpr SpanKeys dt_keys{"study.dt", "study.rescalings_per_revolution"};

Node const* given_of(Node const& root, SpanKeys const& keys) {
    Node const* const node = root.find_path(keys.time);
    return node != nullptr ? node : root.find_path(keys.turns);
}

bool has_period(Scene const& scene) { return std::isfinite(drive_period(scene.parts, scene.inputs)); }

/// Where nothing turns there are no revolutions; each that would be the default is a second, as in an ensemble.
Span read_span(Node const& root, Scene const& scene, SpanKeys const& keys, double default_turns) {
    if (auto const seconds = given_number(root, keys.time)) return {*seconds, false};
    bool const turns = has_period(scene);
    Node const* const node = root.find_path(keys.turns);
    if (node == nullptr) return {default_turns, turns};
    double const value = read_number(*node, setting(keys.turns));
    if (!turns) refuse_at_rest(*node, scene.parts, keys.time);
    return {value, true};
}

Span read_dt(Node const& root, Scene const& scene) {
    if (auto const seconds = given_number(root, dt_keys.time)) return {*seconds, false};
    auto const per_turn = given_count(root, dt_keys.turns);
    if (per_turn && !has_period(scene)) refuse_at_rest(*root.find_path(dt_keys.turns), scene.parts, "study.dt");
    return {1 / static_cast<double>(per_turn.value_or(2000)), has_period(scene)};
}

void read_neighbours(Node const& root, Scene& scene) {
    ChaosSettings& chaos = scene.chaos;
    Node const* const count = root.find_path("study.exponents");
    int const least = scene.study == StudyKind::sweep ? 0 : 1;
    int const most = std::min(most_shadows, free_states(scene.parts));
    chaos.exponents = count != nullptr ? static_cast<int>(read_count(*count, setting("study.exponents").what, least, most)) : 1;
    Node const *const d0 = root.find_path("study.d0"), *const lower = root.find_path("study.d0_lower"),
                      *const upper = root.find_path("study.d0_upper");
    if (lower == nullptr) chaos.d0_lower = std::max(chaos.d0 * 0.3, 1e-14);
    if (upper == nullptr) chaos.d0_upper = std::min(chaos.d0 * 3, 1.0);
    auto const name_d0 = [&](std::string_view side) {
        return Problem{fmt::format("not {} study.d0, {}", side, chaos.d0), "use d0_lower < d0 < d0_upper"};
    };
    if (lower != nullptr && !(chaos.d0_lower < chaos.d0)) refuse(*lower, name_d0("below"));
    if (upper != nullptr && !(chaos.d0_upper > chaos.d0)) refuse(*upper, name_d0("above"));
    chaos.dt = read_dt(root, scene);

    auto const warn = [&](Node const* node, std::string_view why) {
        if (node != nullptr) scene.warnings.push_back(fmt::format("{} has no effect with {}", node->name, why));
    };
    if (chaos.d0 < 1e-9) {
        scene.warnings.push_back(fmt::format(
            "study.d0 is {} and below 1e-9 rounding shows: in impacts an offset's part in the positions is 1e-5 of it",
            chaos.d0));
    }
    if (chaos.exponents == 0) {
        for (Node const* const node : {d0, lower, upper, given_of(root, dt_keys)}) warn(node, "study.exponents = 0");
        ChaosSettings const none;
        chaos.d0 = none.d0, chaos.d0_lower = none.d0_lower, chaos.d0_upper = none.d0_upper, chaos.dt = none.dt;
        return;
    }
    if (chaos.exponents > 1) {
        for (Node const* const node : {lower, upper}) {
            warn(node, "several exponents: their neighbours are rescaled every time");
        }
        chaos.d0_lower = chaos.d0 * 0.3, chaos.d0_upper = chaos.d0 * 3;
    }
}

/// A block's members stop equally often: what they count by must not differ between them.
void check_common_count(Node const& root, Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    bool const by_phase = scene.study != StudyKind::lyapunov && chaos.section.on == SectionSurface::On::phase;
    bool const counts = by_phase || chaos.exponents > 0;
    Key const* const varied = drive_periods(scene).varied;
    if (!counts || varied == nullptr) return;
    bool const turns = by_phase || chaos.dt.revolutions;
    struct Length {
        Span const& span;
        SpanKeys const& keys;
    };
    for (auto const& [span, keys] : {Length{chaos.span, span_keys}, Length{chaos.transient, transient_keys}}) {
        if (span.value == 0 || span.revolutions == turns) continue;
        std::string const reason = fmt::format("{} differs between members, and so would their number of {}",
                                               varied->name, by_phase ? "sections" : "rescalings");
        if (span.revolutions) refuse(*root.find_path(dt_keys.time), {reason, fmt::format("use {}", dt_keys.turns)});
        refuse(*root.find_path(keys.time),
               {reason, fmt::format("use {}", by_phase || chaos.dt.revolutions ? keys.turns : keys.time)});
    }
}

void check_length(Node const& root, Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    bool const turns = chaos.span.revolutions || chaos.transient.revolutions;
    PeriodRange const periods = drive_periods(scene);
    Node const* const given = given_of(root, span_keys);
    if (turns && periods.varied != nullptr && !std::isfinite(periods.most)) {
        refuse_study(root, given, "study.revolutions",
                     {fmt::format("{} may be 0, where revolutions do not end", periods.varied->name),
                      "vary it within limits of one sign"});
    }
    double const longest = run_length(scene).longest;
    if (!(longest <= longest_time)) {
        refuse_study(root, given, "study.revolutions",
                     {fmt::format("with the transient a member lasts {:.3g} s", longest),
                      fmt::format("stay below {} s", longest_time)});
    }
}

void read_history(Node const& root, Scene& scene) {
    ChaosSettings& chaos = scene.chaos;
    double const rescalings = parts_of(chaos.span, chaos.dt, drive_period(scene.parts, scene.inputs));
    if (!(rescalings >= 1)) {
        refuse_study(root, given_of(root, span_keys), "study.revolutions",
                     {"it ends before the first rescaling", "record for longer, or rescale oftener"});
    }
    chaos.history = static_cast<std::size_t>(std::min(100.0, rescalings));
    chaos.history = given_count(root, "study.history").value_or(chaos.history);
    if (static_cast<double>(chaos.history) > rescalings) {
        refuse(*root.find_path("study.history"), {fmt::format("there are {:.0f} rescalings", rescalings), fmt::format("use a value <= {:.0f}", rescalings)});
    }
}

void check_memory(Node const& root, Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    double const period = drive_period(scene.parts, scene.inputs);
    double const numbers = info(scene.parts.mechanism).states;
    bool const by_phase = chaos.section.on == SectionSurface::On::phase;
    double sections = 0;
    if (scene.study != StudyKind::lyapunov) {
        sections = by_phase ? parts_of(chaos.span, {1, true}, period) + 1 : static_cast<double>(chaos.max_crossings);
    }
    // Rescalings are recorded in sums, some thousands at most, or as many as the history asks for.
    double const records =
        std::min(parts_of(chaos.span, chaos.dt, period), std::max(4096.0, 2 * static_cast<double>(chaos.history)));
    double const growths = chaos.exponents > 0 ? records * chaos.exponents : 0;
    Node const* const given = given_of(root, span_keys);
    if (std::max(sections * numbers, growths) > most_numbers) {
        refuse_study(
            root, given, "study.revolutions",
            {fmt::format("each member would hold {:.3g} numbers while it runs", std::max(sections * numbers, growths)),
             fmt::format("record for a shorter time, or less often, at most {:g} numbers", most_numbers)});
    }
    double const columns = static_cast<double>(std::max<std::size_t>(chaos.values.size(), 1));
    double const kept = sections * numbers + static_cast<double>(chaos.history) * chaos.exponents;
    double const values = static_cast<double>(scene.members) * columns * kept;
    if (values > most_values) {
        refuse_study(root, root.find_path("study.members"), "study.members",
                     {fmt::format("the results would hold {:.3g} numbers", values),
                      fmt::format("ask for fewer members or less of each, at most {:g} numbers", most_values)});
    }
}

}  // namespace

RunLength run_length(Scene const& scene) {
    ChaosSettings const& chaos = scene.chaos;
    auto const at = [&](double period) { return chaos.transient.seconds(period) + chaos.span.seconds(period); };
    double const own = drive_period(scene.parts, scene.inputs);
    double stops = 0;
    if (chaos.exponents > 0) {
        stops = at(own) / chaos.dt.seconds(own);
    } else if (chaos.section.on == SectionSurface::On::phase) {
        stops = at(own) / own;
    }
    return {at(own), std::max(at(own), at(drive_periods(scene).most)), std::ceil(stops)};
}

void read_chaos(Node const& root, Scene& scene) {
    ChaosSettings& chaos = scene.chaos;
    bool const lyapunov = scene.study == StudyKind::lyapunov, sweep = scene.study == StudyKind::sweep;
    if ((lyapunov || sweep) && !info(scene.parts.mechanism).has_exponents) {
        refuse(*root.find_path("study.kind"), {fmt::format("nothing drives a {0}, and no exponents are computed of it", info(scene.parts.mechanism).name),
                                               "use \"ensemble\" or \"poincare\""});
    }
    chaos.transient = read_span(root, scene, transient_keys, lyapunov ? 2 : 20);
    chaos.span = read_span(root, scene, span_keys, lyapunov ? 10 : sweep ? 50 : 150);
    if (!lyapunov) read_section(root, scene);
    if (lyapunov || sweep) read_neighbours(root, scene);
    if (sweep) check_columns(root, scene);
    if (sweep && chaos.exponents > 0 && chaos.transient.value == 0 &&
        chaos.span.seconds(drive_period(scene.parts, scene.inputs)) < 2 * drive_period(scene.parts, scene.inputs)) {
        refuse_study(root, given_of(root, span_keys), "study.revolutions",
                     {"exponents are taken between its sections, and there is one", "use at least 2, or a transient"});
    }
    check_common_count(root, scene);
    check_length(root, scene);
    if (lyapunov) read_history(root, scene);
    check_memory(root, scene);
}

}  // namespace slideway
