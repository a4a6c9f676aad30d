#pragma once

#include <cmath>

#include "kernels/inputs.hpp"
#include "kernels/joint/joint.hpp"
#include "kernels/laws/restitution.hpp"
#include "kernels/mechanisms/motor.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// All numbers that the kernels of a mechanism with one slider in a clearance joint need of a member (or a pack), derived once from its
/// inputs.
template <class Real> struct SliderParameters {
    // crank and rod
    Real crank_length;          // r [m]
    Real crank_speed;           // ω [rad/s]
    Real start_angle;           // θ0 [rad]
    Real rod_length;            // L [m]
    Real m_aa, m_ab;            // rod's mass matrix between its ends [kg]
    Real mass;                  // m = M + m_BB [kg]
    Real gravity_x, gravity_y, gravity_z;  // g⃗ [m/s²]
    Real weighing_mass;         // M + m_r f_r: whose weight acts on B [kg]
    // carriage
    Real carriage_speed;  // v [m/s]
    Real stroke_time;     // T_s = stroke/v [s]
    Real reversal_time;   // t_r [s]
    Real stroke_rate;     // 1/(T_s + t_r) [1/s]
    Real reversal_rate;   // π/t_r [1/s]
    // slider
    Real slider_mass;    // M [kg]
    Vec3<Real> inertia;  // I [kg m²]
    Vec3<Real> inverse_inertia;
    JointParameters<Real> joint;
    Vec3<Real> mass_center, pin;  // s_G, s_P from the hole's centre, along the slider's axes [m]
    Real load[most_load_numbers];  // numbers of the scene's loads
    DriveNumbers<Real> motor;   // and of its drive
    // energy and torque only
    Real rod_mass;         // m_r [kg]
    Real rod_mass_center;  // f_r
    Real rod_spin_mass;    // J/L² [kg]
    Real crank_moment;     // m_c r/2 [kg m]
    // scales of the error control
    Real length_scale_y, length_scale_z;  // clearances, or preloads [m]
    Real tilt_scale;                      // 2c/L_k [rad]
    Real rate_scale;                      // |ω|, of whatever repeats itself, at least 1 [1/s]
};

/// K δⁿ + C δ δ' with C = η K.  Source: model.md 2.
SLIDEWAY_FN PointContact<double> point_contact(Inputs const& in) {
    return {in.point_stiffness, in.hertz_exponent, in.eta * in.point_stiffness, 1 / (in.hertz_exponent + 1)};
}

SLIDEWAY_FN FrictionParameters<double> friction_parameters(Inputs const& in) {
    double const pi = 3.14159265358979323846;
    return {in.friction_static,
            in.friction_kinetic,
            in.friction_stick_speed,
            in.friction_slip_speed,
            pi / (2 * in.friction_stick_speed),
            pi / (in.friction_slip_speed - in.friction_stick_speed)};
}

/// Inputs::load_a …
SLIDEWAY_FN void put_load_numbers(Inputs const& in, double (&numbers)[most_load_numbers]) {
    int i = 0;
#define SLIDEWAY_NUMBER(letter) numbers[i++] = in.load_##letter;
    SLIDEWAY_LOAD_NUMBERS(SLIDEWAY_NUMBER)
#undef SLIDEWAY_NUMBER
}

namespace detail {

SLIDEWAY_FN LineContact<double> line_contact(double reduced_modulus, double edge_radius, double length) {
    return {3.14159265358979323846 * reduced_modulus * length, edge_radius / (length * length)};
}

/// A_l, built like A_k from roll, yaw and pitch.
SLIDEWAY_FN WayParameters<double> way_parameters(Inputs const& in) {
    auto const e = axes(attitude(in.way_roll, in.way_yaw, in.way_pitch));
    // The columns of A_l are the way's axes in the inertial frame.  Faces with clearances of their own lie about another middle.
    auto const middle = to_middle_y(in) * e.y + to_middle_z(in) * e.z;
    return {Vec3<double>{in.rod_length, in.way_offset_y, in.way_offset_z} + middle, e.x, e.y, e.z, in.rod_length};
}

}  // namespace detail

/// Source: model.md 2–6.  @param in complete inputs (nothing `follows`), SI.
SLIDEWAY_FN SliderParameters<double> slider_parameters(Inputs const& in) {
    SliderParameters<double> p;
    double const length = in.rod_length, center = in.rod_mass_center;
    double const spin_mass = in.rod_inertia / (length * length);
    double const m_bb = in.rod_mass * center * center + spin_mass;
    p.crank_length = in.crank_length;
    p.crank_speed = in.crank_speed;
    p.start_angle = in.start_angle;
    p.rod_length = length;
    p.m_aa = in.rod_mass * (1 - center) * (1 - center) + spin_mass;
    p.m_ab = in.rod_mass * center * (1 - center) - spin_mass;
    p.mass = in.slider_mass + m_bb;
    auto const slope = sincos(in.inclination), across = sincos(in.cross_inclination);
    p.gravity_x = -in.gravity * slope.sin;
    p.gravity_y = -in.gravity * slope.cos * across.cos;
    p.gravity_z = -in.gravity * slope.cos * across.sin;
    p.weighing_mass = in.slider_mass + in.rod_mass * center;
    p.carriage_speed = in.carriage_speed;
    p.stroke_time = in.stroke / in.carriage_speed;
    p.reversal_time = in.reversal_time;
    p.stroke_rate = 1 / (p.stroke_time + in.reversal_time);
    p.reversal_rate = 3.14159265358979323846 / in.reversal_time;
    p.slider_mass = in.slider_mass;
    p.inertia = {in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z};
    p.inverse_inertia = {1 / in.slider_inertia_x, 1 / in.slider_inertia_y, 1 / in.slider_inertia_z};

    p.mass_center = {in.mass_center_x, in.mass_center_y, in.mass_center_z};
    p.pin = {in.pin_x, in.pin_y, in.pin_z};

    p.joint.geometry = {0.5 * in.slider_length, 0.5 * in.way_width, 0.5 * in.way_depth, mean_clearance_y(in), mean_clearance_z(in)};
    p.joint.way = detail::way_parameters(in);

    double const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    double const e1 = in.slider_young_modulus, e2 = in.way_young_modulus;
    double const reduced = 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);  // E*
    double const series = 2 * e1 * e2 / (e1 + e2);                             // E_s
    auto& c = p.joint.contact;
    c.point = point_contact(in);
    c.damping = {in.chi_line, in.chi_surface, restitution_slope(in.restitution), in.restitution};
    c.along = detail::line_contact(reduced, in.edge_radius, in.slider_length);
    c.across_y_face = detail::line_contact(reduced, in.edge_radius, in.way_depth);
    c.across_z_face = detail::line_contact(reduced, in.edge_radius, in.way_width);
    c.surface_stiffness_y = series * in.slider_length * in.way_depth / in.thickness_y;
    c.surface_stiffness_z = series * in.slider_length * in.way_width / in.thickness_z;
    c.area_y = in.slider_length * in.way_depth;
    c.area_z = in.slider_length * in.way_width;
#define SLIDEWAY_NUMBER(letter) in.law_##letter,
    c.of_law = {SLIDEWAY_OWN_NUMBERS(SLIDEWAY_NUMBER)};
#undef SLIDEWAY_NUMBER

    p.joint.friction = friction_parameters(in);
    put_load_numbers(in, p.load);
    p.motor = drive_numbers(in);

    p.rod_mass = in.rod_mass;
    p.rod_mass_center = center;
    p.rod_spin_mass = spin_mass;
    p.crank_moment = 0.5 * in.crank_mass * in.crank_length;
    p.length_scale_y = play_y(in);
    p.length_scale_z = play_z(in);
    p.tilt_scale = 2 * min(p.length_scale_y, p.length_scale_z) / in.slider_length;
    p.rate_scale = drive_scale_rate(in);
    return p;
}

}  // namespace slideway::inline SLIDEWAY_ISA
