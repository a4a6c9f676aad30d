#pragma once

#include <cmath>

#include "kernels/inputs.hpp"
#include "kernels/laws/damping.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/laws/restitution.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// All numbers that the planar slider-crank's kernels need of one member (or one pack), derived once from its inputs.
template <class Real> struct PlanarParameters {
    Real crank_length, rod_length;  // l1, l2 [m]
    Real crank_speed, start_angle;  // of a driven crank [rad/s], [rad]
    Real start_time;                // of the start, for loads over time; not 0 where a state is probed [s]
    // mass matrix of (θ1, θ2): [m11, m12 cos(θ1−θ2); ·, m22] [kg m²]
    Real m11, m22, m12;
    Real slider_inertia;            // J3 [kg m²]
    Real crank_moment, rod_moment;  // what gravity pulls at: (m1/2 + m2 + m3) l1 and (m2/2 + m3) l2 [kg m]
    Real gravity_x, gravity_y;      // g⃗ [m/s²]
    Real slider_mass;               // m3 [kg]
    Real half_length, half_height;  // a, b of the block [m]
    Real clearance;                 // c, per side [m]
    PointContact<Real> point;
    DampingParameters<Real> damping;
    FrictionParameters<Real> friction;
    Real load[most_load_numbers];  // numbers of the scene's loads
    DriveNumbers<Real> motor;   // and of its drive
    Real rate_scale;   // |ω|, at least 1 [1/s]
    Real restitution;  // e
};

/// Source: model.md 7, after Flores, Leine & Glocker (2010).  @param in complete inputs (nothing `follows`), SI.
SLIDEWAY_FN PlanarParameters<double> planar_parameters(Inputs const& in) {
    PlanarParameters<double> p;
    double const l1 = in.crank_length, l2 = in.rod_length;
    double const m1 = in.crank_mass, m2 = in.rod_mass, m3 = in.slider_mass;
    p.crank_length = l1;
    p.rod_length = l2;
    p.crank_speed = in.crank_speed;
    p.start_angle = in.start_angle;
    p.start_time = 0;
    p.m11 = in.crank_inertia + (0.25 * m1 + m2 + m3) * l1 * l1 + in.drive_inertia;
    p.m22 = in.rod_inertia + (0.25 * m2 + m3) * l2 * l2;
    p.m12 = (0.5 * m2 + m3) * l1 * l2;
    p.slider_inertia = in.slider_inertia_z;
    p.crank_moment = (0.5 * m1 + m2 + m3) * l1;
    p.rod_moment = (0.5 * m2 + m3) * l2;
    auto const slope = sincos(in.inclination);
    p.gravity_x = -in.gravity * slope.sin;
    p.gravity_y = -in.gravity * slope.cos;
    p.slider_mass = m3;
    p.half_length = 0.5 * in.slider_length;
    p.half_height = 0.5 * in.slider_height;
    p.clearance = in.clearance_y;
    p.point = point_contact(in);
    p.damping = {0, 0, restitution_slope(in.restitution), in.restitution};
    p.friction = friction_parameters(in);
    put_load_numbers(in, p.load);
    p.motor = drive_numbers(in);
    p.rate_scale = drive_scale_rate(in);
    p.restitution = in.restitution;
    return p;
}

}  // namespace slideway::inline SLIDEWAY_ISA
