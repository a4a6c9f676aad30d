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
    Real power;         // of all of them [W]

    SLIDEWAY_FN static PlanarLoads none() { return {Real(0.0), Real(0.0), Real(0.0), Real(0.0), Real(0.0)}; }

    /// @param vy of the slider's centre  @param pitch, spin of the slider
    SLIDEWAY_NOINLINE static PlanarLoads of(LoadList const& list, LoadArguments<Real> const& arguments, Real vy, Real pitch, Real spin,
                                            PlanarParameters<Real> const& p) {
        auto const tilt = sincos(pitch);
        auto sum = none();
        for (int i = 0; i < list.count; ++i) {
            Load const& load = list.loads[i];
            LoadNumbers<Real> const numbers(load, p.load, arguments);
            auto force = numbers.scaled(load.force);
            auto const point = numbers.as_given(load.point);
            if (load.turns_with_slider) force = {fms(tilt.cos, force.x, tilt.sin * force.y), fma(tilt.sin, force.x, tilt.cos * force.y), force.z};
            Real const arm_x = fms(tilt.cos, point.x, tilt.sin * point.y), arm_y = fma(tilt.sin, point.x, tilt.cos * point.y);
            sum.x = sum.x + force.x;
            sum.y = sum.y + force.y;
            sum.torque = sum.torque + (numbers.scaled(load.torque[2]) + fms(arm_x, force.y, arm_y * force.x));
            sum.crank_torque = sum.crank_torque + numbers.scaled(load.crank_torque);
        }
        sum.power = fma(sum.x, arguments.vx, sum.y * vy) + fma(sum.torque, spin, sum.crank_torque * arguments.crank_speed);
        return sum;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
