// What a scene says about one member: plain numbers in SI units, one per key of the scene file.  Kernels derive
// their own parameters from it (mechanisms/slider_parameters.hpp, planar_parameters.hpp); the host reads, varies and stores it.
// Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <limits>

#include "kernels/key.hpp"
#include "kernels/loads/drive_plan.hpp"
#include "kernels/loads/load_list.hpp"

namespace slideway {

struct LinkagePlan;  // kernels/linkage/linkage_plan.hpp
inline constexpr int most_linkage_coordinates = 8, most_linkage_numbers = 96;

/// Marks an input that was not given and follows from others (members/complete_inputs.hpp fills it).
inline constexpr double follows = std::numeric_limits<double>::quiet_NaN();

/// What moves the slider (model.md 6, 7): a row of mechanisms/list.hpp, or one that a module brought, which have places behind those.
enum class Mechanism : int;

/// How contacts push (model.md 4), where they are not rigid: a row of laws/list.hpp, or one that a module brought.
enum class Law : int;

/// point: C of point contacts alone (χ = 0), or what the law has of its own.  rate: C and χ.  restitution: replaces both.
enum class Damping { point, rate, restitution };
inline constexpr int damping_count = 3;

/// What a scene has, the same for all of its members.
struct Parts {
    Law law{};  // of the spatial mechanisms
    Damping damping = Damping::point;
    bool friction = false;        // absent [friction]: no friction code runs
    bool misaligned_way = false;  // only with a [way] table does the code for its pose run
    Mechanism mechanism{};
    DrivePlan drive = {};     // what moves the mechanism
    bool rigid = false;       // contacts have no law: kernels/rigid
    LoadList loads = {};      // beside weight, contact and drive
    bool offset_slider = false;  // mass centre or pin of the slider off its hole's centre
    LinkagePlan const* linkage = nullptr;  // of a linkage; memory that the host keeps
    friend bool operator==(Parts const&, Parts const&) = default;
};

// Every number of a member: row(member, key, preset, unit, rule, group, meaning), with its symbol of model.md.
// clang-format off
#define SLIDEWAY_INPUTS(row) \
    /* [mechanism] */ \
    row(crank_length, "mechanism.crank_length", 0.05, "m", positive, crank, "crank length")  /* r */ \
    row(rod_length, "mechanism.rod_length", 0.1422, "m", positive, links, "rod length")  /* L */ \
    row(crank_speed, "mechanism.crank_speed", 3.141592653589793, "rad/s", any, crank, "crank speed")  /* ω, constant; of a free crank at the start */ \
    row(start_angle, "mechanism.start_angle", 0, "rad", any, crank, "crank angle at the start")  /* θ0 */ \
    row(gravity, "mechanism.gravity", 9.81, "m/s2", any, slider, "gravity")  /* g */ \
    row(inclination, "mechanism.inclination", 0, "rad", right_angle, slider, "inclination of the way")  /* β */ \
    row(cross_inclination, "mechanism.cross_inclination", 0, "rad", any, spatial, "inclination across the way")  /* γ */ \
    row(crank_mass, "mechanism.crank_mass", follows, "kg", positive, links, "mass of the crank")  /* m_c: ρ A_c r */ \
    row(rod_mass, "mechanism.rod_mass", follows, "kg", positive, links, "mass of the rod")  /* m_r: ρ A_r L */ \
    row(rod_mass_center, "mechanism.rod_mass_center", 0.5, "1", unit_interval, rod_centre, "centre of mass of the rod as a fraction of its length from the crank pin")  /* f_r */ \
    row(rod_inertia, "mechanism.rod_inertia", follows, "kg m2", not_negative, links, "transverse inertia of the rod about its centre of mass")  /* J: m_r L²/12 */ \
    row(slider_mass, "mechanism.slider_mass", follows, "kg", positive, slider, "mass of the slider")  /* M: ρ L_k w_a w_b; planar ρ L_k 2b d */ \
    row(slider_inertia_x, "mechanism.slider_inertia_x", follows, "kg m2", positive, spatial, "inertia of the slider about X")  /* I: of that solid with mass M */ \
    row(slider_inertia_y, "mechanism.slider_inertia_y", follows, "kg m2", positive, spatial, "inertia of the slider about Y") \
    row(slider_inertia_z, "mechanism.slider_inertia_z", follows, "kg m2", positive, slider, "inertia of the slider about Z") \
    row(crank_inertia, "mechanism.crank_inertia", follows, "kg m2", not_negative, turning, "inertia of the crank about its centre of mass")  /* J1: m_c r²/12 */ \
    row(crank_section, "mechanism.crank_section", 0.005 * 0.0025, "m2", positive, links, "area of the crank's section, from which its mass follows")  /* A_c: 5 × 2.5 mm */ \
    row(rod_section, "mechanism.rod_section", 0.0142 * 0.0071, "m2", positive, links, "area of the rod's section, from which its mass follows")  /* A_r: 14.2 × 7.1 mm */ \
    row(carriage_speed, "mechanism.carriage_speed", 0.06, "m/s", positive, carriage, "speed of the carriage")  /* v */ \
    row(stroke, "mechanism.stroke", 0.15, "m", positive, carriage, "distance that the carriage travels at constant speed") \
    row(reversal_time, "mechanism.reversal_time", 0.02, "s", positive, carriage, "time in which the carriage reverses its direction")  /* t_r */ \
    /* [drive] */ \
    row(drive_torque, "drive.torque", 0, "N m", any, drive, "torque of the motor at rest, or all along, times what its table says")  /* T0 */ \
    row(drive_no_load_speed, "drive.no_load_speed", 0, "rad/s", not_negative, drive, "no-load speed of the motor, at which its torque has fallen to 0; 0: it does not fall")  /* ω0 */ \
    row(drive_viscous, "drive.viscous", 0, "N m s/rad", not_negative, drive, "viscous friction of the drive's bearings")  /* c */ \
    row(drive_inertia, "drive.inertia", 0, "kg m2", not_negative, drive, "inertia of motor and flywheel, beside the crank's own") \
    row(drive_scale, "drive.scale", 1, "1", any, drive, "what the drive's profile is multiplied by") \
    /* [joint] */ \
    row(slider_length, "joint.slider_length", 0.04, "m", positive, slider, "length of the slider")  /* L_k */ \
    row(way_width, "joint.way_width", 0.02, "m", positive, spatial, "width of the way along Y")  /* w_a */ \
    row(way_depth, "joint.way_depth", 0.03, "m", positive, spatial, "depth of the way along Z")  /* w_b */ \
    row(thickness_y, "joint.thickness_y", follows, "m", positive, spatial, "thickness of material that a Y face compresses")  /* l_a: way_width */ \
    row(thickness_z, "joint.thickness_z", follows, "m", positive, spatial, "thickness of material that a Z face compresses")  /* l_b: way_depth */ \
    row(clearance_y, "joint.clearance_y", 1e-4, "m", gap, slider, "clearance per side along Y")  /* c_a */ \
    row(clearance_z, "joint.clearance_z", 1e-4, "m", gap, spatial, "clearance per side along Z")  /* c_b */ \
    row(clearance_y_plus, "joint.clearance_y_plus", follows, "m", gap, spatial, "clearance of the face that the slider hangs on, where the faces differ")  /* c_+y */ \
    row(clearance_y_minus, "joint.clearance_y_minus", follows, "m", gap, spatial, "clearance of the face below") \
    row(clearance_z_plus, "joint.clearance_z_plus", follows, "m", gap, spatial, "clearance of the face on the side of +Z") \
    row(clearance_z_minus, "joint.clearance_z_minus", follows, "m", gap, spatial, "clearance of the face on the side of -Z") \
    row(slider_height, "joint.slider_height", 0.02, "m", positive, planar, "height of the planar slider")  /* 2b */ \
    row(slider_depth, "joint.slider_depth", 0.03, "m", positive, planar, "depth of the planar slider along Z, from which its mass follows")  /* d */ \
    row(wall, "joint.wall", 0, "m", not_negative, spatial, "thickness of the walls of a hollow slider, from which its mass follows; 0: a solid block of the way's section")  /* t */ \
    /* [slider] */ \
    row(mass_center_x, "slider.mass_center_x", 0, "m", any, body, "centre of mass of the slider from its hole's centre, along its X")  /* s_G */ \
    row(mass_center_y, "slider.mass_center_y", 0, "m", any, body, "centre of mass of the slider from its hole's centre, along its Y") \
    row(mass_center_z, "slider.mass_center_z", 0, "m", any, body, "centre of mass of the slider from its hole's centre, along its Z") \
    row(pin_x, "slider.pin_x", 0, "m", any, pin, "pin at which the slider is moved from its hole's centre, along its X")  /* s_P */ \
    row(pin_y, "slider.pin_y", 0, "m", any, pin, "pin at which the slider is moved from its hole's centre, along its Y") \
    row(pin_z, "slider.pin_z", 0, "m", any, pin, "pin at which the slider is moved from its hole's centre, along its Z") \
    /* [material] */ \
    row(density, "material.density", 7800, "kg/m3", positive, slider, "density of all bodies, from which masses follow")  /* ρ */ \
    /* [way] */ \
    row(way_offset_y, "way.offset_y", 0, "m", any, spatial, "offset of the way along Y")  /* u_l */ \
    row(way_offset_z, "way.offset_z", 0, "m", any, spatial, "offset of the way along Z") \
    row(way_roll, "way.roll", 0, "rad", any, spatial, "roll of the way")  /* A_l */ \
    row(way_yaw, "way.yaw", 0, "rad", any, spatial, "yaw of the way") \
    row(way_pitch, "way.pitch", 0, "rad", any, spatial, "pitch of the way") \
    /* [contact] */ \
    row(slider_young_modulus, "contact.slider_young_modulus", 2.07e11, "Pa", positive, elastic, "modulus of the slider")  /* E1 */ \
    row(way_young_modulus, "contact.way_young_modulus", 2.07e11, "Pa", positive, elastic, "modulus of the way")  /* E2 */ \
    row(slider_poisson_ratio, "contact.slider_poisson_ratio", 0.29, "1", poisson_ratio, hertz, "Poisson's ratio of the slider")  /* ν1 */ \
    row(way_poisson_ratio, "contact.way_poisson_ratio", 0.29, "1", poisson_ratio, hertz, "Poisson's ratio of the way")  /* ν2 */ \
    row(edge_radius, "contact.edge_radius", 5e-4, "m", positive, edges, "edge radius of line contacts")  /* R_e */ \
    row(apex_radius, "contact.apex_radius", 5e-4, "m", positive, hertz, "apex radius of point contacts")  /* R_p */ \
    row(point_stiffness, "contact.point_stiffness", follows, "1", positive, hertz, "stiffness of point contacts [N/m^n, n the Hertz exponent]")  /* K: 4/3 E* √R_p */ \
    row(hertz_exponent, "contact.hertz_exponent", 1.5, "1", hertz_exponent, hertz, "Hertz exponent of point contacts")  /* n */ \
    row(eta, "contact.eta", 0.01, "1", not_negative, point_damping, "damping ratio of point contacts")  /* η, C = ηK numerically */ \
    row(chi_line, "contact.chi_line", 0, "s/m", not_negative, edges, "dissipation of line contacts")  /* χ */ \
    row(chi_surface, "contact.chi_surface", 0, "s/m", not_negative, surfaces, "dissipation of surface contacts") \
    row(restitution, "contact.restitution", 1, "1", unit_interval, restitution, "coefficient of restitution of isolated impacts")  /* e */ \
    /* [friction] */ \
    row(friction_static, "friction.static", 0.15, "1", not_negative, slider, "static friction coefficient")  /* μs */ \
    row(friction_kinetic, "friction.kinetic", 0.10, "1", not_negative, slider, "kinetic friction coefficient")  /* μd */ \
    row(friction_stick_speed, "friction.stick_speed", 1e-3, "m/s", positive, smooth_friction, "sliding speed at which friction is largest: the static coefficient")  /* Vs */ \
    row(friction_slip_speed, "friction.slip_speed", 1e-2, "m/s", positive, smooth_friction, "sliding speed from which the kinetic coefficient holds")  /* Vd */ \
    /* [initial] */ \
    row(y, "initial.y", 0, "m", any, slider, "vertical position at the start") \
    row(z, "initial.z", 0, "m", any, spatial, "lateral position at the start") \
    row(vy, "initial.vy", 0, "m/s", any, slider, "vertical velocity at the start") \
    row(vz, "initial.vz", 0, "m/s", any, spatial, "lateral velocity at the start") \
    row(roll, "initial.roll", 0, "rad", any, spatial, "roll at the start")  /* φ ϑ ψ */ \
    row(yaw, "initial.yaw", 0, "rad", any, spatial, "yaw at the start") \
    row(pitch, "initial.pitch", 0, "rad", any, slider, "pitch at the start") \
    row(wx, "initial.wx", 0, "rad/s", any, spatial, "angular velocity about the slider's X at the start")  /* ω in the slider's frame */ \
    row(wy, "initial.wy", 0, "rad/s", any, spatial, "angular velocity about the slider's Y at the start") \
    row(wz, "initial.wz", 0, "rad/s", any, slider, "angular velocity about the slider's Z at the start") \
    row(x, "initial.x", 0, "m", any, along, "position along the way at the start") \
    row(vx, "initial.vx", 0, "m/s", any, along, "velocity along the way at the start")
// clang-format on

// Numbers of their own that a law and a mechanism may have, under the keys that their info names: law_a … law_p, mechanism_a … mechanism_p.
#define SLIDEWAY_OWN_NUMBERS(row) row(a) row(b) row(c) row(d) row(e) row(f) row(g) row(h) row(i) row(j) row(k) row(l) row(m) row(n) row(o) row(p)

// Those of the scene's loads: load_a … load_z.
#define SLIDEWAY_LOAD_NUMBERS(row) SLIDEWAY_OWN_NUMBERS(row) row(q) row(r) row(s) row(t) row(u) row(v) row(w) row(x) row(y) row(z)

// And those of the bodies and joints of a linkage: linkage_0 … linkage_95.
#define SLIDEWAY_TEN_NUMBERS(row, ten) \
    row(ten##0) row(ten##1) row(ten##2) row(ten##3) row(ten##4) row(ten##5) row(ten##6) row(ten##7) row(ten##8) row(ten##9)
#define SLIDEWAY_LINKAGE_NUMBERS(row) \
    row(0) row(1) row(2) row(3) row(4) row(5) row(6) row(7) row(8) row(9) SLIDEWAY_TEN_NUMBERS(row, 1) SLIDEWAY_TEN_NUMBERS(row, 2) \
    SLIDEWAY_TEN_NUMBERS(row, 3) SLIDEWAY_TEN_NUMBERS(row, 4) SLIDEWAY_TEN_NUMBERS(row, 5) SLIDEWAY_TEN_NUMBERS(row, 6) SLIDEWAY_TEN_NUMBERS(row, 7) \
    SLIDEWAY_TEN_NUMBERS(row, 8) row(90) row(91) row(92) row(93) row(94) row(95)

struct Inputs {
#define SLIDEWAY_MEMBER(member, key, preset, unit, rule, group, meaning) double member = preset;
    SLIDEWAY_INPUTS(SLIDEWAY_MEMBER)
#undef SLIDEWAY_MEMBER
    double profile_speed = follows;  // no key: what the profile of a drive begins with, where there is one [rad/s]
    // 0 where there are fewer.
    // Of a linkage mechanism_a … are the state that it starts in, where mechanism_a is a number.
#define SLIDEWAY_MEMBER(letter) double law_##letter = 0, mechanism_##letter = 0;
    SLIDEWAY_OWN_NUMBERS(SLIDEWAY_MEMBER)
#undef SLIDEWAY_MEMBER
#define SLIDEWAY_MEMBER(letter) double load_##letter = 0;
    SLIDEWAY_LOAD_NUMBERS(SLIDEWAY_MEMBER)
#undef SLIDEWAY_MEMBER
#define SLIDEWAY_MEMBER(number) double linkage_##number = 0;
    SLIDEWAY_LINKAGE_NUMBERS(SLIDEWAY_MEMBER)
#undef SLIDEWAY_MEMBER
};

/// Of a face: its own clearance, or the one of its axis [m].
constexpr double face_clearance(double own, double common) { return own == own ? own : common; }
constexpr double mean_clearance_y(Inputs const& in) {
    return 0.5 * (face_clearance(in.clearance_y_plus, in.clearance_y) + face_clearance(in.clearance_y_minus, in.clearance_y));
}
constexpr double mean_clearance_z(Inputs const& in) {
    return 0.5 * (face_clearance(in.clearance_z_plus, in.clearance_z) + face_clearance(in.clearance_z_minus, in.clearance_z));
}
/// What movements in the joint are measured by [m]: its clearance, or with a preload by how far the slider is pressed into its way.
constexpr double play(double clearance) {
    constexpr double least = 1e-7;  // of a slider that just fits
    double const size = clearance < 0 ? -clearance : clearance;
    return size > least ? size : least;
}
constexpr double play_y(Inputs const& in) { return play(mean_clearance_y(in)); }
constexpr double play_z(Inputs const& in) { return play(mean_clearance_z(in)); }
/// From the way's axis to the middle between its faces [m]: a slider there has the mean clearance to both.
constexpr double to_middle_y(Inputs const& in) {
    return 0.5 * (face_clearance(in.clearance_y_minus, in.clearance_y) - face_clearance(in.clearance_y_plus, in.clearance_y));
}
constexpr double to_middle_z(Inputs const& in) {
    return 0.5 * (face_clearance(in.clearance_z_minus, in.clearance_z) - face_clearance(in.clearance_z_plus, in.clearance_z));
}

/// Of a crank [rad/s].
constexpr double start_speed(Inputs const& in) { return in.profile_speed == in.profile_speed ? in.drive_scale * in.profile_speed : in.crank_speed; }

constexpr double Key::get(Inputs const& inputs) const { return inputs.*member; }
constexpr void Key::set(Inputs& inputs, double value) const {
    inputs.*member = value;
    if (twin != nullptr) inputs.*twin = value;
}

inline constexpr Key input_keys[] = {
#define SLIDEWAY_KEY(member, key, preset, unit, rule, group, meaning) \
    {key, &Inputs::member, unit, Rule::rule, KeyGroup::group, meaning, preset},
    SLIDEWAY_INPUTS(SLIDEWAY_KEY)
#undef SLIDEWAY_KEY
};

/// Where a law and a mechanism may have their own, a scene its loads, and a linkage its bodies and joints.  Each unit has its own copy: indexed at run
/// time, one copy for all would be of any instruction set's unit.
static constexpr double Inputs::*law_inputs[] = {
#define SLIDEWAY_PLACE(letter) &Inputs::law_##letter,
    SLIDEWAY_OWN_NUMBERS(SLIDEWAY_PLACE)
#undef SLIDEWAY_PLACE
};
static constexpr double Inputs::*mechanism_inputs[] = {
#define SLIDEWAY_PLACE(letter) &Inputs::mechanism_##letter,
    SLIDEWAY_OWN_NUMBERS(SLIDEWAY_PLACE)
#undef SLIDEWAY_PLACE
};
static constexpr double Inputs::*load_inputs[] = {
#define SLIDEWAY_PLACE(letter) &Inputs::load_##letter,
    SLIDEWAY_LOAD_NUMBERS(SLIDEWAY_PLACE)
#undef SLIDEWAY_PLACE
};
static_assert(sizeof(load_inputs) / sizeof(load_inputs[0]) == most_load_numbers);
static constexpr double Inputs::*linkage_inputs[] = {
#define SLIDEWAY_PLACE(number) &Inputs::linkage_##number,
    SLIDEWAY_LINKAGE_NUMBERS(SLIDEWAY_PLACE)
#undef SLIDEWAY_PLACE
};
static_assert(sizeof(linkage_inputs) / sizeof(linkage_inputs[0]) == most_linkage_numbers);
inline constexpr int most_own_numbers = sizeof(law_inputs) / sizeof(law_inputs[0]);

}  // namespace slideway
