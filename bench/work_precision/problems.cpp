#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/relief_valve_golden.hpp"
#include "bench/spread.hpp"
#include "bench/work_precision/bouncing_solution.hpp"
#include "bench/work_precision/problem.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::bench {
namespace {

constexpr double pi = 3.141592653589793;

/// Values in (−1, 1) that fill it evenly: multiples of an irrational number.
double scattered(std::size_t i, double irrational) {
    double const x = static_cast<double>(i + 1) * irrational;
    return 2 * (x - std::floor(x)) - 1;
}

struct Scene {
    Parts parts;
    double clearance, crank_speed, chi;
};

/// Scattered starts with ±20 % in what the tolerances of manufacture and operation leave open; of a misaligned way the pose
/// scatters too, by as much as scenes/tolerance_0.1mm.toml has it.
std::vector<Inputs> spread_members(std::size_t count, Scene const& scene) {
    auto members = testing::scattered_starts(count, scene.clearance, scene.crank_speed);
    for (std::size_t i = 0; i < count; ++i) {
        Inputs& in = members[i];
        spread_inputs(in, scene.chi, [&](double irrational) { return 1 + 0.2 * scattered(i, irrational); });
        if (!scene.parts.misaligned_way) continue;
        in.way_roll = 5e-4 * scattered(i, 0.2360679774997898);
        in.way_yaw = 1.5e-4 * scattered(i, 0.6457513110645907);
        in.way_pitch = 1.5e-4 * scattered(i, 0.3166247903553998);
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

constexpr Scene settling = {{Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10};
constexpr Scene rattling = {{Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10};
constexpr Scene switching = {{Law::paper, Damping::point, true, false}, 1e-4, pi, 0};
constexpr Scene misaligned = {{Law::conservative, Damping::rate, true, true}, 1e-4, pi, 10};
constexpr Scene undamped = {{Law::foundation, Damping::rate, true, false}, 1e-4, pi, 0};
constexpr Scene creeping = {{Law::conservative, Damping::rate, true, false}, 1e-4, 0.01, 10};
constexpr Scene at_rest = {{Law::conservative, Damping::rate, true, false}, 1e-4, 0, 10};

/// States at a time at which chaos has not yet set in for most members.
Problem short_horizon(std::string name, std::string title, Scene const& scene, double end, Crowd crowd,
                      std::vector<double> tolerances) {
    // One candidate in two to four flies at the end, and of those one in three may be chaotic already.
    auto candidates = in_free_flight(spread_members(8 * crowd.all, scene),
                                     scene.parts, end, 2e-4);
    return {.name = std::move(name),
            .title = std::move(title),
            .ensemble = SliderEnsemble{scene.parts, std::move(candidates)},
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
            .ensemble = SliderEnsemble{scene.parts,
                                            spread_members(crowd.all, scene)},
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = max_step,
            .measure = Measure::energy,
            .tolerances = std::move(tolerances)};
}

constexpr Parts free_on_springs = {.law = Law::kelvin_voigt, .mechanism = Mechanism::free_slider};

/// A free slider that tumbles and falls between faces too far off to touch; the spin is mostly about its longest axis, so that the yaw
/// stays away from ±π/2.
Problem flight(double end, Crowd crowd, std::vector<double> tolerances) {
    SliderEnsemble ensemble{free_on_springs, {}};
    for (std::size_t i = 0; i < crowd.all; ++i) {
        auto const number = [&](double irrational) { return scattered(i, irrational); };
        Inputs in = with_presets({}, free_on_springs.law);
        in.clearance_y = in.clearance_z = 0.2;
        in.vy = 0.5 * number(0.6180339887498949);
        in.vz = 0.5 * number(0.4142135623730951);
        in.vx = number(0.7320508075688772);
        in.roll = 3 * number(0.2360679774997898);
        in.yaw = 0.2 * number(0.6457513110645907);
        in.pitch = 0.5 * number(0.3166247903553998);
        in.wx = 200 * (1 + 0.2 * number(0.6055512754639891));
        in.wy = 40 * (1 + 0.2 * number(0.1231056256176606));
        in.wz = 40 * number(0.3588989435406740);
        ensemble.members.push_back(complete_inputs(in));
    }
    return {.name = "flight",
            .title = "Free slider, tumbling in flight: states after 0.1 s",
            .ensemble = std::move(ensemble),
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = end,
            .measure = Measure::state,
            .tolerances = std::move(tolerances)};
}

/// A free slider that falls and rattles on undamped linear springs, tilted: its apices touch one after the other.
Problem springs(double end, Crowd crowd, std::vector<double> tolerances) {
    auto candidates = testing::scattered_starts(8 * crowd.all, 1e-4, 0, free_on_springs.law);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        auto& in = candidates[i];
        in.clearance_y *= 1 + 0.2 * scattered(i, 0.3166247903553998);
        in.clearance_z *= 1 + 0.2 * scattered(i, 0.6055512754639891);
        in.vy = 0.05 * scattered(i, 0.1231056256176606);
        in.vz = 0.05 * scattered(i, 0.3588989435406740);
    }
    return {.name = "springs",
            .title = "Free slider, rattling on linear springs: states after 5 ms",
            .ensemble = SliderEnsemble{free_on_springs, in_free_flight(candidates, free_on_springs, end, 2e-4)},
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = 1e-3,
            .measure = Measure::state,
            .tolerances = std::move(tolerances)};
}

/// What is left of the slider's equations where it bounces flat between the lower and the upper face; it ends in flight.
Problem bouncing(double end, Crowd crowd, std::vector<double> tolerances) {
    Inputs const slider = complete_inputs({});
    double const face_stiffness =
        slider.slider_young_modulus * slider.slider_length * slider.way_depth / slider.thickness_y;
    BouncingEnsemble ensemble;
    for (std::size_t i = 0; ensemble.members.size() < crowd.all; ++i) {
        double const clearance = 1e-4 * (1 + 0.2 * scattered(i, 0.3166247903553998));
        double const speed = 0.1 * (1 + 0.2 * scattered(i, 0.4142135623730951));
        BouncingMember const member{0.8 * scattered(i, 0.6180339887498949), speed / std::sqrt(clearance * slider.gravity),
                                    face_stiffness * clearance / (slider.slider_mass * slider.gravity),
                                    std::sqrt(slider.gravity / clearance)};
        auto const last = bouncing_solution(member, end);
        if (last.face == 0 && last.margin > 0.05) ensemble.members.push_back(member);
    }
    return {.name = "bouncing",
            .title = "A mass bouncing between two springs: states after 20 ms",
            .ensemble = std::move(ensemble),
            .shared = crowd.shared,
            .members_wanted = crowd.all,
            .end_time = end,
            .max_step = end,
            .measure = Measure::state,
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
    Crowd const many = quick ? Crowd{32, 8} : Crowd{128, 128};
    // Of 32 members the second worst would say which of two methods is better.
    Crowd const crowd = quick ? many : Crowd{512, 256};
    // Finest tolerance: of states, of energies where the run is short, and where it is long.
    int const fine = quick ? 7 : 11, medium = quick ? 6 : 9, coarse = quick ? 4 : 6;
    return {
        short_horizon("settling_states", "Settling: states after 8 ms", settling, 0.008, many, decades(3, fine)),
        short_horizon("rattling_states", "Rattling: states after 18 ms", rattling, 0.018, many, decades(3, fine)),
        short_horizon("switching_states", "Switching, law of the paper: states after 9 ms", switching, 0.009, many,
                      decades(3, fine)),
        long_horizon("settling_energy", "Settling: energy residual after 0.4 s", settling, 0.4, many, 1e-3,
                     decades(3, coarse)),
        long_horizon("rattling_energy", "Rattling: energy residual after 50 ms", rattling, 0.05, crowd, 1e-3,
                     decades(3, medium)),
        long_horizon("misaligned_energy", "On a misaligned way: energy residual after 0.1 s", misaligned, 0.1, many, 1e-3,
                     decades(3, coarse)),
        long_horizon("undamped_energy", "Undamped elastic bed: energy residual after 0.1 s", undamped, 0.1, many, 1e-3,
                     decades(3, coarse)),
        long_horizon("creep_energy", "Creeping at 0.01 rad/s: energy residual after 1 s", creeping, 1, many, 1e-2,
                     decades(3, coarse)),
        long_horizon("rest_energy", "At rest: energy residual after 1 s", at_rest, 1, many, 1e-2, decades(3, coarse)),
        long_horizon("turn_energy", "A crank turn: energy residual after 2 s", settling, 2, many, 1e-2,
                     decades(3, coarse)),
        flight(0.1, many, decades(3, fine + 3)),
        springs(0.005, many, decades(3, fine + 1)),
        bouncing(0.02, many, decades(3, fine + 3)),
        lorenz(5, many, decades(3, fine + 3)),
        relief_valve(decades(5, quick ? 7 : 11)),
    };
}

}  // namespace slideway::bench
