#pragma once

#include <cmath>

#include "kernels/inputs.hpp"
#include "kernels/laws/damping.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/laws/restitution.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec2.hpp"
#include "kernels/mechanisms/motor.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// All numbers that a linkage's kernels need of one member (or one pack), derived once from its inputs.
template <class Real> struct LinkageParameters {
    /// Of a body, from its joint's point on, along its own axes; of one that floats from its mass centre on.
    struct Body {
        Real mass, inertia;      // its own, about its mass centre [kg], [kg m²]
        Vec2<Real> center;       // c [m]
        Real hung_mass;          // m̂, of all that hangs on it too [kg]
        Vec2<Real> hung_moment;  // ê = m c + Σ m̂_k a_k of those that hang on it by revolutes [kg m]
        Real hung_inertia;       // Î = I + m c² + Σ m̂_k a_k² [kg m²]
        Vec2<Real> at;           // a: the joint's point on the body below, from that one's [m]
        Vec2<Real> along;        // u: a prismatic joint's line, in the axes of the body below
        Real reach;              // largest distance of a point that it carries [m]
        Real angle, speed;       // near which it starts
        Vec2<Real> origin;       // where its axes begin for the kernels, in those of the scene [m]
        Real turn;               // and how far the latter are turned against them: a prismatic joint's body has those of the body below [rad]
    };
    struct Closure {
        Vec2<Real> point[2];      // on either body [m]
        Vec2<Real> offset;        // at the start
        Real clearance, journal;  // c, and the journal's radius [m]
        Real half_length, half_height;  // of a block [m]
        Real direction;           // of walls, against their body's X axis [rad]
        Vec2<Real> along;         // and along them
        PointContact<Real> contact;
    };

    /// Of a load, spring or stop.
    struct Load {
        Vec2<Real> point[2];   // on the body, and on what holds it [m]
        Vec2<Real> force;      // [N]
        Real torque, scale;    // [N m], and what both are multiplied by
        Real rest;             // length, displacement or angle at which a spring has its preload and a stop is touched
        Real stiffness, damping, preload, dissipation;
    };

    Body body[LinkagePlan::most_bodies];
    Closure closure[LinkagePlan::most_closures];
    Load load[LinkagePlan::most_loads];
    Vec2<Real> gravity;             // g⃗ [m/s²]
    Real crank_speed, start_angle;  // of a driven crank [rad/s], [rad]
    Real start_time;                // of the start; not 0 where a state is probed [s]
    DriveNumbers<Real> motor;
    DampingParameters<Real> damping;
    FrictionParameters<Real> friction;
    Real play;        // the least clearance; where there is none, as `reach` [m]
    Real reach;       // of the largest body [m]
    Real mass;        // of all bodies [kg]
    Real flywheel;    // inertia of what the drive turns beside its body [kg m²]
    Real rate_scale;  // |ω|, at least 1 [1/s]
};

/// K of a sphere of the journal's radius in a hollow one of the bearing's, R_p = R_A R_B/c in (M2.3).  Source: Lankarani and Nikravesh (1990).
SLIDEWAY_FN double sphere_stiffness(Inputs const& in, double journal, double bearing) {
    double const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    double const reduced = 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
    return 4.0 / 3.0 * reduced * ::sqrt(journal * bearing / (bearing - journal));
}

namespace detail {

SLIDEWAY_HD inline Vec2<double> turned(Vec2<double> v, double angle) {
    return angle == 0 ? v : slideway::turned(sincos(angle), v);
}
SLIDEWAY_HD inline double length(Vec2<double> v) { return ::sqrt(v.x * v.x + v.y * v.y); }

}  // namespace detail

/// Source: docs/explanation/linkages.md.  @param in complete inputs (nothing `follows`), SI.
SLIDEWAY_HD inline LinkageParameters<double> linkage_parameters(LinkagePlan const& plan, Inputs const& in) {
    using detail::turned, detail::length;
    LinkageParameters<double> p{};
    auto const number = [&](int place) { return place == LinkageBody::none ? 0.0 : in.*linkage_inputs[place]; };
    auto const point = [&](int const (&places)[2]) { return Vec2<double>{number(places[0]), number(places[1])}; };
    auto const turn = [&](int body) { return body == LinkageBody::ground ? 0 : p.body[body].turn; };
    auto const local = [&](int body, Vec2<double> at) { return body == LinkageBody::ground ? at : turned(at - p.body[body].origin, turn(body)); };
    auto const reach = [&](int body, Vec2<double> at) {
        if (body != LinkageBody::ground) p.body[body].reach = max(p.body[body].reach, length(at));
    };
    for (int i = 0; i < plan.bodies; ++i) {
        LinkageBody const& of = plan.body[i];
        auto& body = p.body[i];
        bool const slides = of.joint == TreeJoint::prismatic;
        body.origin = of.joint == TreeJoint::floating ? point(of.center) : point(of.own);
        body.turn = slides ? number(of.turn) + turn(of.parent) : 0;
        body.mass = number(of.mass);
        body.inertia = number(of.inertia);
        body.center = local(i, point(of.center));
        body.at = local(of.parent, point(of.on_parent));
        auto const direction = sincos(number(of.direction) + turn(of.parent));
        body.along = {direction.cos, direction.sin};
        body.angle = number(of.angle);
        body.speed = number(of.speed);
        reach(i, body.center);
        reach(of.parent, body.at);
        p.mass += body.mass;
    }
    for (int i = 0; i < plan.bodies; ++i) {
        auto& body = p.body[i];
        auto const [x, y] = body.center;
        body.hung_mass = body.mass;
        body.hung_moment = {body.mass * x, body.mass * y};
        body.hung_inertia = body.inertia + body.mass * (x * x + y * y);
    }
    p.motor = drive_numbers(in);
    p.flywheel = plan.is_driven ? in.drive_inertia : 0;
    if (plan.is_driven) p.body[0].hung_inertia += p.flywheel;
    for (int i = plan.bodies - 1; i >= 0; --i) {
        LinkageBody const& of = plan.body[i];
        auto const& body = p.body[i];
        if (of.parent == LinkageBody::ground) continue;
        auto& below = p.body[of.parent];
        below.hung_mass += body.hung_mass;
        if (of.joint != TreeJoint::revolute) continue;
        auto const [x, y] = body.at;
        below.hung_moment.x += body.hung_mass * x;
        below.hung_moment.y += body.hung_mass * y;
        below.hung_inertia += body.hung_mass * (x * x + y * y);
    }
    p.play = 1e300;
    for (int i = 0; i < plan.closures; ++i) {
        LinkageClosure const& of = plan.closure[i];
        auto& closure = p.closure[i];
        for (int side = 0; side < 2; ++side) {
            closure.point[side] = local(of.body[side], point(of.point[side]));
            reach(of.body[side], closure.point[side]);
        }
        closure.offset = point(of.offset);
        double const bearing = number(of.radius);
        closure.clearance = number(of.clearance);
        closure.journal = bearing - closure.clearance;
        closure.half_length = 0.5 * number(of.length);
        closure.half_height = 0.5 * number(of.height);
        closure.direction = number(of.direction) + turn(of.body[1]);
        auto const walls = sincos(closure.direction);
        closure.along = {walls.cos, walls.sin};
        closure.direction -= turn(of.body[0]);
        closure.contact = point_contact(in);
        if (of.kind == ClosureKind::journal) closure.contact.stiffness = sphere_stiffness(in, closure.journal, bearing);
        if (of.stiffness != LinkageBody::none) closure.contact.stiffness = number(of.stiffness);
        closure.contact.damping = in.eta * closure.contact.stiffness;
        if (of.kind == ClosureKind::block) reach(of.body[0], {closure.half_length, closure.half_height});
        if (of.has_clearance()) p.play = min(p.play, closure.clearance);
    }
    double largest = 0;
    for (int i = 0; i < plan.bodies; ++i) largest = max(largest, p.body[i].reach);
    for (int i = 0; i < plan.bodies; ++i) {
        if (p.body[i].reach == 0) p.body[i].reach = largest > 0 ? largest : 1;
    }
    p.reach = largest > 0 ? largest : 1;
    if (p.play == 1e300) p.play = p.reach;
    auto const slope = sincos(in.inclination);
    p.gravity = {-in.gravity * slope.sin, -in.gravity * slope.cos};
    p.crank_speed = in.crank_speed;
    p.start_angle = in.start_angle;
    p.damping = {0, 0, restitution_slope(in.restitution), in.restitution};
    p.friction = friction_parameters(in);
    p.rate_scale = plan.is_driven ? drive_scale_rate(in) : 1;
    for (int i = 0; i < plan.bodies; ++i) {
        if (plan.body[i].joint != TreeJoint::prismatic) p.rate_scale = max(p.rate_scale, ::fabs(p.body[i].speed));
    }
    // What falls counts its speeds by the fall through its own size.
    if (!plan.is_driven && largest > 0) p.rate_scale = max(p.rate_scale, ::sqrt(::fabs(in.gravity) / largest));
    return p;
}

}  // namespace slideway::inline SLIDEWAY_ISA
