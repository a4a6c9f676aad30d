#pragma once

#include "kernels/inputs.hpp"
#include "kernels/joint/apex.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/joint_gaps.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/joint_settlement.hpp"
#include "kernels/rigid/joint_step_impulse.hpp"
#include "kernels/rigid/joint_watch.hpp"
#include "kernels/rigid/lasting_forces.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_observer.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"
#include "kernels/rigid/slider_place.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct RigidSliderParameters : SliderParameters<Real> { Real restitution; };

/// A slider whose hole and way are rigid (docs/model.md 13), as the lanes integrate it: apices fly, meet their faces in impacts without duration (`settle`), and
/// push as long as they last.
/// @tparam Guide what moves the slider along the way (kernels/mechanisms/spatial_slider.hpp)
template <class Guide> struct RigidSlider : Guide::Base {
    using Base = typename Guide::Base;
    template <class Real> using Parameters = RigidSliderParameters<Real>;
    template <class Real> using Report = RigidSliderReport<Real>;
    template <class Real> using Memory = RigidJointMemory<Real>;
    template <class Real> using Watch = JointWatch<Real>;
    template <class Real> using Observer = RigidObserver<Real, RigidSliderReport>;
    static constexpr int series = series_count;
    static constexpr int events = 0;
    static constexpr bool has_contacts = true;
    static constexpr bool has_impacts = true;
    static constexpr bool sees_contacts = true;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = true;
    static constexpr bool has_patterns = true;
    static constexpr bool has_linearisation = false;

    bool friction = false, misaligned_way = false;
    double slip_units = 1;          // slip scales
    bool integrands_alone = false;  // reports tell what is integrated, and nothing else

    explicit constexpr RigidSlider(Parts const& parts) : friction(parts.friction), misaligned_way(parts.misaligned_way) {}

    /// Of a member; what a law needs of its restitution is not worked out.
    SLIDEWAY_FN static RigidSliderParameters<double> parameters(Inputs in) {
        RigidSliderParameters<double> p;
        p.restitution = in.restitution;
        in.restitution = 1;
        static_cast<SliderParameters<double>&>(p) = Base::parameters(in);
        return p;
    }

    /// A slider without a drive has no speed that slips are to be seen against.
    SLIDEWAY_HD void set_tolerance(double rtol) { slip_units = Base::size > state_size ? 1.0 : slip_unit(rtol); }
    SLIDEWAY_HD void tell_integrands_alone(bool alone) { integrands_alone = alone; }
    static constexpr bool switches() { return false; }
    static constexpr Watching watching(bool, bool) { return Watching::touches; }

    /// Pairs that last, a bit each, and those of them that stick.
    template <class Real> SLIDEWAY_FN static Real contact_pattern(RigidJointMemory<Real> const& memory) {
        Real pattern(0.0);
        for (int i = 0; i < pair_count; ++i) {
            pattern = fma(Real(static_cast<double>(1u << i)), number_of(memory.held, i), pattern);
            pattern = fma(Real(static_cast<double>(1u << (pair_count + i))), number_of(memory.sticks, i), pattern);
        }
        return pattern;
    }
    /// Depth [m] up to which an apex that meets its face is located: what rounding leaves of it, as the crank's angle grows too.
    template <class Real> SLIDEWAY_FN static Real located(RigidSliderParameters<Real> const& p, Real end) {
        Real const turned = fma(p.rate_scale, end, Real(6.3));
        Real const size = max(p.joint.geometry.half_length, p.crank_length);
        return fma(Real(2e-12), max(p.length_scale_y, p.length_scale_z), Real(4 * 2.220446049250313e-16) * size * turned);
    }
    template <class Real>
    SLIDEWAY_FN Real gap(Real t, Real const* s, RigidSliderParameters<Real> const& p, bool z_faces, int apex) const {
        Real const zero(0.0);
        Vec3<Real> const still{zero, zero, zero};
        auto const pose = joint_motion(misaligned_way, axes(attitude(s[4], s[5], s[6])), Vec3<Real>{Guide::along(t, s, p), s[0], s[1]}, still,
                                       still, p.joint.way);
        return negated(penetration(pose, p.joint.geometry, Apex{z_faces, apex}));
    }
    /// The bit of an apex and its Y or Z face among those that an impact `met`.
    static constexpr int met_bit(bool z_faces, int apex) {
        for (int pair = z_faces ? 8 : 0; pair < pair_count; ++pair) {
            if (face_apex(pair / 4, pair % 4) == apex) return pair;
        }
        return pair_count;
    }
    template <class Real>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, RigidSliderParameters<Real> const& p) {
        return slideway::left_stable_range(audit, Base::energy_scale(p));
    }

    /// Time derivative of the state.  @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE Faults<Real> derivative(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                                              Real* rates, RigidSliderReport<Real>* report) const {
        Real const zero(0.0);
        auto faults = Faults<Real>::none();
        SliderPlace<Guide, Real> const at(t, s, p, misaligned_way, faults);
        auto const& guide = at.guide;
        // NaN in a lane whose pose is, whatever its neighbours touch.
        Real const whole = (at.motion.y + at.motion.z) + (at.motion.axes.x.x + at.motion.axes.y.z), nothing = whole - whole;
        Vec3<Real> force{nothing, nothing, nothing}, torque = force;
        auto const last = lasting_pairs(memory);
        auto const holding = last.any();
        Depths<Real> const depths(at);
        auto const& depth = depths.of;
        if constexpr (Full) {
            report->contact.clear(false);
            report->contact.loads.clear();
            report->contact.books = memory.books;
            if (!integrands_alone) see(at, depths, memory, report->contact);
        }
        auto jammed = memory.jammed > zero;
        if (any(holding)) {
            LastingForces<Guide, Real> lasting;
            lasting.solve(at.pairs, at.velocity, depth, drift_rate(p), last.held, last, memory.loads, friction ? &p.joint.friction : nullptr);
            auto const moment = at.pairs.to_joint(lasting.force.angular);
            auto const add = [&](Vec3<Real>& to, Vec3<Real> const& of) {
                to = {select(holding, of.x, to.x), select(holding, of.y, to.y), select(holding, of.z, to.z)};
            };
            add(force, lasting.force.linear);
            add(torque, moment);
            jammed = jammed | (holding & lasting.failed);
            if constexpr (Full) tell(lasting, report->contact);
            if constexpr (Full) {
                if (!integrands_alone) tell_modes(lasting, last, Real(1.0) / unit_of_slip(p), report->contact);
            }
        }
        auto acceleration = guide.accelerations(force, p);
        rates[0] = s[2];
        rates[1] = s[3];
        rates[2] = acceleration.y;
        rates[3] = acceleration.z;
        at.turning.put_rates(torque, at.motion.axes, p.inertia, p.inverse_inertia, rates);
        guide.put_rates(acceleration, rates);
        rates[9] = select(jammed, Real(not_a_number), rates[9]);
        if constexpr (Full) {
            Vec3<Real> const centre{guide.x, s[0], s[1]}, velocity{guide.vx, s[2], s[3]};
            guide.tell({centre, velocity, acceleration}, at.turning, force, p, false, *report);
        }
        faults.contact_domain = jammed;
        faults.geometry = faults.geometry | ((memory.begun == zero) & (depths.deepest > Real(1e-6) * p.length_scale_y));
        return faults;
    }

    /// What the watch sees of a state, without its forces.  @param contact its depths, rates and slips are filled in
    template <class Real>
    SLIDEWAY_NOINLINE void see(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                               RigidJointContact<Real>& contact) const {
        auto faults = Faults<Real>::none();
        SliderPlace<Guide, Real> const at(t, s, p, misaligned_way, faults);
        see(at, Depths<Real>(at), memory, contact);
        auto const last = lasting_pairs(memory);
        if (!friction || none(last.any())) return;
        Real const per_scale = Real(1.0) / unit_of_slip(p);
        for (int i = 0; i < pair_count; ++i) {
            if (none(last.held[i])) continue;
            JointPair<Real> pair;
            at.pairs.put_pair(i, pair);
            Real const slip[2] = {dot(pair.slip[0], at.velocity), dot(pair.slip[1], at.velocity)};
            tell_slip(i, last, slip, per_scale, contact);
        }
    }

    /// What follows from where a step has ended: impacts, and pairs that begin or cease to last.
    /// @param end of the run [s]  @param contact of the report there  @return lanes where state or contacts have changed
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> settle(Mask<Real> in, Real t, Real end, Real* s, RigidSliderParameters<Real> const& p,
                                        RigidJointMemory<Real>& memory, RigidJointContact<Real> const& contact) const {
        using Settlement = JointSettlement<Guide, Real>;
        memory.clear_books(in);
        keep_loads(in, contact.loads, memory.loads);
        Real const where = located(p, end), least_speed = Real(slip_at_rest) * max(p.length_scale_y, p.length_scale_z) * p.rate_scale;
        Mask<Real> event;
        auto const changed = Settlement::find(in, memory, contact, where, least_speed, friction, event);
        if (none(event)) return changed;
        auto faults = Faults<Real>::none();
        SliderPlace<Guide, Real> const at(t, s, p, misaligned_way, faults);
        Settlement settlement(at.pairs, at.guide, p, p.restitution, friction ? &p.joint.friction : nullptr, where, end, unit_of_slip(p));
        auto velocity = at.velocity;
        settlement.run(event, t, velocity, memory, contact, least_speed);
        put_velocity(event, velocity, s);
        return changed;
    }

    /// Components of the state that are rates of the others, a bit each, and what the rates of those are.
    static constexpr unsigned rate_components = 0b1011'1000'1100;
    template <class Real> SLIDEWAY_FN static void put_place_rates(Real const* s, RigidSliderParameters<Real> const& p, Real* rates) {
        Real const zero(0.0);
        auto const turning = SliderTurning<Real>::of(s);
        rates[0] = s[2];
        rates[1] = s[3];
        turning.put_rates({zero, zero, zero}, turning.axes, p.inertia, p.inverse_inertia, rates);
        if constexpr (Base::size > state_size) rates[10] = s[11];
    }

    /// Impulses of a step of time stepping on what touches in its middle (M13.16).
    /// @param t of the middle  @param h of the step, 0 without one [s]  @param s places in the middle, and the rates at the start
    /// @param free the same with the rates that the step has without impulses, and then with them
    /// @param contact of the report in the middle, then with the impulses' books and modes  @return lanes where there are no such impulses
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> push(Real t, Real h, Real const* s, Real* free, RigidSliderParameters<Real> const& p,
                                      RigidJointContact<Real>& contact) const {
        using Impulse = JointStepImpulse<Guide, Real>;
        auto const changed = [&](int i) { return abs(free[i] - s[i]); };
        // Of a rate, and of where it leads to.
        auto const turned = [&](int i) { return fma(h, s[i] * s[i], changed(i)); };
        Real const of_apices = p.joint.geometry.half_length * ((turned(7) + turned(8)) + turned(9));
        Impulse impulse(h, (changed(2) + changed(3)) + of_apices, contact, p);
        if (none(impulse.touching())) return impulse.tell(contact);
        auto faults = Faults<Real>::none();
        SliderPlace<Guide, Real> const at(t, free, p, misaligned_way, faults);
        put_rates<Axis::y>(at, contact);
        put_rates<Axis::z>(at, contact);
        impulse.keep_meeting(contact);
        if (none(impulse.touching())) return impulse.tell(contact);
        typename Guide::template At<Real> const guide(t, s, p, faults);
        Twist<Real> const start{{guide.vx, s[2], s[3]}, {s[7], s[8], s[9]}};
        auto const velocity = impulse.solve(at, start, p.restitution, friction ? &p.joint.friction : nullptr);
        put_velocity(impulse.touching(), velocity, free);
        return impulse.tell(contact);
    }

    /// Keeps an offset, which the slopes of a state are, to the pairs that last.
    template <class Real>
    SLIDEWAY_NOINLINE void keep_offset(Mask<Real> in, Tangent<Real> const& t, Tangent<Real>* s, RigidSliderParameters<Tangent<Real>> const& p,
                                       RigidJointMemory<Tangent<Real>> const& memory) const {
        JointOffset<Guide, Real>(p, misaligned_way, friction).keep(in, t, s, memory);
    }
    /// How long ago the slips of pairs that have just come to rest still were slips [s]; 0 where none has.
    template <class Real>
    SLIDEWAY_FN Real since_slip(RigidJointContact<Real> const& contact, RigidJointContact<Tangent<Real>> const& flow,
                                RigidSliderParameters<Real> const& p) const {
        return min(contact.since_slip(flow), Real(1e-4) / p.rate_scale);
    }

private:
    /// [m/s]
    template <class Real> SLIDEWAY_FN Real unit_of_slip(SliderParameters<Real> const& p) const { return Real(slip_units) * slip_scale(p); }
    /// β of (M13.10) [1/s]: what drifts is back within a part of the drive's period.
    template <class Real> SLIDEWAY_FN static Real drift_rate(SliderParameters<Real> const& p) { return Real(10.0) * p.rate_scale; }

    /// Of all pairs [m].
    template <class Real> struct Depths {
        Quad<Real> of[face_count];
        Real deepest;

        SLIDEWAY_FN explicit Depths(SliderPlace<Guide, Real> const& at) {
            Real const one(1.0), minus(-1.0);
            auto const y = FacePair<Axis::y>::depths(at.motion, at.geometry), z = FacePair<Axis::z>::depths(at.motion, at.geometry);
            of[0] = y.on(one), of[1] = y.on(minus), of[2] = z.on(one), of[3] = z.on(minus);
            deepest = max(max(y.largest(one), y.largest(minus)), max(z.largest(one), z.largest(minus)));
        }
    };
    template <class Real> SLIDEWAY_FN static LastingPairs<Real> lasting_pairs(RigidJointMemory<Real> const& memory) {
        Real const half(0.5);
        LastingPairs<Real> last;
        for (int i = 0; i < pair_count; ++i) {
            last.held[i] = number_of(memory.held, i) > half;
            last.sticks[i] = number_of(memory.sticks, i) > half;
        }
        return last;
    }

    template <class Real>
    SLIDEWAY_FN static void see(SliderPlace<Guide, Real> const& at, Depths<Real> const& depths, RigidJointMemory<Real> const& memory,
                                RigidJointContact<Real>& contact) {
        put_rates<Axis::y>(at, contact);
        put_rates<Axis::z>(at, contact);
        Real const far(-1.0), half(0.5), zero(0.0);
        auto const watched = [&](Real held, Real d) { return select(held > half, far, d); };
        Quad<Real> const none{zero, zero, zero, zero};
        for (int face = 0; face < face_count; ++face) {
            auto const& d = depths.of[face];
            auto const& held = memory.held[face];
            contact.penetration[face] = d;
            contact.slides[face] = contact.slip[0][face] = contact.slip[1][face] = none;
            contact.watched[face] = {watched(held.a, d.a), watched(held.b, d.b), watched(held.c, d.c), watched(held.d, d.d)};
        }
    }
    /// Of one pair.  @param slip [m/s]
    template <class Real>
    SLIDEWAY_FN static void tell_slip(int pair, LastingPairs<Real> const& last, Real const (&slip)[2], Real per_scale, RigidJointContact<Real>& contact) {
        Real const zero(0.0), one(1.0), minus(-1.0);
        number_of(contact.slides, pair) = select(last.held[pair], select(last.sticks[pair], minus, one), zero);
        for (int j = 0; j < 2; ++j) number_of(contact.slip[j], pair) = slip[j] * per_scale;
    }
    template <class Real> SLIDEWAY_FN static void put_velocity(Mask<Real> in, Twist<Real> const& velocity, Real* s) {
        auto const put = [&](int i, Real value) { s[i] = select(in, value, s[i]); };
        put(2, velocity.linear.y);
        put(3, velocity.linear.z);
        put(7, velocity.angular.x);
        put(8, velocity.angular.y);
        put(9, velocity.angular.z);
        if constexpr (Base::size > state_size) put(11, velocity.linear.x);
    }
    template <class Real> SLIDEWAY_HD static void keep_loads(Mask<Real> in, ApexLoads<Real> const& from, ApexLoads<Real>& to) {
        for (int i = 0; i < pair_count; ++i) {
            auto const keep = [&](Real value, Real& kept) { kept = select(in, value, kept); };
            keep(number_of(from.normal, i), number_of(to.normal, i));
            for (int j = 0; j < 2; ++j) keep(number_of(from.along[j], i), number_of(to.along[j], i));
        }
    }
    template <Axis axis, class Real> SLIDEWAY_FN static void put_rates(SliderPlace<Guide, Real> const& at, RigidJointContact<Real>& contact) {
        using Faces = FacePair<axis>;
        auto v = Faces::arranged(at.motion.velocity);
        auto spin = Faces::arranged_axial(at.motion.spin);
        auto const rates = Faces::rates(cross(spin, Faces::normal(at.motion)), v, at.motion, at.geometry);
        contact.rate[Faces::first_face] = rates.on(Real(1.0));
        contact.rate[Faces::first_face + 1] = rates.on(Real(-1.0));
    }

    template <class Real> SLIDEWAY_FN static void tell(LastingForces<Guide, Real> const& lasting, RigidJointContact<Real>& contact) {
        for (int face = 0; face < face_count; ++face) {
            auto const* const force = &lasting.normal[4 * face];
            contact.normal_force[face] = {force[0], force[1], force[2], force[3]};
        }
        contact.friction_power = lasting.friction_power;
        contact.damping_power = negated(lasting.normal_power);
    }
    /// What no integral asks for: slips, loads, and in which way the slider touches.
    template <class Real>
    SLIDEWAY_FN static void tell_modes(LastingForces<Guide, Real> const& lasting, LastingPairs<Real> const& last, Real per_scale,
                                       RigidJointContact<Real>& contact) {
        for (int i = 0; i < pair_count; ++i) {
            tell_slip(i, last, {lasting.slip[0][i], lasting.slip[1][i]}, per_scale, contact);
            number_of(contact.loads.normal, i) = lasting.normal[i];
            for (int j = 0; j < 2; ++j) number_of(contact.loads.along[j], i) = lasting.along[j][i];
        }
        for (int face = 0; face < face_count; ++face) {
            auto const* const touch = &last.held[4 * face];
            contact.count_modes(Quad<Mask<Real>>{touch[0], touch[1], touch[2], touch[3]});
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
