#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/mechanisms/list.hpp"
#include "oracle.hpp"
#include "planar.hpp"
#include "random_inputs.hpp"

namespace oracle {
namespace {

using detail::Dice;
using slideway::Damping;
using slideway::Inputs;
using slideway::Mechanism;
using slideway::Parts;

constexpr double shallowest = 3e-8, deepest = 3e-5;  // δ [m]

enum class Touch { none, one, wall, opposite };

Parts parts_number(int i) {
    Parts parts;
    parts.mechanism = Mechanism::planar_slider_crank;
    parts.damping = std::array{Damping::point, Damping::rate, Damping::restitution}[i % 3];
    parts.friction = i / 3 % 2 != 0;
    parts.drive.by = i / 6 % 2 != 0 ? slideway::DriveBy::nothing : slideway::DriveBy::speed;
    return parts;
}

Inputs any_inputs(Dice& dice) {
    Inputs in;
    if (dice.chance(0.7)) detail::vary_mechanism(dice, in);
    if (dice.chance(0.5)) detail::vary_contact(dice, in);
    in.slider_length = dice.uniform(0.03, 0.12);
    in.slider_height = dice.uniform(0.01, 0.06);
    in = completed(in);
    if (dice.chance(0.5)) in.crank_inertia = dice.scale(1e-6, 1e-4);
    if (dice.chance(0.5)) in.point_stiffness = dice.scale(1e6, 1e11);
    in.clearance_y = dice.scale(5e-5, 2e-3);
    in.restitution = dice.chance(0.1) ? 1 : dice.uniform(0.05, 0.999);
    in.start_angle = dice.uniform(-std::numbers::pi, std::numbers::pi);
    in.crank_speed = dice.chance(0.1) ? 0 : dice.signed_scale(1e-4, 200);
    return in;
}

/// ψ and y for the wanted contact.  With h = (1 - cos ψ) b, the corner (s3, s1) lies s1 (y + s3 a sin ψ) - h - c deep.
void place(Dice& dice, Touch touch, bool alike, Inputs& in) {
    double const a = in.slider_length / 2, b = in.slider_height / 2, c = in.clearance_y;
    double const side = dice.chance(0.5) ? 1 : -1, turn = dice.chance(0.5) ? 1 : -1;
    double const depth = dice.scale(shallowest, deepest);
    auto const lift = [b](double tilt) { return 2 * b * std::sin(tilt / 2) * std::sin(tilt / 2); };
    double tilt = 0, y = 0;
    if (touch == Touch::none) {
        tilt = dice.uniform(-0.4, 0.4) * c / a;
        y = dice.uniform(-0.5, 0.5) * c;
    } else if (touch == Touch::wall) {
        tilt = alike ? 0 : dice.uniform(0.1, 0.9) * depth / (4 * a);
        y = side * (c + lift(tilt) + depth);
    } else if (touch == Touch::one) {
        tilt = (depth * dice.uniform(1, 3) + dice.uniform(0, 0.6) * c) / a;
        y = side * (c + lift(tilt) + depth - a * std::sin(tilt));
    } else {
        // Both walls: 2 a sin ψ - 2 h - 2 c is the sum of two depths.
        double const other = dice.scale(shallowest, deepest);
        for (int i = 0; i < 60; ++i) tilt = std::asin((c + lift(tilt) + (depth + other) / 2) / a);
        y = side * (depth - other) / 2;
    }
    in.pitch = turn * tilt;
    in.y = y;
}

void set_rates(Dice& dice, Inputs& in) {
    if (dice.chance(0.1)) return;
    double const speed = dice.scale(1e-5, 1);
    in.vy = dice.chance(0.1) ? 0 : speed * dice.uniform(-1, 1);
    in.wz = dice.chance(0.1) ? 0 : speed * dice.uniform(-2, 2) / in.slider_length;
}

/// The rod reaches, and not so steeply that y hardly depends on its angle.
bool reaches(Inputs const& in) {
    return std::abs(in.y - in.crank_length * std::sin(in.start_angle)) < 0.7 * in.rod_length;
}

bool touches_so(PlanarResult const& r, Touch touch) {
    switch (touch) {
        case Touch::none:
            return r.surfaces == 0 && r.points == 0;
        case Touch::one:
            return r.surfaces == 0 && r.points == 1;
        case Touch::wall:
            return r.surfaces == 1 && r.points == 0;
        case Touch::opposite:
            return r.surfaces == 0 && r.points == 2;
    }
    return false;
}

PlanarCase make_case(Dice& dice, int number) {
    auto const touch = static_cast<Touch>(number / 12 % 4);
    for (;;) {
        PlanarCase result;
        result.parts = parts_number(number);
        Inputs& in = result.inputs = any_inputs(dice);
        place(dice, touch, number / 48 % 2 != 0, in);
        if (dice.chance(0.4)) {
            double const speed = dice.scale(0.1 * in.friction_stick_speed, 2 * in.friction_slip_speed);
            in.crank_speed = std::copysign(speed / in.crank_length, in.crank_speed);
        }
        if (!reaches(in)) continue;
        set_rates(dice, in);
        PlanarResult const r = PlanarMechanism(in, result.parts).at(planar_start(in));
        bool const sure = std::ranges::none_of(r.depth, [](long double d) { return std::abs(d) < shallowest / 3; });
        if (!sure || !touches_so(r, touch)) continue;
        for (auto& speed : result.impact_speeds) speed = dice.chance(0.1) ? 1e-4 : dice.scale(1e-4, 3);
        return result;
    }
}

}  // namespace

std::vector<PlanarCase> make_planar_cases(std::uint64_t seed, int count) {
    Dice dice(seed);
    std::vector<PlanarCase> cases;
    cases.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) cases.push_back(make_case(dice, i));
    return cases;
}

}  // namespace oracle
