#pragma once

#include "kernels/loads/element_force.hpp"
#include "kernels/loads/load_list.hpp"
#include "kernels/loads/load_numbers.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What all loads come to.  F acts on the slider at u + A p, with the torque (A p) × F about its centre, and does the work of F · (u' + ω × A p).
/// (model.md 14)
template <class Real> struct SliderLoads {
    Vec3<Real> force;   // on the slider, and on the rod's end there, along the axes of the ground [N]
    Vec3<Real> torque;  // about its centre, along its own axes [N m]
    Real power;         // of pushes on slider and crank [W]
    Real ground_power;  // of the ground's motion [W]
    Real spring_loss;   // of the dampers of springs and stops [W]
    Real potential;     // of springs and stops [J]
    Real crank_torque;  // on the crank: of pushes, and of the ground's motion by the rod's end there [N m]
    Real crank_power;   // of that [W]
    Real pin_torque;    // the latter alone
    Real crank_weight;  // torque of the ground's motion by the crank's own mass, whose weight is in no energy of a driven crank either [N m]
    Real weight_power;  // of that [W]

    SLIDEWAY_FN static SliderLoads none() {
        Real const zero(0.0);
        return {{zero, zero, zero}, {zero, zero, zero}, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    }

    /// @tparam with_powers also powers and potentials, without which the rest has the same bits
    /// @param crank angle and speed of the crank  @param position, velocity of the slider's centre, along the axes of the ground
    template <bool with_powers>
    SLIDEWAY_FN static SliderLoads of(LoadList const& list, Real t, GivenMotion<Real> const& crank, Vec3<Real> const& position, Vec3<Real> const& velocity,
                                            SliderTurning<Real> const& turning, SliderParameters<Real> const& p) {
        LoadArguments<Real> const arguments{crank.place, t, position.x, velocity.x, crank.velocity};
        auto sum = none();
        for (int i = 0; i < list.count; ++i) {
            Load const& load = list.loads[i];
            if (load.kind == LoadKind::way_profile || load.kind == LoadKind::way_ends) continue;  // the joint has it
            LoadNumbers<Real> const numbers(load, p.load, arguments);
            if (load.kind == LoadKind::push) sum.template add_push<with_powers>(load, numbers, velocity, turning);
            else if (load.kind == LoadKind::ground_motion) sum.template add_ground<with_powers>(numbers.scaled(load.force), velocity, turning, arguments.crank_angle, p);
            else if (load.kind != LoadKind::film) sum.template add_element<with_powers>(load, numbers, position, velocity, turning);  // which OilFilm has
        }
        if constexpr (!with_powers) return sum;
        sum.crank_power = sum.crank_torque * crank.velocity;
        Real const of_pin = sum.pin_torque * crank.velocity;
        sum.power = sum.power + (sum.crank_power - of_pin);
        sum.ground_power = sum.ground_power + of_pin;
        sum.weight_power = sum.crank_weight * crank.velocity;
        return sum;
    }

    /// Torque on a crank that turns freely.
    SLIDEWAY_FN Real turning() const { return crank_torque + crank_weight; }

    /// What a report tells of them, once it has told the rest: torque on a driven crank is not the drive's.
    template <class Report> SLIDEWAY_FN void tell(DrivePlan const& drive, Report& report) const {
        report.load_power = power;
        report.ground_power = ground_power;
        report.spring_loss = spring_loss;
        report.spring_potential = potential;
        report.energy = report.energy + potential;
        report.crank_torque = report.crank_torque - pin_torque;
        if (drive.turns_freely()) {
            report.ground_power = report.ground_power + weight_power;
            return;
        }
        report.crank_power = report.crank_power - crank_power;
        report.drive_torque = report.drive_torque - turning();
    }

private:
    template <bool with_powers> SLIDEWAY_FN void add_push(Load const& load, LoadNumbers<Real> const& numbers, Vec3<Real> const& velocity, SliderTurning<Real> const& turning) {
        auto const& axes = turning.axes;
        auto along = numbers.scaled(load.force), twist = numbers.scaled(load.torque);
        if (load.turns_with_slider) {
            force = force + from_slider(axes, along);
        } else {
            force = force + along;
            along = to_slider(axes, along), twist = to_slider(axes, twist);
        }
        twist = twist + cross(numbers.as_given(load.point), along);
        torque = torque + twist;
        if constexpr (with_powers) power = power + (dot(along, to_slider(axes, velocity)) + dot(twist, turning.omega));
        crank_torque = crank_torque + numbers.scaled(load.crank_torque);
    }

    /// −a of the ground on the masses of slider and rod, the rod's at its ends as its weight.
    template <bool with_powers> SLIDEWAY_FN void add_ground(Vec3<Real> const& acceleration, Vec3<Real> const& velocity, SliderTurning<Real> const& turning, Real crank_angle,
                                SliderParameters<Real> const& p) {
        Real const at_slider = fma(p.rod_mass, p.rod_mass_center, p.slider_mass), at_pin = fnma(p.rod_mass, p.rod_mass_center, p.rod_mass);
        auto const on_slider = negated(at_slider) * acceleration;
        force = force + on_slider;
        // Each acts where its mass is.
        auto const along = to_slider(turning.axes, acceleration);
        auto const twist = negated(p.slider_mass) * cross(p.mass_center, along) - p.rod_mass * p.rod_mass_center * cross(p.pin, along);
        torque = torque + twist;
        if constexpr (with_powers) ground_power = ground_power + (dot(on_slider, velocity) + dot(twist, turning.omega));
        auto const crank = sincos(crank_angle);
        Real const lever = fms(crank.sin, acceleration.x, crank.cos * acceleration.y), of_pin = at_pin * p.crank_length * lever;
        pin_torque = pin_torque + of_pin;
        crank_torque = crank_torque + of_pin;
        crank_weight = fma(p.crank_moment, lever, crank_weight);
    }

    template <bool with_powers> SLIDEWAY_FN void add_element(Load const& load, LoadNumbers<Real> const& numbers, Vec3<Real> const& position, Vec3<Real> const& velocity,
                                 SliderTurning<Real> const& turning) {
        auto const point = numbers.as_given(load.point);
        auto const arm = from_slider(turning.axes, point);
        auto const element = ElementForce<Real>::of(load, numbers, position + arm, velocity + cross(turning.spin, arm));
        force = force + element.force;
        torque = torque + cross(point, to_slider(turning.axes, element.force));
        if constexpr (!with_powers) return;
        potential = potential + element.potential;
        spring_loss = spring_loss + element.loss;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
