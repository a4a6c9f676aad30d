#include "random_states.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "linear_solve.hpp"
#include "random_inputs.hpp"
#include "kernels/mechanisms/list.hpp"

namespace oracle {
namespace {

using detail::any_inputs;
using detail::Dice;
using detail::parts_number;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;
using slideway::Parts;

constexpr double deepest = 3e-5;  // δ [m]

// ---- places ------------------------------------------------------------------------------------------------------

/// A pair, by its index in `Pairs`, and the δ wanted there.
struct Target {
    int pair;
    double depth;
};
using Targets = std::array<Target, 5>;

/// Apex with these signs along Y, Z, X, as an index.
int apex_at(int s1, int s2, int s3) { return (s3 > 0 ? 0 : 4) + (s1 > 0 ? (s2 > 0 ? 0 : 3) : (s2 > 0 ? 1 : 2)); }

// Per axis, f(s3, s) = t + a3 s3 + a s is how far the slider has come towards the + face at the corner (s3, s);
// s is the sign across.  The + face touches where f > c, the - face where f < -c: δ = ±f - c.

Target towards(int axis, int s3, int across, double f, double clearance) {
    // Of the two opposite pairs of a corner the nearer one is the target: it is the one whose digits count.
    int const side = f > 0 ? +1 : -1;
    int const apex = axis == 1 ? apex_at(side, across, s3) : apex_at(across, side, s3);
    return {(axis - 1) * 8 + apex, side * f - clearance};
}

double free_gap(Dice& dice, double clearance) { return dice.uniform(-0.999, 0.999) * clearance; }

/// f at one corner: resting on a face at about `depth`, or between the faces.
double settled_gap(Dice& dice, double clearance, double depth) {
    int const fate = dice.below(4);
    if (fate == 0) return free_gap(dice, clearance);
    double const size = clearance + depth * dice.uniform(0.5, 1.5);
    return fate == 1 ? -size : size;
}

/// Three corners of one axis fix its place and both tilts; two of the other, along X, fix the rest.
Targets settled(Dice& dice, Inputs const& in) {
    int const first = dice.chance(0.5) ? 1 : 2, second = 3 - first;
    std::array<double, 3> const clearance = {0, in.clearance_y, in.clearance_z};
    double const mirror = dice.chance(0.5) ? 1 : -1;
    double f[3];
    double const depth = dice.scale(1e-10, 1e-5);
    // Half of them have one tilt only, so that the lines and surfaces of a straight slider are common.
    bool const plain = dice.chance(0.6);
    for (double& gap : f) gap = mirror * settled_gap(dice, clearance[first], depth);
    if (plain) f[1] = f[0] + depth * dice.uniform(-0.4, 0.4);
    if (plain && dice.chance(0.5)) f[2] = f[0] + depth * dice.uniform(-0.4, 0.4);
    if (plain && std::abs(f[1]) < clearance[first]) f[1] = f[0];
    // Roll has the other axis' corners spread too; a small one leaves them together.
    double const other_depth = dice.scale(1e-10, 1e-5);
    double g[2];
    double const other_mirror = dice.chance(0.5) ? 1 : -1;
    for (double& gap : g) gap = other_mirror * settled_gap(dice, clearance[second], other_depth);
    if (dice.chance(0.5)) g[1] = g[0];
    int const s3 = dice.chance(0.5) ? 1 : -1, across = dice.chance(0.5) ? 1 : -1, other = dice.chance(0.5) ? 1 : -1;
    return {towards(first, s3, across, f[0], clearance[first]), towards(first, s3, -across, f[1], clearance[first]),
            towards(first, -s3, across, f[2], clearance[first]), towards(second, +1, other, g[0], clearance[second]),
            towards(second, -1, other, g[1], clearance[second])};
}

/// Corners on the + and on the - face.  Flat faces with a gap allow these eight patterns, and their mirror images.
constexpr std::pair<int, int> patterns[8] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {1, 1}, {2, 1}, {3, 1}};

struct Plane {
    double centre, along, across;  // t, a3, a
    [[nodiscard]] double at(int s3, int s) const { return centre + along * s3 + across * s; }
    [[nodiscard]] std::pair<int, int> touching(double clearance) const {
        int plus = 0, minus = 0;
        for (int s3 : {-1, 1}) {
            for (int s : {-1, 1}) {
                plus += at(s3, s) > clearance;
                minus += at(s3, s) < -clearance;
            }
        }
        return {plus, minus};
    }
};

Plane draw_plane(Dice& dice, double clearance, double across) {
    return {dice.uniform(0, 3) * clearance, dice.uniform(-3, 3) * clearance, across};
}

/// By rejection: clearances and roll first, for both axes share them, then each axis until its pattern comes.
Targets wedged(Dice& dice, Inputs& in, int combination) {
    auto const wanted_y = patterns[combination % 8], wanted_z = patterns[combination / 8 % 8];
    for (;;) {
        // A third corner against the first one's opposite takes a roll that opens or shuts the other axis as well,
        // by the ratio of the clearances.
        in.clearance_y = dice.scale(1e-7, 3e-6);
        in.clearance_z = std::clamp(in.clearance_y * dice.scale(0.2, 5), 1e-7, 3e-6);
        double const roll = dice.signed_scale(0.01, 3) * 2 * in.clearance_y / in.way_depth;
        Plane y{}, z{};
        bool found_y = false, found_z = false;
        for (int i = 0; i < 200 && !found_y; ++i) {
            y = draw_plane(dice, in.clearance_y, -roll * in.way_depth / 2);
            found_y = y.touching(in.clearance_y) == wanted_y;
        }
        for (int i = 0; i < 200 && found_y && !found_z; ++i) {
            z = draw_plane(dice, in.clearance_z, roll * in.way_width / 2);
            found_z = z.touching(in.clearance_z) == wanted_z;
        }
        if (!found_y || !found_z) continue;
        double const cy = in.clearance_y, cz = in.clearance_z;
        Targets targets = {towards(1, +1, +1, y.at(+1, +1), cy), towards(1, +1, -1, y.at(+1, -1), cy),
                           towards(1, -1, +1, y.at(-1, +1), cy), towards(2, +1, +1, z.at(+1, +1), cz),
                           towards(2, -1, +1, z.at(-1, +1), cz)};
        // The half turn about X is a symmetry: it brings the - faces as often.
        if (dice.chance(0.5))
            for (Target& target : targets) target.pair = (target.pair & ~3) | (((target.pair & 3) + 2) & 3);
        return targets;
    }
}

Targets loose(Dice& dice, Inputs const& in) {
    double const cy = in.clearance_y, cz = in.clearance_z, reach = dice.chance(0.8) ? 0.9 : 1.001;
    double const roll = dice.uniform(-0.3, 0.3) * std::min(cy / in.way_depth, cz / in.way_width);
    Plane const y{dice.uniform(-reach, reach) * cy, dice.uniform(-0.3, 0.3) * cy, -roll * in.way_depth / 2};
    Plane const z{dice.uniform(-reach, reach) * cz, dice.uniform(-0.3, 0.3) * cz, roll * in.way_width / 2};
    return {towards(1, +1, +1, y.at(+1, +1), cy), towards(1, +1, -1, y.at(+1, -1), cy),
            towards(1, -1, +1, y.at(-1, +1), cy), towards(2, +1, +1, z.at(+1, +1), cz),
            towards(2, -1, +1, z.at(-1, +1), cz)};
}

/// Straight in a straight way, where penetrations of a face are equal to the last bit.
void lay_flat(Dice& dice, Inputs const& in, State& state) {
    std::array<double, 2> const clearance = {in.clearance_y, in.clearance_z};
    for (int i = 0; i < 2; ++i) {
        double const size =
            dice.chance(0.7) ? clearance[i] + dice.scale(1e-10, 1e-5) : dice.uniform(0, 0.99) * clearance[i];
        state[i] = dice.chance(0.5) ? size : -size;
    }
}

/// Newton on y z φ ϑ ψ for the five penetrations, from the slider lying along the way.
/// @return false where it does not settle to 1e-6 of each target (or the rounding of the state).
bool place(Inputs const& in, Parts const& parts, double t, Targets const& targets, State& state) {
    constexpr int free_coordinates[5] = {0, 1, 4, 5, 6};
    state[4] = in.way_roll, state[5] = in.way_yaw, state[6] = in.way_pitch;
    auto const error = [&](State const& s) {
        Pairs const depths = penetrations(in, parts, t, s);
        Eigen::Matrix<double, 5, 1> result;
        for (int i = 0; i < 5; ++i) result[i] = depths[targets[i].pair] - targets[i].depth;
        return result;
    };
    for (int iteration = 0; iteration < 12; ++iteration) {
        auto const now = error(state);
        bool settled = now.allFinite();
        for (int i = 0; i < 5; ++i) settled = settled && std::abs(now[i]) < 1e-6 * std::abs(targets[i].depth) + 1e-17;
        if (settled) return true;
        Eigen::Matrix<double, 5, 5> slopes;
        double const step = 1e-7;
        for (int j = 0; j < 5; ++j) {
            State moved = state;
            moved[free_coordinates[j]] += step;
            slopes.col(j) = (error(moved) - now) / (moved[free_coordinates[j]] - state[free_coordinates[j]]);
        }
        Eigen::Matrix<double, 5, 1> const correction =
            solution(slopes.cast<long double>(), now.cast<long double>()).cast<double>();
        if (!correction.allFinite()) return false;
        for (int j = 0; j < 5; ++j) state[free_coordinates[j]] -= correction[j];
    }
    return false;
}

// ---- rates -------------------------------------------------------------------------------------------------------

void set_rates(Dice& dice, Inputs const& in, State& state) {
    if (dice.chance(0.1)) return;  // at rest; with a resting crank the sliding speed is zero
    double const speed = dice.scale(1e-6, 0.3);
    for (int i : {2, 3, 7, 8, 9}) {
        if (dice.chance(0.1)) continue;
        double const arm = i < 4 ? 1 : in.slider_length / 2;
        state[i] = speed * dice.uniform(-1, 1) / arm;
    }
}

/// What moves the slider along the way does so at about a speed at which friction changes.
void slow_to_friction(Dice& dice, Case& c) {
    Inputs& in = c.inputs;
    double const speed = dice.scale(0.1 * in.friction_stick_speed, 2 * in.friction_slip_speed);
    in.crank_speed = (in.crank_speed < 0 ? -1 : 1) * speed / in.crank_length;
    in.stroke *= speed / in.carriage_speed;
    in.carriage_speed = speed;
    bool const turns = c.parts.drive.turns_freely();
    c.state[11] = std::copysign(turns ? speed / in.crank_length : speed, c.state[11]);
}

void set_motor(Dice& dice, Case& c) {
    Inputs& in = c.inputs;
    c.parts.drive.by = dice.chance(0.2) ? slideway::DriveBy::nothing : slideway::DriveBy::torque;
    if (c.parts.drive.by == slideway::DriveBy::torque) {
        in.drive_torque = dice.signed_scale(1e-2, 10);
        in.drive_no_load_speed = dice.chance(0.3) ? 0 : dice.scale(1, 300);
    }
    in.drive_viscous = dice.chance(0.3) ? 0 : dice.scale(1e-5, 1e-1);
    in.drive_inertia = dice.scale(1e-5, 1);
    c.state[10] = dice.uniform(-10, 10);
    c.state[11] = dice.signed_scale(1e-2, 100);
}

/// What a slider-crank does not have.
void set_along_the_way(Dice& dice, Case& c) {
    Inputs& in = c.inputs;
    auto const vary_stiffness = [&] {
        if (dice.chance(0.5)) in.point_stiffness = dice.scale(1e6, 1e11);
    };
    switch (c.parts.mechanism) {
        case Mechanism::slider_crank:
            return;
        case Mechanism::carriage:
            vary_stiffness();
            in.carriage_speed = dice.scale(1e-3, 1);
            in.stroke = in.carriage_speed * dice.uniform(0.1, 2);
            in.reversal_time = dice.scale(1e-3, 0.3);
            return;
        case Mechanism::scotch_yoke:
            vary_stiffness();
            return;
        case Mechanism::free_slider:
            vary_stiffness();
            c.state[10] = dice.uniform(-0.2, 0.3);
            c.state[11] = dice.chance(0.1) ? 0 : dice.signed_scale(1e-4, 3);
            return;
        case Mechanism::slider_crank_motor:
        case Mechanism::scotch_yoke_motor:
            vary_stiffness();
            set_motor(dice, c);
            return;
        case Mechanism::planar_slider_crank:
            break;
    }
    throw std::invalid_argument("oracle: the planar mechanism has cases of its own");
}

/// @return t [s]: of a carriage somewhere on its first periods, as often turning round as under way.
double any_time(Dice& dice, Case const& c) {
    switch (c.parts.mechanism) {
        case Mechanism::carriage: {
            double const straight = c.inputs.stroke / c.inputs.carriage_speed, half = straight + c.inputs.reversal_time;
            double const since = dice.chance(0.5) ? dice.uniform(0, straight) : dice.uniform(straight, half);
            return dice.below(6) * half + since;
        }
        case Mechanism::slider_crank:
        case Mechanism::scotch_yoke:
        case Mechanism::free_slider:
        case Mechanism::planar_slider_crank:
        case Mechanism::slider_crank_motor:
        case Mechanism::scotch_yoke_motor:
            break;
    }
    return dice.uniform(0, 2);
}

Case make_case(Dice& dice, int number, Mechanism mechanism) {
    for (;;) {
        Case result;
        result.parts = parts_number(number, mechanism);
        result.inputs = any_inputs(dice, result.parts);
        Inputs& in = result.inputs;
        set_along_the_way(dice, result);
        int const kind = number / 24 % 4;
        if (dice.chance(0.4)) slow_to_friction(dice, result);
        result.t = any_time(dice, result);
        int const combination = number / 96 + 24 * (number % 24);  // in step with the parts, one of 64 at a time
        Targets const targets = kind == 1   ? wedged(dice, in, combination)
                                : kind == 3 ? loose(dice, in)
                                            : settled(dice, in);
        if (kind == 3 && !result.parts.misaligned_way && dice.chance(0.3))
            lay_flat(dice, in, result.state);
        else if (!place(in, result.parts, result.t, targets, result.state))
            continue;
        // The corners that no target holds may lie in the wall by a whole clearance: no joint gets there.
        Pairs const depths = penetrations(in, result.parts, result.t, result.state);
        if (*std::max_element(depths.begin(), depths.end()) > deepest) continue;
        set_rates(dice, in, result.state);
        for (double& speed : result.impact_speeds) speed = dice.chance(0.1) ? 1e-4 : dice.scale(1e-4, 1);
        return result;
    }
}

}  // namespace

std::vector<Case> make_cases(std::uint64_t seed, int count, Mechanism mechanism) {
    Dice dice(seed);
    std::vector<Case> cases;
    cases.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) cases.push_back(make_case(dice, i, mechanism));
    return cases;
}

std::vector<Case> make_cases(std::uint64_t seed, int count, Mechanism mechanism, Law law) {
    std::vector<Case> cases = make_cases(seed, count, mechanism);
    Dice dice(~seed);
    for (Case& c : cases) detail::set_law(dice, law, c.parts, c.inputs);
    return cases;
}

}  // namespace oracle
