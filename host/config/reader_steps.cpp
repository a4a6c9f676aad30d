// How many steps a member takes, and may take.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/config/reader.hpp"
#include "host/config/settings.hpp"

namespace slideway {
namespace {

/// Settled contact asks an explicit method for some 0.5 million steps a second; a member that wants twenty times that is
/// hopeless and should not hold a lane for minutes.
std::uint64_t default_max_steps(RunLength const& length, double max_step) {
    constexpr double start = 1e7, per_second = 1e7, largest = most_steps;
    double const steps = start + per_second * length.longest + 2 * (length.longest / max_step + length.stops);
    return static_cast<std::uint64_t>(std::min(steps, largest));
}

void warn_of_many(Scene& scene, std::string_view key, double step, double steps) {
    constexpr double many = 1e10;  // hours of a lane
    if (steps > many) scene.warnings.push_back(fmt::format("{} is {} s: a member takes {:.3g} steps or more", key, step, steps));
}

/// Fixed steps are known beforehand, but for what the rounding of the time adds to very many.
void read_fixed_steps(Node const& root, Scene& scene, RunLength const& length) {
    IntegratorSettings& settings = scene.integrator;
    IntegratorSettings longest = settings;
    longest.end_time = length.longest;
    double const steps = fixed_steps(longest) + length.stops, enough = 1000 + std::ceil(1.001 * steps);
    if (!(enough <= static_cast<double>(most_steps))) {
        refuse(*root.find_path("integrator.step"),
               {fmt::format("that makes {:.3g} steps", steps), "use a larger one, or method \"auto\""});
    }
    warn_of_many(scene, "integrator.step", settings.fixed_step, steps);
    Node const* const node = root.find_path("integrator.max_steps");
    if (node == nullptr) {
        settings.max_steps = static_cast<std::uint64_t>(enough);
    } else if (static_cast<double>(settings.max_steps) < steps) {
        refuse(*node, {fmt::format("the fixed steps are {:.0f}", steps),
                       fmt::format("use a value >= {:.0f}, or a larger integrator.step", steps)});
    }
}

/// Refuses a largest step, given or not, of which a member would take too many.
void check_largest_step(Node const& root, Setting const& of, double largest, RunLength const& length) {
    double const steps = length.longest / largest;
    if (steps <= static_cast<double>(most_steps)) return;
    std::string const reason = fmt::format("a member would take {:.3g} steps or more", steps);
    if (Node const* const node = root.find_path(of.name)) refuse(*node, {reason, fmt::format("use a value >= {:.3g} s", length.longest / most_steps)});
    Node const* longest = root.find_path("study.duration");
    if (longest == nullptr) longest = root.find_path("study.revolutions");
    throw SceneError(fmt::format("{}: {} follows from the drive and is {:.3g} s ({}); shorten study.duration, slow the drive down, or give {}",
                                 longest != nullptr ? longest->where : root.where, of.name, largest, reason, of.name));
}

}  // namespace

void read_steps(Node const& root, Scene& scene, RunLength const& length) {
    IntegratorSettings& settings = scene.integrator;
    if (Node const* const dt = root.find_path("study.dt"); dt != nullptr && length.stops > static_cast<double>(most_steps)) {
        refuse(*dt, {fmt::format("that makes {:.3g} rescalings", length.stops), "use a larger one"});
    }
    if (has_fixed_step(settings.method)) return read_fixed_steps(root, scene, length);
    double least = length.longest / settings.max_step;
    for (std::string_view const name : {"integrator.max_step", "integrator.stiff_max_step"}) {
        Setting const& of = setting(name);
        if (!has_effect(of, settings.method, scene.parts)) continue;
        double const largest = name == "integrator.max_step" ? settings.max_step : settings.stiff_max_step;
        check_largest_step(root, of, largest, length);
        least = std::min(least, length.longest / largest);
    }
    warn_of_many(scene, "integrator.max_step", settings.max_step, least);
    Node const* const node = root.find_path("integrator.max_steps");
    if (node == nullptr) {
        settings.max_steps = default_max_steps(length, settings.max_step);
    } else if (static_cast<double>(settings.max_steps) < std::floor(least)) {
        refuse(*node, {fmt::format("a member takes {:.0f} steps or more", std::floor(least)), "use a larger one, or larger steps"});
    }
}

}  // namespace slideway
