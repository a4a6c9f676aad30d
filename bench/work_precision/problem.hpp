// What the methods are measured on: ensembles with an end time and a measure of error.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "kernels/inputs.hpp"

namespace slideway::bench {

/// Of one of the mechanisms with a slider in a clearance joint.
struct SliderEnsemble {
    Parts parts;
    std::vector<Inputs> members;
};

/// x' = σ(y − x), y' = x(ρ − z) − y, z' = xy − βz.  Source: Lorenz 1963 (25)–(27).
struct LorenzMember {
    double sigma, rho, beta;
    std::array<double, 3> start;
};
struct LorenzEnsemble {
    std::vector<LorenzMember> members;
};

/// The relief valve of tests/models/relief_valve.hpp from its one start.
struct ValveMember {
    double inflow;
};
struct ValveEnsemble {
    std::vector<ValveMember> members;
};

/// The mass between two springs of tests/models/bouncing_mass.hpp.
struct BouncingMember {
    double y, v, stiffness, rate;
};
struct BouncingEnsemble {
    std::vector<BouncingMember> members;
};

using Ensemble = std::variant<SliderEnsemble, LorenzEnsemble, ValveEnsemble, BouncingEnsemble>;

enum class Measure {
    /// Root mean square over the components of |y − reference| / (scale + |reference|) at the end time: the norm of the
    /// error control, so that a method without error propagation would end at its tolerance.
    state,
    /// |ε| [J] of the energy audit at the end time (model.md 8), exact value 0.  For horizons on which states are chaotic.
    energy,
    /// Largest difference in x between 64 successive extrema and impacts and those of the reference, which repeats.
    extrema,
};

struct Problem {
    std::string name;   // of its files
    std::string title;  // of its plot
    Ensemble ensemble;
    std::size_t shared = 0;          // leading members whose error counts: every method runs these
    std::size_t members_wanted = 0;  // the ensemble may hold more until the references have chosen
    double end_time = 0;             // [s]
    double max_step = 0;             // [s]
    Measure measure = Measure::state;
    std::vector<double> tolerances;  // rtol = atol, the latter against the scales of the error control

    // Of the shared members.  Measure::state: the states at the end time, and how far the two references differ in that measure
    // at most.  Measure::extrema: one period of x; empty where the orbit has none, and the member's error does not count.
    std::vector<std::vector<double>> reference = {};
    double reference_difference = 0;

    std::size_t size() const {
        return std::visit([](auto const& e) { return e.members.size(); }, ensemble);
    }
};

/// All problems.  @param quick fewer members and tolerances.
std::vector<Problem> all_problems(bool quick);

}  // namespace slideway::bench
