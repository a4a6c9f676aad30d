#pragma once

#include "kernels/loads/load_list.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What loads are read over in a state.
template <class Real> struct LoadArguments {
    Real crank_angle, time, x, vx, crank_speed;

    SLIDEWAY_FN Real of(LoadArgument over) const {
        switch (over) {
            case LoadArgument::crank_angle: return crank_angle;
            case LoadArgument::x: return x;
            case LoadArgument::vx: return vx;
            case LoadArgument::crank_speed: return crank_speed;
            case LoadArgument::time:
            case LoadArgument::nothing: break;
        }
        return time;
    }
};

/// Numbers of a load in a state: those of the member, times what its table is there.
template <class Real> class LoadNumbers {
public:
    /// @param numbers of a member, Inputs::load_a …
    SLIDEWAY_FN LoadNumbers(Load const& load, Real const* numbers, LoadArguments<Real> const& arguments) : numbers_(numbers), factor_(Real(1.0)) {
        if (load.scale != Load::none) factor_ = numbers[load.scale];
        if (load.over != LoadArgument::nothing) factor_ = factor_ * table_value(load.table, arguments.of(load.over));
    }

    SLIDEWAY_FN Real scaled(int place) const { return place == Load::none ? Real(0.0) : factor_ * numbers_[place]; }
    SLIDEWAY_FN Vec3<Real> scaled(int const (&places)[3]) const { return {scaled(places[0]), scaled(places[1]), scaled(places[2])}; }
    SLIDEWAY_FN Vec3<Real> as_given(int const (&places)[3]) const { return {given(places[0]), given(places[1]), given(places[2])}; }

private:
    SLIDEWAY_FN Real given(int place) const { return place == Load::none ? Real(0.0) : numbers_[place]; }

    Real const* numbers_;
    Real factor_;
};

/// What all loads come to.  F acts on the slider at u + A p, with the torque (A p) × F about its centre, and does the work of F · (u' + ω × A p).
/// (model.md 14)
template <class Real> struct SliderLoads {
    Vec3<Real> force;   // on the slider, along the axes of the ground [N]
    Vec3<Real> torque;  // about its centre, along its own axes [N m]
    Real power;         // on slider and crank [W]
    Real crank_torque;  // on the crank [N m]
    Real crank_power;   // of that [W]

    SLIDEWAY_FN static SliderLoads none() {
        Real const zero(0.0);
        return {{zero, zero, zero}, {zero, zero, zero}, zero, zero, zero};
    }

    /// @param crank angle and speed of the crank  @param position, velocity of the slider's centre, along the axes of the ground
    SLIDEWAY_NOINLINE static SliderLoads of(LoadList const& list, Real t, GivenMotion<Real> const& crank, Vec3<Real> const& position, Vec3<Real> const& velocity,
                                            SliderTurning<Real> const& turning, SliderParameters<Real> const& p) {
        auto const& axes = turning.axes;
        auto const slider_velocity = to_slider(axes, velocity);
        LoadArguments<Real> const arguments{crank.place, t, position.x, velocity.x, crank.velocity};
        auto sum = none();
        for (int i = 0; i < list.count; ++i) {
            Load const& load = list.loads[i];
            LoadNumbers<Real> const numbers(load, p.load, arguments);
            auto force = numbers.scaled(load.force), torque = numbers.scaled(load.torque);
            auto const point = numbers.as_given(load.point);
            if (load.turns_with_slider) {
                sum.force = sum.force + from_slider(axes, force);
            } else {
                sum.force = sum.force + force;
                force = to_slider(axes, force), torque = to_slider(axes, torque);
            }
            torque = torque + cross(point, force);
            sum.torque = sum.torque + torque;
            sum.power = sum.power + (dot(force, slider_velocity) + dot(torque, turning.omega));
            sum.crank_torque = sum.crank_torque + numbers.scaled(load.crank_torque);
        }
        sum.crank_power = sum.crank_torque * crank.velocity;
        sum.power = sum.power + sum.crank_power;
        return sum;
    }

    /// What a report tells of them, once it has told the rest: torque on a driven crank is not the drive's.
    template <class Report> SLIDEWAY_FN void tell(DrivePlan const& drive, Report& report) const {
        report.load_power = power;
        if (drive.turns_freely()) return;
        report.crank_power = report.crank_power - crank_power;
        report.drive_torque = report.drive_torque - crank_torque;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
