// How members are integrated: method, tolerances, and how many steps they take and may take.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "host/backend/linkage_numbers.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

/// Of a slider at rest velocities are small: atol alone holds its ringing. At the size of rtol an explicit pair at its limit of stability puts as
/// much energy into it as damping takes, and it never comes to rest (docs/evidence/integrators.md).
constexpr double atol_per_rtol = 0.1;

/// Whether nothing takes energy from the impacts of any member, so that what one errs by is never forgotten, and nothing drives it either: contact never
/// lasts.  Of the numbers of a law those damp that may be zero and are not.
bool bounces_for_ever(Scene const& scene) {
    Parts const& parts = scene.parts;
    if (info(parts.mechanism).drive != DriveKind::none || parts.rigid) return false;
    // What one brings oneself may damp without a key.
    if (module_of(parts.law) != nullptr || module_of(parts.mechanism) != nullptr) return false;
    if (parts.damping == Damping::restitution) {
        auto const varied = [](Variation const& variation) { return variation.key->name == "contact.restitution"; };
        return scene.inputs.restitution == 1 && std::ranges::none_of(scene.variations, varied);
    }
    Inputs const with_varied = given_or_varied(scene);
    LawInfo const& law = info(parts.law);
    auto const damps = [&](Key const& key) { return key.rule != Rule::positive && key.get(with_varied) != 0; };
    bool const of_points = has_group(law.groups, KeyGroup::point_damping) && with_varied.eta != 0;
    return parts.damping == Damping::point && !of_points && std::ranges::none_of(law.keys, damps);
}

/// Modes are what a law switches between.  A step across the jump of the force there has no order of convergence, and rtol says nothing of its error.
void read_located_modes(Reading& reading) {
    Scene& scene = reading.scene;
    bool const can = has_effect(setting("integrator.locate_modes"), scene.integrator.method, scene.parts);
    if (!reading.given("integrator.locate_modes")) scene.integrator.locate_modes = has_switches(scene.parts) && can;
}

void warn_of_idle_keys(Node const& table, Reading& reading) {
    Scene const& scene = reading.scene;
    for (Node const& node : table.children) {
        Setting const& row = setting(node.name, reading.keys);
        // Said to be off where it cannot be on, it is as it was asked for.
        if (has_effect(row, scene.integrator.method, scene.parts) || node.key == "locate_modes") continue;
        std::string const with = !has_effect(row, scene.integrator.method, Parts{}) ? fmt::format("with method {}", name_of(scene.integrator.method))
                                 : scene.parts.rigid                                ? std::string("on rigid contacts")
                                                                                    : fmt::format("on a {}", info(scene.parts.mechanism).name);
        reading.warn(fmt::format("{} has no effect {}", node.name, with));
    }
}

/// The longest step that does not leap over what a table has between two rows, but a 4000th of the whole table, nor over a slider's bounce on a stop;
/// infinite where nothing is known of how fast that passes.
double step_within_loads(Scene const& scene, double period) {
    double step = std::numeric_limits<double>::infinity();
    Inputs const in = complete_inputs(scene.inputs, info(scene.parts.mechanism));
    auto const limit = [&](LoadTable const& table, LoadArgument over) {
        if (table.function == nullptr) return;
        bool const on_rod = info(scene.parts.mechanism).drive == DriveKind::crank;
        double const along = on_rod ? 1.5 * in.crank_length * 2 * std::numbers::pi / period : in.carriage_speed;  // about as fast as the slider becomes [m/s]
        double const rate = over == LoadArgument::time ? 1 : over == LoadArgument::crank_angle ? 2 * std::numbers::pi / period
                            : over == LoadArgument::x && std::isfinite(period) ? along : 0;
        // A table of very many rows is smooth between most of them.
        if (rate > 0) step = std::min(step, std::max(0.5 * table.narrowest, table.span / 4000) / rate);
    };
    for (std::size_t i = 0; scene.loads != nullptr && i < scene.loads->rows().size(); ++i) {
        Load const& load = scene.loads->load(i);
        limit(scene.loads->rows()[i].table, load.over);
        if (load.kind != LoadKind::stop) continue;
        LinkagePlan const* const linkage = scene.parts.linkage;
        double const rate = linkage != nullptr ? rate_on_stop(*linkage, load, in) : std::sqrt(in.*load_inputs[load.stiffness] / in.slider_mass);
        // A tenth of the time that the slider alone is on it: a step across its touch has no order.
        step = std::min(step, 0.3 / rate);
    }
    if (scene.drive != nullptr) limit(scene.drive->table, scene.parts.drive.by == DriveBy::profile ? LoadArgument::time : scene.parts.drive.over);
    return step;
}

/// Settled contact asks an explicit method for some 0.5 million steps a second; a member that wants twenty times that is
/// hopeless and should not hold a lane for minutes.
std::uint64_t default_max_steps(RunLength const& length, double max_step) {
    constexpr double start = 1e7, per_second = 1e7, largest = most_steps;
    double const steps = start + per_second * length.longest + 2 * (length.longest / max_step + length.stops);
    return static_cast<std::uint64_t>(std::min(steps, largest));
}

void warn_of_many(Reading& reading, std::string_view key, double step, double steps) {
    constexpr double many = 1e10;  // hours of a lane
    if (steps > many) reading.warn(fmt::format("{} is {} s: a member takes {:.3g} steps or more", key, step, steps));
}

/// Fixed steps are known beforehand, but for what the rounding of the time adds to very many.
void read_fixed_steps(Reading& reading, RunLength const& length) {
    IntegratorSettings& settings = reading.scene.integrator;
    IntegratorSettings longest = settings;
    longest.end_time = length.longest;
    double const steps = fixed_steps(longest) + length.stops, enough = 1000 + std::ceil(1.001 * steps);
    if (!(enough <= static_cast<double>(most_steps)))
        refuse(*reading.given("integrator.step"), {fmt::format("that makes {:.3g} steps", steps), "use a larger one, or method \"auto\""});
    warn_of_many(reading, "integrator.step", settings.fixed_step, steps);
    Node const* const node = reading.given("integrator.max_steps");
    if (node == nullptr) {
        settings.max_steps = static_cast<std::uint64_t>(enough);
    } else if (static_cast<double>(settings.max_steps) < steps) {
        refuse(*node, {fmt::format("the fixed steps are {:.0f}", steps), fmt::format("use a value >= {:.0f}, or a larger integrator.step", steps)});
    }
}

/// Refuses a largest step, given or not, of which a member would take too many.
void check_largest_step(Reading const& reading, std::string_view name, double largest, RunLength const& length) {
    double const steps = length.longest / largest;
    if (steps <= static_cast<double>(most_steps)) return;
    std::string const reason = fmt::format("a member would take {:.3g} steps or more", steps);
    if (Node const* const node = reading.given(name)) refuse(*node, {reason, fmt::format("use a value >= {:.3g} s", length.longest / most_steps)});
    Node const* const longest = reading.given_of({"study.duration", "study.revolutions"});
    throw SceneError(fmt::format("{}: {} follows from the drive and is {:.3g} s ({}); shorten study.duration, slow the drive down, or give {}",
                                 longest != nullptr ? longest->where : reading.root.where, name, largest, reason, name));
}

}  // namespace

void read_integrator(Reading& reading) {
    Scene& scene = reading.scene;
    IntegratorSettings& settings = scene.integrator;
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    reading.read_table("integrator");
    // The errors of dopri5's bounces have one sign: they would add up (docs/evidence/integrators.md).
    if (settings.method == Method::automatic && bounces_for_ever(scene)) {
        settings.method = Method::verner65;
        reading.warn("nothing takes energy from what bounces here, and errors of impacts are never forgotten: integrator.method \"auto\" is \"verner65\"");
    }
    apply_rules(reading, Known::method);
    read_located_modes(reading);
    apply_rules(reading, Known::integrator);
    if (!reading.given("integrator.atol")) settings.atol = atol_per_rtol * settings.rtol;
    double const period = fastest_period(scene);
    // A step may not leap over an impact: between two of them the slider flies for milliseconds.
    constexpr double longest_step = 1e-3;
    double max_step = std::min(longest_step, period / 2000);
    // That finds its touches inside a step, by the depths and rates at its ends.
    if (settings.method == Method::verner65 && mechanism.spatial && scene.chaos.exponents == 0) max_step = std::min(longest_step, period / 200);
    // Rigid contacts are found inside a step by its ends' depths and rates, and nothing happens fast between them.
    if (scene.parts.rigid && !scene.parts.drive.turns_freely()) max_step = std::min(50 * longest_step, period / 50);
    // Joints without clearance know no impacts.
    if (scene.parts.linkage != nullptr && !scene.parts.linkage->has_clearance()) max_step = std::min(50 * longest_step, period / 50);
    // Nor over a carriage's reversal, which accelerates it for a small part of its period.
    bool const reverses = mechanism.drive == DriveKind::carriage;
    double const of_loads = step_within_loads(scene, period);
    max_step = std::min(max_step, of_loads);
    double const reversal = reverses ? shortest_reversal(scene) / 20 : max_step;
    if (!reading.given("integrator.max_step")) settings.max_step = std::min(max_step, reversal);
    // The stiff method runs in lasting contact alone, where nothing is to be leapt over; what is rigid slides at the drive's pace then.
    double const longest_stiff = scene.parts.rigid && std::isfinite(period) && !reading.given("integrator.max_step") ? period / 50 : 10 * settings.max_step;
    double const stiff_step = std::min({longest_stiff, reverses ? reversal : longest_stiff, of_loads});
    if (!reading.given("integrator.stiff_max_step")) settings.stiff_max_step = stiff_step;
    if (Node const* const table = reading.given("integrator")) warn_of_idle_keys(*table, reading);
}

void read_steps(Reading& reading, RunLength const& length) {
    IntegratorSettings& settings = reading.scene.integrator;
    if (Node const* const dt = reading.given("study.dt"); dt != nullptr && length.stops > static_cast<double>(most_steps)) {
        refuse(*dt, {fmt::format("that makes {:.3g} rescalings", length.stops), "use a larger one"});
    }
    if (has_fixed_step(settings.method)) return read_fixed_steps(reading, length);
    double least = length.longest / settings.max_step;
    for (auto const& [name, largest] : {std::pair{"integrator.max_step", settings.max_step}, std::pair{"integrator.stiff_max_step", settings.stiff_max_step}}) {
        if (!has_effect(setting(name), settings.method, reading.scene.parts)) continue;
        check_largest_step(reading, name, largest, length);
        least = std::min(least, length.longest / largest);
    }
    warn_of_many(reading, "integrator.max_step", settings.max_step, least);
    Node const* const node = reading.given("integrator.max_steps");
    if (node == nullptr) {
        settings.max_steps = default_max_steps(length, settings.max_step);
    } else if (static_cast<double>(settings.max_steps) < std::floor(least)) {
        refuse(*node, {fmt::format("a member takes {:.0f} steps or more", std::floor(least)), "use a larger one, or larger steps"});
    }
}

}  // namespace slideway
