#include "bench/stability/axes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/study/prediction.hpp"
#include "kernels/members/stiffest_rate.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::bench {
namespace {

/// The standard mechanism; a law that keeps energy with damping in lines and surfaces, without which nothing comes to rest.
struct Setting {
    Law law;
    std::size_t members;
    double clearance = 1e-4, crank_speed = std::numbers::pi;
    Damping damping = Damping::rate;
    bool lying = false;  // starts on the way instead of above it

    template <class Change> Point point(double value, Change change) const {
        Point p{value, {law, damping, true, false}, testing::scattered_starts(members, clearance, crank_speed)};
        for (auto& in : p.members) {
            in.chi_line = in.chi_surface = info(law).switches ? 0 : 10;
            if (lying) {
                in.y = -clearance;
                in.roll = in.pitch = 0;
            }
            change(in);
        }
        return p;
    }
    Point point(double value) const {
        return point(value, [](Inputs&) {});
    }
};

std::vector<double> thinned(std::vector<double> values, bool quick) {
    if (!quick) return values;
    std::vector<double> kept;
    for (std::size_t i = 0; i < values.size(); i += 2) kept.push_back(values[i]);
    return kept;
}

Axis of_inputs(char const* name, char const* title, char const* unit, std::vector<double> const& values,
               Setting const& setting, void (*change)(Inputs&, double)) {
    Axis axis{name, title, unit, false, {}};
    for (double const value : values) {
        axis.points.push_back(setting.point(value, [&](Inputs& in) { change(in, value); }));
    }
    return axis;
}

Axis of_tolerances(char const* name, char const* title, std::vector<double> const& values, Setting const& setting) {
    Axis axis{name, title, "", true, {}};
    for (double const value : values) {
        axis.points.push_back(setting.point(value));
        axis.points.back().tolerance = value;
    }
    return axis;
}

Axis of_steps(char const* name, char const* title, std::vector<double> const& values, Setting const& setting) {
    Axis axis{name, title, "", true, {}};
    for (double const value : values) {
        axis.points.push_back(setting.point(value));
        axis.points.back().step_fraction = value;
    }
    return axis;
}

}  // namespace

std::vector<Law> swept_laws() {
    std::vector<Law> found;
    for (bool const switches : {false, true}) {
        for (std::size_t i = 0; i < laws().size(); ++i) {
            LawInfo const& law = laws()[i];
            bool const has_all = law.has(Damping::rate) && law.has(Damping::restitution);
            if (has_all && law.switches == switches) found.push_back(static_cast<Law>(i));
        }
    }
    return found;
}

std::vector<Axis> axes(Law law, bool quick) {
    Setting const standard{law, quick ? 8u : 16u};
    auto lying = standard;
    lying.lying = true;
    auto restituting = standard;
    restituting.damping = Damping::restitution;
    auto const list = [&](std::vector<double> values) { return thinned(std::move(values), quick); };
    std::vector<Axis> all;

    all.push_back(of_inputs("young_modulus", "Young's modulus", "Pa",
                            list({1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13}), standard,
                            [](Inputs& in, double value) { in.slider_young_modulus = in.way_young_modulus = value; }));
    Axis clearances{"clearance", "Clearance", "m", false, {}};
    for (double const value : list({1e-6, 1e-5, 1e-4, 5e-4, 5e-3})) {
        auto setting = standard;
        setting.clearance = value;
        clearances.points.push_back(setting.point(value));
    }
    all.push_back(std::move(clearances));
    Axis speeds{"crank_speed", "Crank speed", "rad/s", false, {}};
    for (double const value : list({0.1, 1, std::numbers::pi, 10, 47, 150, 500})) {
        auto setting = standard;
        setting.crank_speed = value;
        speeds.points.push_back(setting.point(value));
    }
    all.push_back(std::move(speeds));
    all.push_back(of_inputs("eta", "η (χ = 0)", "", list({0, 1e-3, 1e-2, 0.1, 1}),
                            standard, [](Inputs& in, double value) {
                                in.eta = value;
                                in.chi_line = in.chi_surface = 0;
                            }));
    all.push_back(of_inputs("chi", "χ (η = 0.01)", "s/m",
                            list({0, 1, 10, 100, 1000}), standard,
                            [](Inputs& in, double value) { in.chi_line = in.chi_surface = value; }));
    all.push_back(of_inputs("restitution", "Restitution", "",
                            list({0.05, 0.2, 0.4, 0.7, 1}), restituting,
                            [](Inputs& in, double value) { in.restitution = value; }));
    std::vector<double> const tolerances = list({1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11});
    std::vector<double> const steps = list({0.1, 0.2, 0.5, 0.7, 1, 1.4, 2, 4, 8});
    all.push_back(of_tolerances("tolerance", "Tolerance, falling", tolerances, standard));
    all.push_back(of_tolerances("tolerance_lying", "Tolerance, lying", tolerances, lying));
    all.push_back(of_steps("step", "Step over 2√2/Ω, falling", steps, standard));
    all.push_back(of_steps("step_lying", "Step over 2√2/Ω, lying", steps, lying));
    return all;
}

double linear_limit(std::vector<Inputs> const& members) {
    double rate = 0;
    for (auto const& in : members) rate = std::max(rate, stiffest_rate(info(Mechanism{}), info(Law{}), in));
    return 2 * std::numbers::sqrt2 / rate;
}

}  // namespace slideway::bench
