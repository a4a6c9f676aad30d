#pragma once

#include "kernels/joint/apex.hpp"
#include "kernels/joint/joint.hpp"
#include "kernels/joint/joint_gaps.hpp"
#include "kernels/joint/oil_film.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/offset_slider.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/mechanisms/slider_loads.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider in its clearance joint: M u'' = F of what guides it along the way, and I ω' = A_kᵀ τ − ω × I ω (model.md 6, 7).  State: y z vy
/// vz φ ϑ ψ ωx ωy ωz, and x vx where nothing prescribes them.  Compiled once for all laws, with and without friction and a misaligned way:
/// those are the Conditions's.
/// @tparam Guide what moves the slider along the way.  It has `Base` (SliderBase, or what extends it), `info`, and
///  - `At<Real>`, made of (t, state, parameters, drive, faults): position and velocity along the way `x`, `vx`; `accelerations(force, p)`, of the
///    slider's centre, `put_rates(acceleration, rates)` of what the state has beyond ten numbers, `tell(…)` of the report, for rigid joints
///    `centre(p)`, the same as numbers, and where `info` has KeyGroup::body `response(force, p)`, what a force changes of the accelerations;
///  - `Constraint<Real>`, made of (t, state, parameters, drive): `x`, `vx`, `masses(p, out)` of (vy, vz), `project(force)`, what a force does to
///    vy and vz, and with KeyGroup::body `slope()`, κ of x' = κy y' + κz z'.
///  - `along(t, state, parameters, drive)`: x alone, for a pose; `crank(…)` of them, if it has one: its angle and speed, for loads.
template <class Guide_> struct SpatialSlider : Guide_::Base, Guide_ {
    using Guide = Guide_;
    using typename Guide_::Base;
    /// SliderParameters, or what the guide's base adds to them.
    template <class Real> using Numbers = typename Guide_::Base::template Parameters<Real>;

    /// Time derivative of the state.
    /// @param t time [s]; @param s the state, `size` values; @param rates their derivatives, NaN where a fault is set, and behind them the
    /// δ' [m/s] of the pair whose depth the memory has from a clock, if it has.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real, class Laws>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Numbers<Real> const& p, ContactMemory<Real> const& memory,
                                               Conditions<Laws> const& block, Real* rates, SliderReport<Real>* report) {
        auto const extras = block.extras();
        if (extras == Extras::nothing) return derivative_with<Full, Extras::nothing>(t, s, p, memory, block, rates, report);
        if (extras == Extras::loads) return derivative_with<Full, Extras::loads>(t, s, p, memory, block, rates, report);
        return derivative_with<Full, Extras::profile>(t, s, p, memory, block, rates, report);
    }
    /// The same, of a block with these extras.
    template <bool Full, Extras has, class Real, class Laws>
    SLIDEWAY_NOINLINE static Faults<Real> derivative_with(Real t, Real const* s, Numbers<Real> const& p, ContactMemory<Real> const& memory,
                                                          Conditions<Laws> const& block, Real* rates, SliderReport<Real>* report) {
        constexpr bool loaded = has != Extras::nothing, profiled = has == Extras::profile;
        auto faults = Faults<Real>::none();
        DrivePlan drive;
        if constexpr (loaded) drive = block.drive;
        auto turning = SliderTurning<Real>::of(s);
        PinState<Real, Base::size> const at(s, turning, p, may_be_offset && loaded && block.offset_slider);
        typename Guide::template At<Real> guide(t, at.state, p, drive, faults);
        auto const& way = p.joint.way;
        Vec3<Real> position{guide.x, s[0], s[1]}, velocity{guide.vx, s[2], s[3]};
        if constexpr (loaded) at.leave_pin(position.x, velocity.x);
        auto motion = seen<profiled>(block, turning, position, velocity, p);
        Joint<Real, Laws, Full, decltype(motion)> joint(motion, memory, p.joint, block, Full ? &report->contact : nullptr);
        auto wrench = joint.wrench(faults.contact_domain);
        if constexpr (profiled) faults.geometry = faults.geometry | motion.has_left;
        [[maybe_unused]] Real film_loss(0.0);
        if constexpr (loaded) {
            if (block.film) {
                JointMotion<Real> oiled = motion;  // as Joint's own is not to lie in memory
                auto const film = OilFilm<Real>::of(block.loads, p.load, oiled, p.joint.geometry);
                wrench.force = wrench.force + film.wrench.force;
                wrench.torque = wrench.torque + film.wrench.torque;
                film_loss = film.loss;
            }
        }
        auto force = to_inertial(block.misaligned_way, wrench.force, way);
        [[maybe_unused]] SliderLoads<Real> loads;
        if constexpr (loaded) {
            loads = SliderLoads<Real>::template of<Full>(block.loads, t, crank_of<Guide>(t, s, p, drive), position, velocity, turning, p);
            if constexpr (requires { guide.turn(loads.turning()); }) guide.turn(loads.turning());
            force = force + loads.force;
            wrench.torque = wrench.torque + from_slider(motion.axes, loads.torque);
        }
        PointMotion<Real> centre{position, velocity, {}};
        [[maybe_unused]] typename OffsetSlider<Real>::Answer answer;
        bool const is_offset = loaded && at.is_offset();
        if constexpr (loaded && may_be_offset) {
            if (is_offset) {
                answer = at.offset.answer(guide, force, to_slider(motion.axes, wrench.torque), turning, p);
                centre.acceleration = answer.hole;
                turning.put_rates(answer.spin_up, rates);
            }
        }
        if (!is_offset) {
            centre.acceleration = guide.accelerations(force, p);
            turning.put_rates(wrench.torque, motion.axes, p.inertia, p.inverse_inertia, rates);
        }
        rates[0] = velocity.y;
        rates[1] = velocity.z;
        rates[2] = centre.acceleration.y;
        rates[3] = centre.acceleration.z;
        guide.put_rates(centre.acceleration, rates);
        if (joint.has_clock()) rates[Base::size] = joint.clock_rate();
        if constexpr (Full) {
            if constexpr (loaded && may_be_offset) {
                if (is_offset) at.offset.tell(guide, centre, answer, turning, p, block.powers_alone, *report);
            }
            if (!is_offset) guide.tell(centre, turning, force, p, block.powers_alone, *report);
            if constexpr (loaded) {
                loads.tell(drive, *report);
                report->film_loss = film_loss;
            }
        }
        return faults;
    }

    /// Linearises it about one state; the same arguments as the derivative.  NaN where that has a fault.
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static void linearise(Real t, Real const* s, Numbers<Real> const& p,
                                            ContactMemory<Real> const& memory, Conditions<Laws> const& block,
                                            SliderLinearisation<Real>& out) {
        auto turning = SliderTurning<Real>::of(s);
        PinState<Real, Base::size> const at(s, turning, p, may_be_offset && block.offset_slider);
        typename Guide::template Constraint<Real> const guide(t, at.state, p, block.drive);
        guide.masses(p, out);
        out.inertia = p.inertia;
        out.has_twelve = Base::size > state_size;
        if constexpr (may_be_offset) {
            if (at.is_offset()) out.template couple<is_free_along<Guide>>(at.offset, guide.slope(), turning, p);
        }
        out.roll = turning.angles.roll;
        out.yaw = turning.angles.yaw;
        auto const& slider = turning.axes;
        auto const& way = p.joint.way;
        Vec3<Real> place{guide.x, s[0], s[1]}, velocity{guide.vx, s[2], s[3]};
        at.leave_pin(place.x, velocity.x);
        JointFrame<Real> frame;
        frame.motion = motion_on_way(block, slider, place, velocity, turning.spin, p);
        frame.velocity = {dot(slider.x, velocity), dot(slider.y, velocity), dot(slider.z, velocity)};
        frame.spin = turning.omega;
        frame.x = guide.project(slider.x);
        frame.y = guide.project(slider.y);
        frame.z = guide.project(slider.z);
        Real const zero(0.0);
        auto const normal = [&](Vec3<Real> const& axis) {
            return guide.project(to_inertial(block.misaligned_way, Vec3<Real>{zero, axis.y, axis.z}, way));
        };
        frame.y_normal = normal(frame.motion.axes.y);
        frame.z_normal = normal(frame.motion.axes.z);
        JointLinearisation<Real, Laws> joint(frame, memory, p.joint, block, out.joint);
        out.touching = joint.fill();
        if (Load const* const film = block.loads.find(LoadKind::film)) {
            FilmStiffness<Real>::add(*film, p.load, frame, p.joint.geometry, out.joint);
            out.touching = out.touching + Real(1.0);
        }
    }

    /// Which apices touch, as a number: members of one pattern have the same work to do.
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static Real contact_pattern(Real t, Real const* s, Numbers<Real> const& p, Conditions<Laws> const& block) {
        return slideway::contact_pattern(pose(t, s, p, block), p.joint.geometry);
    }

    /// Mean speed, in units of c ω, at which the fastest of the apices that come into contact in a step has approached its face; 0 where
    /// none does.
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static Real approach_speed(Real t, Real const* s, Real step, Real const* end,
                                                 Numbers<Real> const& p, Conditions<Laws> const& block) {
        Real const way = longest_approach(pose(t, s, p, block), pose(t + step, end, p, block), p.joint.geometry);
        return way / (step * max(p.length_scale_y, p.length_scale_z) * p.rate_scale);
    }

    /// Acceleration [m/s²] of y and z, on the mean over a step, of a slider that follows a misaligned way: dy/dx and dz/dx of its axis times x''.
    template <class Real>
    SLIDEWAY_NOINLINE static Translation<Real> way_bend(Real t, Real step, Real const* s, Numbers<Real> const& p, DrivePlan const& drive) {
        auto const lies = axes(attitude(s[4], s[5], s[6]));
        auto const along = [&](Real at) { return along_way<Guide>(at, s, lies, p, drive, may_be_offset); };
        Real const start = along(t), middle = along(fma(Real(0.5), step, t)), end = along(t + step);
        auto const goes = step > Real(0.0);
        Real const safe = select(goes, step, Real(1.0)), bend = select(goes, Real(4.0) * ((start - middle) + (end - middle)) / (safe * safe), Real(0.0));
        auto const& axis = p.joint.way.x;
        Real const of_x = bend / axis.x;
        return {of_x * axis.y, of_x * axis.z};
    }

    /// Gap of an apex to the face on its side: its penetration negated [m].
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, Numbers<Real> const& p,
                                      Conditions<Laws> const& block, Apex apex) {
        return negated(penetration(pose(t, s, p, block), p.joint.geometry, apex));
    }

private:
    static constexpr bool may_be_offset = has_group(Guide::info.keys, KeyGroup::body);

    /// What the joint sees: without a profile a way that is straight and has no ends.  No lambda, which would have all of it lie in memory.
    template <bool profiled, class Real, class Laws>
    SLIDEWAY_FN static auto seen(Conditions<Laws> const& block, SliderTurning<Real> const& turning, Vec3<Real> const& position, Vec3<Real> const& velocity,
                                 Numbers<Real> const& p) {
        if constexpr (profiled) return motion_on_way(block, turning.axes, position, velocity, turning.spin, p);
        else return joint_motion(block.misaligned_way, turning.axes, position, velocity, turning.spin, p.joint.way);
    }
    /// Where the slider is in its joint; without its motion.
    template <class Real, class Laws>
    SLIDEWAY_FN static ProfiledMotion<Real> pose(Real t, Real const* s, Numbers<Real> const& p, Conditions<Laws> const& block) {
        Real const zero(0.0);
        Vec3<Real> const still{zero, zero, zero};
        auto const lies = axes(attitude(s[4], s[5], s[6]));
        return motion_on_way(block, lies, Vec3<Real>{along_way<Guide>(t, s, lies, p, block.drive, may_be_offset && block.offset_slider), s[0], s[1]}, still, still, p);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
