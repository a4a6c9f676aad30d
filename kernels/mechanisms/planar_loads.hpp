#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/planar_parameters.hpp"
#include "kernels/mechanisms/slider_loads.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What all loads on a planar slider-crank come to, as SliderLoads: of forces what lies in its plane, of torques those about Z.
template <class Real> struct PlanarLoads {
    Real x, y, torque;  // on the slider's centre and about it [N], [N m]
    Real crank_torque;  // [N m]
    Real power;         // of pushes [W]
    Real ground_power;  // of the ground's motion [W]
    Real spring_loss;   // of the dampers of springs and stops [W]
    Real potential;     // of springs and stops [J]

    SLIDEWAY_FN static PlanarLoads none() {
        Real const zero(0.0);
        return {zero, zero, zero, zero, zero, zero, zero, zero};
    }

    /// @param y, vy of the slider's centre  @param pitch, spin of the slider
    SLIDEWAY_NOINLINE static PlanarLoads of(LoadList const& list, LoadArguments<Real> const& arguments, Real y, Real vy, Real pitch, Real spin,
                                            PlanarParameters<Real> const& p) {
        auto const tilt = sincos(pitch);
        auto sum = none();
        for (int i = 0; i < list.count; ++i) {
            Load const& load = list.loads[i];
            LoadNumbers<Real> const numbers(load, p.load, arguments);
            if (load.kind == LoadKind::ground_motion) {
                sum.add_ground(numbers.scaled(load.force), arguments, vy, p);
                continue;
            }
            auto const point = numbers.as_given(load.point);
            Vec3<Real> const arm{fms(tilt.cos, point.x, tilt.sin * point.y), fma(tilt.sin, point.x, tilt.cos * point.y), Real(0.0)};
            if (load.kind == LoadKind::push) sum.add_push(load, numbers, arguments, tilt, arm, vy, spin);
            else sum.add_element(load, numbers, {arguments.x, y, Real(0.0)}, {arguments.vx, vy, Real(0.0)}, arm, spin);
        }
        return sum;
    }

private:
    SLIDEWAY_FN static Real moment_of(Vec3<Real> const& force, Vec3<Real> const& arm) { return fms(arm.x, force.y, arm.y * force.x); }
    SLIDEWAY_FN void add(Vec3<Real> const& force, Real moment) {
        x = x + force.x;
        y = y + force.y;
        torque = torque + moment;
    }

    SLIDEWAY_FN void add_push(Load const& load, LoadNumbers<Real> const& numbers, LoadArguments<Real> const& at, SinCos<Real> const& tilt,
                              Vec3<Real> const& arm, Real vy, Real spin) {
        auto force = numbers.scaled(load.force);
        if (load.turns_with_slider) force = {fms(tilt.cos, force.x, tilt.sin * force.y), fma(tilt.sin, force.x, tilt.cos * force.y), force.z};
        Real const moment = numbers.scaled(load.torque[2]) + moment_of(force, arm), on_crank = numbers.scaled(load.crank_torque);
        add(force, moment);
        crank_torque = crank_torque + on_crank;
        power = power + (fma(force.x, at.vx, force.y * vy) + fma(moment, spin, on_crank * at.crank_speed));
    }

    /// −a of the ground on all masses, as they weigh on the slider's centre and on the crank.
    SLIDEWAY_FN void add_ground(Vec3<Real> const& acceleration, LoadArguments<Real> const& at, Real vy, PlanarParameters<Real> const& p) {
        Real const mass = p.rod_moment / p.rod_length;
        auto const on_slider = negated(mass) * acceleration;
        auto const crank = sincos(at.crank_angle);
        Real const lever = fms(crank.sin, acceleration.x, crank.cos * acceleration.y), of_crank = fnma(mass, p.crank_length, p.crank_moment) * lever;
        add(on_slider, Real(0.0));
        crank_torque = crank_torque + of_crank;
        ground_power = ground_power + fma(of_crank, at.crank_speed, fma(on_slider.x, at.vx, on_slider.y * vy));
    }

    SLIDEWAY_FN void add_element(Load const& load, LoadNumbers<Real> const& numbers, Vec3<Real> const& centre, Vec3<Real> const& velocity,
                                 Vec3<Real> const& arm, Real spin) {
        Vec3<Real> const turning{negated(spin * arm.y), spin * arm.x, Real(0.0)};
        auto const element = ElementForce<Real>::of(load, numbers, centre + arm, velocity + turning);
        add(element.force, moment_of(element.force, arm));
        potential = potential + element.potential;
        spring_loss = spring_loss + element.loss;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
