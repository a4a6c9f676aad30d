#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/planar_loads.hpp"
#include "kernels/mechanisms/planar_parameters.hpp"
#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Angular accelerations of crank and rod, and what the equation of the crank lacks without them.
template <class Real> struct PlanarLinkMotion { Real a1, a2, r1, m12; };

/// Angle, speed and given acceleration of a crank whose angle and speed are in the state.
template <class Real, class Parameters>
SLIDEWAY_FN GivenMotion<Real> given_crank(DrivePlan const& drive, Real t, Real angle, Real speed, Parameters const& p) {
    if (drive.turns_freely()) return {angle, speed, Real(0.0)};
    if (drive.by != DriveBy::profile) return driven_crank(drive, t, p);
    // A state that is probed has the crank's angle at its own time.
    auto motion = profile_motion(*drive.table, t + p.start_time);
    if (any(p.start_time != Real(0.0))) motion.place = motion.place - profile_motion(*drive.table, p.start_time).place;
    return scaled(motion, p.motor.scale, p.start_angle);
}

/// Crank and rod, and their common end: the slider's centre.
template <class Real> struct PlanarLinks {
    Real w1, w2, given;  // given: the acceleration of a driven crank
    bool turns_freely;
    SinCos<Real> crank, rod;
    Real x1, y1, x2, y2;
    Real y, vx, vy;
    PlanarLoads<Real> loads;
    Real motor;  // torque on a crank that turns freely [N m]

    SLIDEWAY_FN PlanarLinks(Real t, Real const* s, PlanarParameters<Real> const& p, DrivePlan const& drive, LoadList const& list)
        : turns_freely(drive.turns_freely()) {
        auto const motion = given_crank(drive, t, s[0], s[3], p);
        w1 = motion.velocity;
        w2 = s[4];
        given = motion.acceleration;
        Real const angle = motion.place;
        motor = turns_freely ? motor_torque(drive, p.motor, t + p.start_time, angle, w1) : Real(0.0);
        crank = sincos(angle);
        rod = sincos(s[1]);
        x1 = p.crank_length * crank.cos;
        y1 = p.crank_length * crank.sin;
        x2 = p.rod_length * rod.cos;
        y2 = p.rod_length * rod.sin;
        y = y1 + y2;
        vx = negated(fma(y1, w1, y2 * w2));
        vy = fma(x1, w1, x2 * w2);
        loads = PlanarLoads<Real>::none();
        if (list.count > 0) loads = PlanarLoads<Real>::of(list, {angle, t + p.start_time, x1 + x2, vx, w1}, y, vy, s[2], s[5], p);
    }

    /// M(θ) θ'' = R: inertia of the links, gravity, loads, and the force of contacts on their common end.
    SLIDEWAY_FN PlanarLinkMotion<Real> accelerations(Real of_contact_x, Real of_contact_y, PlanarParameters<Real> const& p) const {
        Real const one(1.0);
        Real const cosine = fma(crank.cos, rod.cos, crank.sin * rod.sin);
        Real const sine = fms(crank.sin, rod.cos, crank.cos * rod.sin);
        Real const m12 = p.m12 * cosine, centrifugal = p.m12 * sine;
        Real const fx = of_contact_x + loads.x, fy = of_contact_y + loads.y;
        Real const pull_1 = fms(p.gravity_y, crank.cos, p.gravity_x * crank.sin);
        Real const pull_2 = fms(p.gravity_y, rod.cos, p.gravity_x * rod.sin);
        Real const r1 = fma(p.crank_moment, pull_1, fms(x1, fy, y1 * fx)) - centrifugal * (w2 * w2) + loads.crank_torque;
        Real const r2 = fma(p.rod_moment, pull_2, fms(x2, fy, y2 * fx)) + centrifugal * (w1 * w1);
        if (!turns_freely) return {given, fnma(m12, given, r2) / p.m22, r1, m12};
        Real const turning = r1 + motor, scale = one / fms(p.m11, p.m22, m12 * m12);
        return {fms(p.m22, turning, m12 * r2) * scale, fms(p.m11, r2, m12 * turning) * scale, r1, m12};
    }

    /// What an impulse on their common end changes their rates by.
    SLIDEWAY_FN PlanarLinkMotion<Real> response(Real fx, Real fy, PlanarParameters<Real> const& p) const {
        Real const zero(0.0), one(1.0);
        Real const m12 = p.m12 * fma(crank.cos, rod.cos, crank.sin * rod.sin);
        Real const r1 = fms(x1, fy, y1 * fx), r2 = fms(x2, fy, y2 * fx);
        if (!turns_freely) return {zero, r2 / p.m22, r1, m12};
        Real const scale = one / fms(p.m11, p.m22, m12 * m12);
        return {fms(p.m22, r1, m12 * r2) * scale, fms(p.m11, r2, m12 * r1) * scale, r1, m12};
    }

    /// Other rates at the same place.
    SLIDEWAY_FN void turn_at(Real first, Real second) {
        w1 = first;
        w2 = second;
        vx = negated(fma(y1, w1, y2 * w2));
        vy = fma(x1, w1, x2 * w2);
    }

    /// Of the slider's centre.
    SLIDEWAY_FN Vec3<Real> centre_acceleration(PlanarLinkMotion<Real> const& m) const {
        return {negated(fma(x1, w1 * w1, fma(y1, m.a1, fma(x2, w2 * w2, y2 * m.a2)))),
                fma(x1, m.a1, fma(x2, m.a2, negated(fma(y1, w1 * w1, y2 * (w2 * w2))))), Real(0.0)};
    }

    template <class Report>
    SLIDEWAY_FN void tell(PlanarLinkMotion<Real> const& motion, Real w3, PlanarParameters<Real> const& p, Report& report) const {
        Real const zero(0.0), half(0.5);
        report.x = x1 + x2;
        report.y = y;
        report.vx = vx;
        report.vy = vy;
        report.acceleration = centre_acceleration(motion);
        report.top = report.front = zero;  // sensors that it has not
        Real const drive = turns_freely ? motor : fma(p.m11, given, fms(motion.m12, motion.a2, motion.r1));
        report.crank_torque = report.drive_torque = drive;  // the crank's weight is in the equations
        report.crank_power = drive * w1;
        report.load_power = loads.power;
        report.ground_power = loads.ground_power;
        report.spring_loss = loads.spring_loss;
        report.spring_potential = loads.potential;
        Real const kinetic = half * fma(p.m11 * w1, w1, fma(p.m22 * w2, w2, p.slider_inertia * w3 * w3));
        Real const height = fma(p.crank_moment, fma(p.gravity_x, crank.cos, p.gravity_y * crank.sin),
                                p.rod_moment * fma(p.gravity_x, rod.cos, p.gravity_y * rod.sin));
        report.energy = (fma(motion.m12 * w1, w2, kinetic) - height) + (report.contact.potential + loads.potential);
        report.position_error = report.distance_error(x2, y1, y, p.rod_length);
        report.rod_spin = abs(w2);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
