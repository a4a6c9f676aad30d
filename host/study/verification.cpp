// How the members of a study are run again to check it.
#include "host/study/verification.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

/// Tolerances below are beyond what doubles resolve.
constexpr double least_tolerance = 1e-13;
/// How much smaller a fixed step is, and of neighbours how much farther they start.
constexpr double fewer_steps = 0.25, farther = 10;
/// Fixed steps err by first order where contacts begin and end: a quarter of them still errs by a quarter, e(h) = (e(h) − e(h/4))/(1 − ¼)
/// (Richardson 1911).
constexpr double error_per_difference_of_steps = 1 / (1 - fewer_steps);

void tighten(IntegratorSettings& settings) {
    // A hundredth of a coarse tolerance may err as much itself.
    double const factor = std::min(check_tightening, coarsest_check / settings.rtol);
    settings.rtol = std::max(least_tolerance, factor * settings.rtol);
    settings.atol = std::max(least_tolerance, factor * settings.atol);
    settings.stiff_tolerance = std::max(settings.rtol, check_tightening * settings.stiff_tolerance);
}

/// By which method the tolerance is tightened: the study's own; where vibrating contacts deceive an explicit one, by that which damps them.
Method tightened_method(Scene const& scene) {
    Method const own = scene.integrator.method;
    return is_explicit_pair(own) && has_faces(scene.parts) ? Method::automatic : own;
}

/// An explicit one that is not the study's, nor an arm of its `auto`.
Method other_method(Scene const& scene) {
    if (scene.integrator.method != Method::verner65) return Method::verner65;
    return scene.parts.rigid ? Method::dopri5 : Method::dop853;
}

/// Right-hand sides of a member beside those at the study's own settings, as found for settled and rattling sliders (docs/evidence/integrators.md).
double cost_of(Parts const& parts, Method study, Method check) {
    // Without faces `auto` is dopri5, but for slow sliding.
    bool const is_dopri5 = study == Method::automatic && !has_faces(parts);
    bool const high_order = is_dopri5 || study == Method::dopri5 || study == Method::dop853 || study == Method::verner65;
    if (study == check) return high_order ? 2.5 : 4;
    if (check == Method::automatic) return 1;  // a fifth in lasting contact, four times in impacts
    return high_order || !has_faces(parts) ? 3 : 10;
}

}  // namespace

Scene without_series(Scene scene) {
    scene.sample_times.clear();
    scene.series = 0;
    scene.chaos.history = 0;
    return scene;
}

std::string words_of(IntegratorSettings const& settings) {
    if (has_fixed_step(settings.method))
        return fmt::format("{} with steps of {:.3g} s", name_of(settings.method), settings.fixed_step);
    return fmt::format("{} at rtol {:.0e}", name_of(settings.method), settings.rtol);
}

std::vector<CheckMethod> check_methods(Scene const& scene) {
    Method const own = scene.integrator.method;
    Scene const bare = without_series(scene);
    std::vector<CheckMethod> methods;
    auto const add = [&](Scene check, double cost, std::string_view beside = "") {
        methods.push_back({words_of(check.integrator) + std::string(beside), std::move(check), cost});
    };
    // Where forces jump, no tolerance brings a step across that does not end there: far below the study's, steps become too small.
    Scene located = bare;
    located.integrator.locate_modes = has_switches(scene.parts);

    Scene tight = has_fixed_step(own) ? bare : located;
    tight.integrator.method = tightened_method(scene);
    if (has_fixed_step(own)) {
        tight.integrator.fixed_step *= fewer_steps;
        tight.integrator.max_steps =
            static_cast<std::uint64_t>(static_cast<double>(scene.integrator.max_steps) / fewer_steps);
    } else {
        tighten(tight.integrator);
    }
    add(tight, cost_of(scene.parts, own, tight.integrator.method));
    if (has_fixed_step(own)) methods.back().error_per_difference = error_per_difference_of_steps;

    Scene other = located;
    other.integrator.method = other_method(scene);
    if (has_fixed_step(own)) {
        IntegratorSettings const usual;
        other.integrator.rtol = usual.rtol;
        other.integrator.atol = usual.atol;
        other.integrator.max_steps = std::max(other.integrator.max_steps, usual.max_steps);
    }
    tighten(other.integrator);
    add(other, cost_of(scene.parts, own, other.integrator.method));

    if (scene.chaos.exponents > 0 && !runs_to_end(scene.study)) {
        Scene wide = bare;
        wide.chaos.d0 = std::min(1e-2, farther * scene.chaos.d0);
        // The study's own orbits once more: they also tell what energy the integration makes of them.
        if (!makes_energy(scene.parts)) wide.quantities |= selection_of(Quantity::energy_residual);
        double const factor = wide.chaos.d0 / scene.chaos.d0;
        wide.chaos.d0_lower *= factor;
        wide.chaos.d0_upper *= factor;
        add(wide, 1, fmt::format(", d0 = {:.0e}", wide.chaos.d0));
        methods.back().of_exponents = true;
        methods.back().audits_energy = !makes_energy(scene.parts);
    }
    return methods;
}

}  // namespace slideway
