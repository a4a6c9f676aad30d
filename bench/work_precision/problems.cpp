#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/relief_valve_golden.hpp"
#include "bench/spread.hpp"
#include "bench/work_precision/problem.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::bench {
namespace {

constexpr double pi = 3.141592653589793;

/// Values in (−1, 1) that fill it evenly: multiples of an irrational number.
double scattered(std::size_t i, double irrational) {
    double const x = static_cast<double>(i + 1) * irrational;
    return 2 * (x - std::floor(x)) - 1;
}

/// Scattered starts with ±20 % in what the tolerances of manufacture and operation leave open.
std::vector<Inputs> spread_members(std::size_t count, double clearance, double crank_speed, double chi) {
    auto members = testing::scattered_starts(count, clearance, crank_speed);
    for (std::size_t i = 0; i < count; ++i) {
        spread_inputs(members[i], chi, [&](double irrational) { return 1 + 0.2 * scattered(i, irrational); });
    }
    return members;
}

/// The candidates that have touched the way and touch nothing from `margin` before the end to `margin` after it: inside an
/// impact a state changes within microseconds, and comparing there would measure its timing alone.
std::vector<Inputs> in_free_flight(std::vector<Inputs> const& candidates, Parts parts, double end, double margin) {
    testing::RunOptions options;
    options.parts = parts;
    options.settings.rtol = options.settings.atol = 1e-9;
    options.settings.end_time = end + margin;
    options.quantities = Selection(1) << static_cast<int>(Quantity::contact_onsets);
    for (Series const s : {Series::surfaces, Series::lines, Series::points}) {
        options.series |= Selection(1) << static_cast<int>(s);
    }
    constexpr std::size_t samples = 41;
    for (std::size_t i = 0; i < samples; ++i) {
        options.sample_times.push_back(end + margin * (2.0 * static_cast<double>(i) / (samples - 1) - 1));
    }
    auto const r = testing::run(best_isa(), options, candidates);
    std::vector<Inputs> chosen;
    for (std::size_t member = 0; member < candidates.size(); ++member) {
        double contacts = 0;
        for (std::size_t kind = 0; kind < 3; ++kind) {
            for (std::size_t i = 0; i < samples; ++i) {
                contacts += r.series[(kind * candidates.size() + member) * samples + i];
            }
        }
        if (contacts == 0 && r.value(member, Quantity::contact_onsets) > 0) chosen.push_back(candidates[member]);
    }
    return chosen;
}

std::vector<double> decades(int first, int last) {
    std::vector<double> tolerances;
    for (int i = first; i <= last; ++i) tolerances.push_back(std::pow(10.0, -i));
    return tolerances;
}

/// Members in all, which fill the lanes of a pack several times over, and the leading ones that every method runs.
struct Crowd {
    std::size_t all, shared;
};

struct Scene {
    Parts parts;
    double clearance, crank_speed, chi;
};

constexpr Scene settling = {{Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10};
constexpr Scene rattling = {{Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10};
constexpr Scene switching = {{Law::paper, Damping::point, true, false}, 1e-4, pi, 0};

/// States at a time at which chaos has not yet set in for most members.
Problem short_horizon(std::string name, std::string title, Scene const& scene, double end, Crowd crowd,
                      std::vector<double> tolerances) {
    // One candidate in two to four flies at the end, and of those one in three may be chaotic already.
    auto candidates = in_free_flight(spread_members(8 * crowd.all, scene.clearance, scene.crank_speed, scene.chi),
                                     scene.parts, end, 2e-4);
    return {.name = std::move(name),
            .title = std::move(title),
            .ensemble = SliderCrankEnsemble{scene.parts, std::move(candidates)},
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = 1e-3,
            .measure = Measure::state,
            .tolerances = std::move(tolerances)};
}

/// The energy that the method made or lost on the way.
Problem long_horizon(std::string name, std::string title, Scene const& scene, double end, Crowd crowd, double max_step,
                     std::vector<double> tolerances) {
    return {.name = std::move(name),
            .title = std::move(title),
            .ensemble = SliderCrankEnsemble{scene.parts,
                                            spread_members(crowd.all, scene.clearance, scene.crank_speed, scene.chi)},
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = max_step,
            .measure = Measure::energy,
            .tolerances = std::move(tolerances)};
}

Problem lorenz(double end, Crowd crowd, std::vector<double> tolerances) {
    LorenzEnsemble ensemble;
    for (std::size_t i = 0; i < crowd.all; ++i) {
        auto const spread = [&](double irrational) { return 1 + 0.2 * scattered(i, irrational); };
        ensemble.members.push_back(
            {10, 28 * spread(0.6180339887498949), 8.0 / 3, {1, 1, 25 * spread(0.4142135623730951)}});
    }
    return {.name = "lorenz",
            .title = "Lorenz system: states after 5 units of time",
            .ensemble = std::move(ensemble),
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = 1,
            .measure = Measure::state,
            .tolerances = std::move(tolerances)};
}

/// Extrema and impacts after the transient, against an 80-bit run at 1e-13.
Problem relief_valve(std::vector<double> tolerances) {
    auto const golden = testing::read_valve_golden(SLIDEWAY_TEST_DATA "/golden/relief_valve.csv");
    ValveEnsemble ensemble;
    std::vector<std::vector<double>> periods;
    for (auto const& orbit : golden) {
        // One event that repeats is an equilibrium, which coarse tolerances circle for ever.
        if (orbit.period == 1) continue;
        ensemble.members.push_back({orbit.inflow});
        periods.emplace_back();
        for (auto const& event : orbit.events) periods.back().push_back(event.x);
    }
    if (golden.empty()) throw std::runtime_error("tests/golden/relief_valve.csv cannot be read");
    return {.name = "relief_valve",
            .title = "Relief valve: extrema of periodic orbits",
            .ensemble = std::move(ensemble),
            .shared = periods.size(),
            .members_wanted = periods.size(),
            .end_time = 1e4,  // of which an orbit needs a tenth
            .max_step = 0.5,
            .measure = Measure::extrema,
            .tolerances = std::move(tolerances),
            .reference = std::move(periods)};
}

}  // namespace

std::vector<Problem> all_problems(bool quick) {
    Crowd const many = quick ? Crowd{32, 8} : Crowd{128, 32};
    // Finest tolerance: of states, of energies where the run is short, and where it is long.
    int const fine = quick ? 7 : 11, medium = quick ? 6 : 9, coarse = quick ? 4 : 6;
    return {
        short_horizon("settling_states", "Settling: states after 8 ms", settling, 0.008, many, decades(3, fine)),
        short_horizon("rattling_states", "Rattling: states after 18 ms", rattling, 0.018, many, decades(3, fine)),
        short_horizon("switching_states", "Switching, law of the paper: states after 9 ms", switching, 0.009, many,
                      decades(3, fine)),
        long_horizon("settling_energy", "Settling: energy residual after 0.4 s", settling, 0.4, many, 1e-3,
                     decades(3, coarse)),
        long_horizon("rattling_energy", "Rattling: energy residual after 50 ms", rattling, 0.05, many, 1e-3,
                     decades(3, medium)),
        long_horizon("turn_energy", "A crank turn: energy residual after 2 s", settling, 2, many, 1e-2,
                     decades(3, coarse)),
        lorenz(5, many, decades(3, fine + 3)),
        relief_valve(decades(5, quick ? 7 : 11)),
    };
}

}  // namespace slideway::bench
