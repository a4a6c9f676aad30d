#include "random_inputs.hpp"

#include <array>
#include <numbers>

#include "oracle.hpp"
#include "kernels/laws/list.hpp"

namespace oracle::detail {

using slideway::Damping;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;
using slideway::Parts;

namespace {

void vary_joint(Dice& dice, Inputs& in) {
    in.slider_length = dice.uniform(0.02, 0.06);
    in.way_width = dice.uniform(0.01, 0.04);
    in.way_depth = dice.uniform(0.01, 0.04);
    in.thickness_y = dice.uniform(0.005, 0.03);
    in.thickness_z = dice.uniform(0.005, 0.03);
}

void misalign(Dice& dice, Inputs& in) {
    in.way_offset_y = dice.signed_scale(1e-6, 1e-3);
    in.way_offset_z = dice.signed_scale(1e-6, 1e-3);
    in.way_roll = dice.signed_scale(1e-5, 3e-2);
    in.way_yaw = dice.signed_scale(1e-5, 3e-2);
    in.way_pitch = dice.signed_scale(1e-5, 3e-2);
}

}  // namespace

Parts parts_number(int i, Mechanism mechanism) {
    Parts parts;
    parts.mechanism = mechanism;
    parts.law = std::array{Law::paper, Law::conservative}[i % 2];
    parts.friction = i / 2 % 2 != 0;
    parts.misaligned_way = i / 4 % 2 != 0;
    parts.damping = std::array{Damping::point, Damping::rate, Damping::restitution}[i / 8 % 3];
    return parts;
}

void set_law(Dice& dice, Law law, Parts& parts, Inputs& in) {
    parts.law = law;
    switch (law) {
        case Law::paper:
        case Law::conservative:
            in.law_a = in.law_b = 0;
            return;
        case Law::foundation:
            in.law_a = dice.chance(0.5) ? slideway::follows : dice.scale(1e9, 1e14);
            in.law_b = 0;
            return;
        case Law::kelvin_voigt:
            parts.damping = Damping::point;
            in.law_a = dice.chance(0.4) ? slideway::follows : dice.scale(1e5, 1e10);
            in.law_b = dice.chance(0.3) ? 0 : dice.scale(1, 1e4);
            return;
    }
}

void vary_mechanism(Dice& dice, Inputs& in) {
    in.crank_length = dice.uniform(0.03, 0.07);
    in.rod_length = dice.uniform(0.11, 0.2);
    in.start_angle = dice.uniform(-std::numbers::pi, std::numbers::pi);
    in.gravity = dice.uniform(0, 20);
    in.inclination = dice.uniform(-0.6, 0.6);
    in.crank_mass = dice.uniform(0.002, 0.02);
    in.rod_mass = dice.uniform(0.05, 0.2);
    in.rod_mass_center = dice.uniform(0.3, 0.7);
    in.rod_inertia = in.rod_mass * in.rod_length * in.rod_length / dice.uniform(8, 16);
    in.slider_mass = dice.uniform(0.1, 0.4);
    in.slider_inertia_x = dice.scale(5e-6, 5e-5);
    in.slider_inertia_y = dice.scale(1e-5, 1e-4);
    in.slider_inertia_z = dice.scale(1e-5, 1e-4);
}

void vary_contact(Dice& dice, Inputs& in) {
    in.slider_young_modulus = dice.scale(1e9, 1e12);
    in.way_young_modulus = dice.scale(1e9, 1e12);
    in.slider_poisson_ratio = dice.uniform(0, 0.49);
    in.way_poisson_ratio = dice.uniform(0, 0.49);
    in.edge_radius = dice.scale(1e-5, 1e-2);
    in.apex_radius = dice.scale(1e-5, 1e-2);
    in.hertz_exponent = dice.chance(0.25) ? 1.5 : dice.uniform(1.1, 2);
    in.eta = dice.chance(0.25) ? 0 : dice.scale(1e-4, 1);
    in.friction_static = dice.uniform(0.05, 1);
    in.friction_kinetic = in.friction_static * dice.uniform(0.1, 1);
    in.friction_stick_speed = dice.scale(1e-4, 1e-2);
    in.friction_slip_speed = in.friction_stick_speed * dice.uniform(1.5, 20);
}

Inputs any_inputs(Dice& dice, Parts const& parts) {
    Inputs in;
    if (dice.chance(0.5)) vary_mechanism(dice, in);
    if (dice.chance(0.5)) vary_joint(dice, in);
    if (dice.chance(0.5)) vary_contact(dice, in);
    in = completed(in);
    in.crank_speed = dice.chance(0.1) ? 0 : dice.signed_scale(1e-4, 100);
    double const widest = dice.chance(0.9) ? 1e-3 : 5e-3;
    in.clearance_y = dice.scale(1e-5, widest);
    in.clearance_z = dice.chance(0.5) ? in.clearance_y : dice.scale(1e-5, widest);
    in.chi_line = dice.chance(0.2) ? 0 : dice.scale(1e-2, 30);
    in.chi_surface = dice.chance(0.2) ? 0 : dice.scale(1e-2, 30);
    in.restitution = dice.chance(0.1) ? 1 : dice.uniform(0.05, 0.999);
    if (parts.misaligned_way) misalign(dice, in);
    return in;
}

}  // namespace oracle::detail
