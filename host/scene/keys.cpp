#include "host/scene/keys.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/scene/rules.hpp"

namespace slideway {
namespace {

constexpr MechanismSet crank = set_of(Mechanism::slider_crank), carriage = set_of(Mechanism::carriage),
                       free_slider = set_of(Mechanism::free_slider), planar = set_of(Mechanism::planar_slider_crank);
constexpr MechanismSet cranks = crank | planar, spatial = crank | carriage | free_slider, all = spatial | planar;

constexpr Key single_keys[] = {
    {"mechanism.crank_length", &Inputs::crank_length, "m", Rule::positive, "crank length", cranks},
    {"mechanism.rod_length", &Inputs::rod_length, "m", Rule::positive, "rod length", cranks},
    {"mechanism.crank_speed", &Inputs::crank_speed, "rad/s", Rule::any, "crank speed", cranks},
    {"mechanism.start_angle", &Inputs::start_angle, "rad", Rule::any, "crank angle at the start", cranks},
    {"mechanism.gravity", &Inputs::gravity, "m/s2", Rule::any, "gravity", all},
    {"mechanism.inclination", &Inputs::inclination, "rad", Rule::right_angle, "inclination of the way", all},
    {"mechanism.crank_mass", &Inputs::crank_mass, "kg", Rule::positive, "mass of the crank", cranks},
    {"mechanism.rod_mass", &Inputs::rod_mass, "kg", Rule::positive, "mass of the rod", cranks},
    {"mechanism.rod_mass_center", &Inputs::rod_mass_center, "1", Rule::unit_interval,
     "centre of mass of the rod as a fraction of its length from the crank pin", crank},
    {"mechanism.rod_inertia", &Inputs::rod_inertia, "kg m2", Rule::not_negative,
     "transverse inertia of the rod about its centre of mass", cranks},
    {"mechanism.slider_mass", &Inputs::slider_mass, "kg", Rule::positive, "mass of the slider", all},
    {"mechanism.slider_inertia_x", &Inputs::slider_inertia_x, "kg m2", Rule::positive,
     "inertia of the slider about X", spatial},
    {"mechanism.slider_inertia_y", &Inputs::slider_inertia_y, "kg m2", Rule::positive,
     "inertia of the slider about Y", spatial},
    {"mechanism.slider_inertia_z", &Inputs::slider_inertia_z, "kg m2", Rule::positive,
     "inertia of the slider about Z", all},
    {"mechanism.crank_inertia", &Inputs::crank_inertia, "kg m2", Rule::not_negative,
     "inertia of the crank about its centre of mass", planar},
    {"mechanism.carriage_speed", &Inputs::carriage_speed, "m/s", Rule::positive, "speed of the carriage", carriage},
    {"mechanism.stroke", &Inputs::stroke, "m", Rule::positive, "way of the carriage at constant speed", carriage},
    {"mechanism.reversal_time", &Inputs::reversal_time, "s", Rule::positive, "time in which the carriage turns round",
     carriage},
    {"joint.slider_length", &Inputs::slider_length, "m", Rule::positive, "length of the slider", all},
    {"joint.way_width", &Inputs::way_width, "m", Rule::positive, "width of the way along Y", spatial},
    {"joint.way_depth", &Inputs::way_depth, "m", Rule::positive, "depth of the way along Z", spatial},
    {"joint.thickness_y", &Inputs::thickness_y, "m", Rule::positive,
     "compressed thickness behind the Y faces", spatial},
    {"joint.thickness_z", &Inputs::thickness_z, "m", Rule::positive,
     "compressed thickness behind the Z faces", spatial},
    {"joint.clearance_y", &Inputs::clearance_y, "m", Rule::gap, "clearance per side along Y", all},
    {"joint.clearance_z", &Inputs::clearance_z, "m", Rule::gap, "clearance per side along Z", spatial},
    {"joint.slider_height", &Inputs::slider_height, "m", Rule::positive, "height of the planar slider", planar},
    {"way.offset_y", &Inputs::way_offset_y, "m", Rule::any, "offset of the way along Y", spatial},
    {"way.offset_z", &Inputs::way_offset_z, "m", Rule::any, "offset of the way along Z", spatial},
    {"way.roll", &Inputs::way_roll, "rad", Rule::any, "roll of the way", spatial},
    {"way.yaw", &Inputs::way_yaw, "rad", Rule::any, "yaw of the way", spatial},
    {"way.pitch", &Inputs::way_pitch, "rad", Rule::any, "pitch of the way", spatial},
    {"contact.slider_young_modulus", &Inputs::slider_young_modulus, "Pa", Rule::positive, "modulus of the slider", all},
    {"contact.way_young_modulus", &Inputs::way_young_modulus, "Pa", Rule::positive, "modulus of the way", all},
    {"contact.slider_poisson_ratio", &Inputs::slider_poisson_ratio, "1", Rule::poisson_ratio,
     "Poisson's ratio of the slider", all},
    {"contact.way_poisson_ratio", &Inputs::way_poisson_ratio, "1", Rule::poisson_ratio,
     "Poisson's ratio of the way", all},
    {"contact.edge_radius", &Inputs::edge_radius, "m", Rule::positive, "edge radius of line contacts", spatial},
    {"contact.apex_radius", &Inputs::apex_radius, "m", Rule::positive, "apex radius of point contacts", all},
    {"contact.point_stiffness", &Inputs::point_stiffness, "1", Rule::positive,
     "stiffness of point contacts [N/m^n, n the Hertz exponent]", all},
    {"contact.hertz_exponent", &Inputs::hertz_exponent, "1", Rule::hertz_exponent,
     "Hertz exponent of point contacts", all},
    {"contact.eta", &Inputs::eta, "1", Rule::not_negative, "damping ratio of point contacts", all},
    {"contact.chi_line", &Inputs::chi_line, "s/m", Rule::not_negative, "dissipation of line contacts", spatial},
    {"contact.chi_surface", &Inputs::chi_surface, "s/m", Rule::not_negative,
     "dissipation of surface contacts", spatial},
    {"contact.restitution", &Inputs::restitution, "1", Rule::half_open_unit, "coefficient of restitution", all},
    {"friction.static", &Inputs::friction_static, "1", Rule::not_negative, "static friction coefficient", all},
    {"friction.kinetic", &Inputs::friction_kinetic, "1", Rule::not_negative, "kinetic friction coefficient", all},
    {"friction.stick_speed", &Inputs::friction_stick_speed, "m/s", Rule::positive,
     "speed of the largest friction", all},
    {"friction.slip_speed", &Inputs::friction_slip_speed, "m/s", Rule::positive,
     "speed where kinetic friction begins", all},
    {"initial.y", &Inputs::y, "m", Rule::any, "vertical position at the start", all},
    {"initial.z", &Inputs::z, "m", Rule::any, "lateral position at the start", spatial},
    {"initial.vy", &Inputs::vy, "m/s", Rule::any, "vertical velocity at the start", all},
    {"initial.vz", &Inputs::vz, "m/s", Rule::any, "lateral velocity at the start", spatial},
    {"initial.roll", &Inputs::roll, "rad", Rule::any, "roll at the start", spatial},
    {"initial.yaw", &Inputs::yaw, "rad", Rule::any, "yaw at the start", spatial},
    {"initial.pitch", &Inputs::pitch, "rad", Rule::any, "pitch at the start", all},
    {"initial.wx", &Inputs::wx, "rad/s", Rule::any, "angular velocity about the slider's X at the start", spatial},
    {"initial.wy", &Inputs::wy, "rad/s", Rule::any, "angular velocity about the slider's Y at the start", spatial},
    {"initial.wz", &Inputs::wz, "rad/s", Rule::any, "angular velocity about the slider's Z at the start", all},
    {"initial.x", &Inputs::x, "m", Rule::any, "position along the way at the start", free_slider},
    {"initial.vx", &Inputs::vx, "m/s", Rule::any, "velocity along the way at the start", free_slider},
};
static_assert(sizeof(single_keys) / sizeof(Key) == sizeof(Inputs) / sizeof(double), "one key per input");

constexpr Key double_keys[] = {
    {"joint.clearance", &Inputs::clearance_y, "m", Rule::gap, "clearance per side", all, &Inputs::clearance_z},
    {"contact.young_modulus", &Inputs::slider_young_modulus, "Pa", Rule::positive, "modulus of both bodies", all,
     &Inputs::way_young_modulus},
};

// The paper's bodies (Tables 6 and 7): sections and block in steel.
constexpr double steel_density = 7800;                        // [kg/m³]
constexpr double crank_section = 0.005 * 0.0025;              // [m²]
constexpr double rod_section = 0.0142 * 0.0071;               // [m²]
constexpr double block_x = 0.04, block_y = 0.02, block_z = 0.03;  // [m]

void fill(double& input, double value) {
    if (std::isnan(input)) input = value;
}

}  // namespace

bool Key::overlaps(Key const& other) const {
    auto const sets = [](Key const& key, double Inputs::*input) {
        return input != nullptr && (key.member == input || key.twin == input);
    };
    return sets(other, member) || sets(other, twin);
}

std::span<Key const> keys() { return single_keys; }
std::span<Key const> twin_keys() { return double_keys; }

Key const* find_key(std::string_view dotted_name) {
    for (auto const table : {keys(), twin_keys()}) {
        for (Key const& key : table) {
            if (key.name == dotted_name) return &key;
        }
    }
    return nullptr;
}

void require_part(Parts& parts, Key const& key) {
    if (key.name.starts_with("way.")) parts.misaligned_way = true;
    if (key.name.starts_with("friction.")) parts.friction = true;
    if (key.name.starts_with("contact.chi_") && parts.damping == Damping::point) parts.damping = Damping::rate;
    if (key.name == "contact.restitution") parts.damping = Damping::restitution;
}

Inputs complete_inputs(Inputs given) {
    Inputs& in = given;
    fill(in.crank_mass, steel_density * crank_section * in.crank_length);
    fill(in.rod_mass, steel_density * rod_section * in.rod_length);
    fill(in.rod_inertia, in.rod_mass * in.rod_length * in.rod_length / 12);
    fill(in.crank_inertia, in.crank_mass * in.crank_length * in.crank_length / 12);
    fill(in.slider_mass, steel_density * block_x * block_y * block_z);
    fill(in.slider_inertia_x, in.slider_mass * (block_y * block_y + block_z * block_z) / 12);
    fill(in.slider_inertia_y, in.slider_mass * (block_x * block_x + block_z * block_z) / 12);
    fill(in.slider_inertia_z, in.slider_mass * (block_x * block_x + block_y * block_y) / 12);
    fill(in.thickness_y, in.way_width);
    fill(in.thickness_z, in.way_depth);
    double const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    double const reduced = 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
    fill(in.point_stiffness, 4.0 / 3.0 * reduced * std::sqrt(in.apex_radius));
    return given;
}

std::string with_unit(double value, std::string_view unit) {
    return unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::optional<Problem> broken_rule(Key const& key, double value) {
    if (!std::isfinite(value)) return Problem{"not a finite number", "use a finite number"};
    auto const must_be = [&](std::string_view range) {
        return fmt::format("the {} must be {}", key.meaning, range);
    };
    switch (key.rule) {
    case Rule::any: break;
    case Rule::positive:
        if (!(value > 0)) return Problem{must_be("positive"), "use a value > 0"};
        break;
    case Rule::not_negative:
        if (!(value >= 0)) return Problem{must_be("zero or positive"), "use a value >= 0"};
        break;
    case Rule::gap:
        if (!(value > 0)) return Problem{"the joint needs a gap", "use a value > 0"};
        break;
    case Rule::unit_interval:
        if (!(value >= 0 && value <= 1)) return Problem{must_be("in [0, 1]"), "use a value from 0 to 1"};
        break;
    case Rule::half_open_unit:
        if (!(value > 0 && value <= 1)) return Problem{must_be("in (0, 1]"), "use a value > 0 and <= 1"};
        break;
    case Rule::poisson_ratio:
        if (!(value > -1 && value <= 0.5)) {
            return Problem{"no isotropic solid has it", "use a value > -1 and <= 0.5"};
        }
        break;
    case Rule::hertz_exponent:
        if (!(value >= 1 && value <= 3)) return Problem{must_be("in [1, 3]"), "use a value from 1 to 3"};
        break;
    case Rule::right_angle:
        if (!(std::abs(value) <= std::numbers::pi / 2)) {
            return Problem{must_be("in [-90, 90] degrees"), "use a value from -90 deg to 90 deg"};
        }
        break;
    }
    return std::nullopt;
}

std::optional<Defect> find_defect(Inputs const& inputs, Parts const& parts) {
    Inputs const in = complete_inputs(inputs);
    for (Key const& key : keys()) {
        if (!key.counts_for(parts.mechanism)) continue;
        if (auto problem = broken_rule(key, key.get(in))) return Defect{&key, nullptr, key.get(in), *problem};
    }
    auto const clash = [&](std::string_view name, std::string_view other, std::string reason, std::string advice) {
        Key const* const key = find_key(name);
        return Defect{key, find_key(other), key->get(in), {std::move(reason), std::move(advice)}};
    };
    bool const has_crank = find_key("mechanism.rod_length")->counts_for(parts.mechanism);
    if (has_crank && in.crank_speed != 0 && in.rod_length <= in.crank_length) {
        return clash("mechanism.rod_length", "mechanism.crank_length",
                     fmt::format("the crank of {} m cannot turn fully", in.crank_length),
                     "use a rod longer than the crank, or crank_speed = 0");
    }
    // The planar mechanism starts with the rod's angle, which follows from y.
    if (parts.mechanism == Mechanism::planar_slider_crank &&
        !(std::abs(in.y - in.crank_length * std::sin(in.start_angle)) < in.rod_length)) {
        return clash("initial.y", "mechanism.start_angle",
                     fmt::format("the rod of {} m does not reach it from a crank at {} rad", in.rod_length,
                                 in.start_angle),
                     "use a value near 0");
    }
    if (in.friction_slip_speed <= in.friction_stick_speed) {
        return clash("friction.slip_speed", "friction.stick_speed",
                     fmt::format("not above friction.stick_speed, {} m/s", in.friction_stick_speed),
                     "use a slip_speed > stick_speed");
    }
    return std::nullopt;
}

std::optional<std::string> defect(Inputs const& inputs, Parts const& parts) {
    auto const found = find_defect(inputs, parts);
    if (!found) return std::nullopt;
    return fmt::format("{} is {} ({}); {}", found->key->name, with_unit(found->value, found->key->unit),
                       found->problem.reason, found->problem.advice);
}

}  // namespace slideway
