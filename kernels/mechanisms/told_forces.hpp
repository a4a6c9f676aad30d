#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/joint_forces.hpp"
#include "kernels/joint/oil_film.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/loads/load_numbers.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/slider_loads.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Whether the forces at the pins of a crank and a rod may be asked for.
template <class Mechanism> constexpr bool has_pins() { return (Mechanism::info.series & selections::pin_series) != 0; }

/// Acceleration of the ground [m/s²].
template <class Real> SLIDEWAY_FN Vec3<Real> ground_acceleration(LoadList const& list, LoadArguments<Real> const& arguments, Real const* numbers) {
    Real const zero(0.0);
    Vec3<Real> sum{zero, zero, zero};
    for (int i = 0; i < list.count; ++i) {
        if (list.loads[i].kind == LoadKind::ground_motion) sum = sum + LoadNumbers<Real>(list.loads[i], numbers, arguments).scaled(list.loads[i].force);
    }
    return sum;
}

/// Forces at both ends of the rod, from the momentum of the slider and that of the rod (model.md 17).
/// @param turning of the crank  @param centre, end accelerations of the slider's centre of mass and of its pin  @param loads on the slider and on the rod's end there  @param ground its acceleration
template <class Real>
SLIDEWAY_FN void tell_pins(GivenMotion<Real> const& turning, Vec3<Real> const& centre, Vec3<Real> const& end, Vec3<Real> const& loads, Vec3<Real> const& ground,
                           SliderParameters<Real> const& p, JointForces<Real>& forces) {
    auto const crank = sincos(turning.place);
    Real const inward = negated(p.crank_length) * (turning.velocity * turning.velocity), onward = p.crank_length * turning.acceleration;
    Vec3<Real> const pin{fnma(onward, crank.sin, inward * crank.cos), fma(onward, crank.cos, inward * crank.sin), Real(0.0)};
    Vec3<Real> const weight = Vec3<Real>{p.gravity_x, p.gravity_y, p.gravity_z} - ground;
    // Of what the ground's motion adds to the loads the rod bears its own share.
    Real const at_slider = fma(p.rod_mass, p.rod_mass_center, p.slider_mass);
    forces.rod = p.slider_mass * (centre - weight) - forces.contact - (loads + at_slider * ground);
    auto const of_rod = (Real(1.0) - p.rod_mass_center) * pin + p.rod_mass_center * end;
    forces.crank_pin = forces.rod + p.rod_mass * (of_rod - weight);
}

/// The forces of faces and pins.  @param rates, report of the state: what the derivative gave
template <class Mechanism, class Real, class Laws, class Parameters>
SLIDEWAY_NOINLINE void tell_forces(Real t, Real const* s, [[maybe_unused]] Real const* rates, Parameters const& p, Conditions<Laws> const& block,
                                   SliderReport<Real> const& report, JointForces<Real>& forces) {
    Real const zero(0.0);
    auto const turning = SliderTurning<Real>::of(s);
    auto const& way = p.joint.way;
    Vec3<Real> const position{report.x, s[0], s[1]}, velocity{report.vx, s[2], s[3]};
    auto const motion = motion_on_way(block, turning.axes, position, velocity, turning.spin, p);
    forces.tell(motion, report.contact, p.joint, block.friction);
    if (block.loads.count > 0) {
        auto const film = OilFilm<Real>::of(block.loads, p.load, motion, p.joint.geometry).wrench;
        forces.contact = forces.contact + film.force;
        forces.torque = forces.torque + film.torque;
    }
    for (auto* const told : {&forces.contact, &forces.torque}) *told = to_inertial(block.misaligned_way, *told, way);
    forces.rod = forces.crank_pin = {zero, zero, zero};
    if constexpr (has_pins<Mechanism>()) {
        auto crank = Mechanism::Guide::crank(t, s, p, block.drive);
        if constexpr (Mechanism::info.may_turn_freely) crank.acceleration = rates[11];
        auto loads = SliderLoads<Real>::none();
        Vec3<Real> ground{zero, zero, zero};
        if (block.loads.count > 0) {
            loads = SliderLoads<Real>::template of<false>(block.loads, t, crank, position, velocity, turning, p);
            ground = ground_acceleration(block.loads, {crank.place, t, report.x, report.vx, crank.velocity}, p.load);
        }
        auto const acceleration_at = [&](Vec3<Real> const& place) {
            if (!block.offset_slider) return report.acceleration;
            auto const arm = from_slider(turning.axes, place), turned = from_slider(turning.axes, Vec3<Real>{rates[7], rates[8], rates[9]});
            return report.acceleration + cross(turned, arm) + cross(turning.spin, cross(turning.spin, arm));
        };
        tell_pins<Real>(crank, acceleration_at(p.mass_center), acceleration_at(p.pin), loads.force, ground, p, forces);
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
