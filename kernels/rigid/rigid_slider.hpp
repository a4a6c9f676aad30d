#pragma once

#include "kernels/block.hpp"
#include "kernels/inputs.hpp"
#include "kernels/joint/apex.hpp"
#include "kernels/joint/joint_gaps.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/math/tangent.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/guide_functions.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/rigid_joint.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_observer.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"
#include "kernels/rigid/rigid_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider whose hole and way are rigid (model.md 13), as the lanes integrate it: apices fly, meet their faces in impacts without duration (`settle`), and
/// push as long as they last.  What guides it along the way is looked up: the lanes are compiled once for all mechanisms of a base.
/// @tparam Number a number or a pack of them, of which and of whose Tangent the functions below are called  @tparam Base_ of the mechanism's row in
/// mechanisms/list.hpp
template <class Number, class Base_> struct RigidSlider : RigidLanes<Base_> {
    using Base = Base_;
    template <class Real> using Parameters = RigidSliderParameters<Real>;
    template <class Real> using Report = RigidSliderReport<Real>;
    template <class Real> using Memory = RigidJointMemory<Real>;
    template <class Real> using Watch = JointWatch<Real>;
    template <class Real> using Observer = RigidObserver<Real, RigidSliderReport, true>;
    template <class Real> using Linearisation = SliderLinearisation<Real>;
    static constexpr bool sees_contacts = true, has_patterns = true, has_linearisation = true;
    static constexpr int evaluations_of_linearisation = 11;
    static constexpr int size = Base::room;

    RigidConditions block;
    GuideFunctions<Number> const* guide;
    GuideFunctions<Tangent<Number>> const* sloped_guide;  // of members with shadows, else nullptr

    constexpr RigidSlider(Parts const& parts, GuideFunctions<Number> const* guide, GuideFunctions<Tangent<Number>> const* sloped_guide = nullptr)
        : block{parts.friction, parts.misaligned_way, parts.offset_slider, parts.loads, parts.drive}, guide(guide), sloped_guide(sloped_guide) {}

    SLIDEWAY_HD bool has_loads() const { return block.loads.count > 0; }
    int states() const { return guide->state.count; }
    RigidSliderParameters<double> parameters(Inputs const& in) const { return guide->parameters(in); }
    void scales(SliderParameters<double> const& p, double* scale) const { guide->state.scales(p, scale); }
    void initial_state(Inputs const& in, double* state) const { guide->state.start(in, state); }
    int state_of_series(int series) const { return guide->state.of_series(series); }
    SLIDEWAY_HD void set_tolerance(double rtol) { block.slip_units = guide->is_free ? 1.0 : slip_unit(rtol); }
    SLIDEWAY_HD void tell_stages(bool inside, bool /*powers_alone*/) { block.integrands_alone = inside; }

    /// Pairs that last, a bit each, and those of them that stick.
    template <class Real>
    SLIDEWAY_FN static Real contact_pattern(Real, Real const*, RigidSliderParameters<Real> const&, RigidJointMemory<Real> const& memory) {
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
        auto const lies = axes(attitude(s[4], s[5], s[6]));
        auto const pose = joint_motion(block.misaligned_way, lies, Vec3<Real>{guide_of<Real>().along(t, s, lies, p, block), s[0], s[1]}, still, still, p.joint.way);
        return negated(penetration(pose, p.joint.geometry, Apex{z_faces, apex}));
    }
    /// The bit of an apex and its Y or Z face among those that an impact `met`.
    static constexpr int met_bit(bool z_faces, int apex) {
        for (int pair = z_faces ? 8 : 0; pair < pair_count; ++pair) {
            if (face_apex(pair / 4, pair % 4) == apex) return pair;
        }
        return pair_count;
    }

    /// Time derivative of the state.  @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    Faults<Real> derivative(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                            Real* rates, RigidSliderReport<Real>* report) const {
        return (Full ? guide_of<Real>().full : guide_of<Real>().lean)(t, s, p, memory, block, rates, report);
    }

    /// What the watch sees of a state, without its forces.  @param contact its depths, rates and slips are filled in
    template <class Real>
    SLIDEWAY_NOINLINE void see(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                               RigidJointContact<Real>& contact) const {
        auto const at = place(t, s, p);
        block.joint(at, p).see(memory, contact);
    }

    /// Rate [1/s] at which friction takes back what slips to the side, Ω = 4 μ Σ λ/(m |v|) over the pairs that slip: a corner of a block turns, too, and
    /// feels a quarter of the mass.
    template <class Real>
    SLIDEWAY_NOINLINE Real slip_rate(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory) const {
        Real const zero(0.0);
        Real sum = zero;
        if (!block.friction) return sum;
        each_slip(t, s, p, memory, [&](int i, Mask<Real> slips, Real speed) {
            sum = sum + select(slips, number_of(memory.loads.normal, i) / select(slips, speed, Real(1.0)), zero);
        });
        return Real(4.0) * sum * (p.joint.friction.kinetic_coefficient / p.slider_mass);
    }

    /// How the accelerations follow places and velocities, by differences: of velocities far smaller than the slowest slip, whose direction friction has.
    /// Angles stay so small that those of attitude pass for turns about the slider's axes.
    template <class Real>
    SLIDEWAY_NOINLINE void linearise(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                                     SliderLinearisation<Real>& out) const {
        constexpr int places[5] = {0, 1, 4, 5, 6}, velocities[5] = {2, 3, 7, 8, 9};
        Real const zero(0.0), one(1.0), per_length = one / p.joint.geometry.half_length;
        Real slowest = p.slip_scale;
        out.touching = zero;
        each_slip(t, s, p, memory, [&](int, Mask<Real> slips, Real speed) {
            slowest = min(slowest, select(slips, speed, slowest));
            out.touching = out.touching + count<Real>(slips);
        });
        Real at[size], rates[size], changed[size];
        for (int i = 0; i < states(); ++i) at[i] = s[i];
        derivative<false, Real>(t, at, p, memory, rates, nullptr);
        auto const differ = [&](int of, Real by, int column, Real (&slopes)[5][5]) {
            at[of] = s[of] + by;
            derivative<false, Real>(t, at, p, memory, changed, nullptr);
            Real const inverse = one / (at[of] - s[of]);
            for (int i = 0; i < 5; ++i) slopes[i][column] = (changed[velocities[i]] - rates[velocities[i]]) * inverse;
            at[of] = s[of];
        };
        Real const shift = Real(1e-6) * min(p.length_scale_y, p.length_scale_z), speed = Real(1e-5) * slowest;
        for (int j = 0; j < 5; ++j) {
            Real const arm = j < 2 ? one : per_length;
            differ(places[j], shift * arm, j, out.joint.by_place);
            differ(velocities[j], speed * arm, j, out.joint.by_rate);
        }
        out.mass_y = out.mass_z = one, out.mass_yz = zero;
        out.inertia = {one, one, one};
        out.has_twelve = states() > state_size;
        auto const angles = attitude(s[4], s[5], s[6]);
        out.roll = angles.roll, out.yaw = angles.yaw;
    }

    /// What follows from where a step has ended: impacts, and pairs that begin or cease to last.
    /// @param end of the run [s]  @param contact of the report there  @return lanes where state or contacts have changed
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> settle(Mask<Real> in, Real t, Real end, Real* s, RigidSliderParameters<Real> const& p,
                                        RigidJointMemory<Real>& memory, RigidJointContact<Real> const& contact) const {
        memory.clear_books(in);
        keep_loads(in, contact.loads, memory.loads);
        Real const where = located(p, end);
        Mask<Real> event;
        auto const changed = RigidJoint<Real>::find(in, memory, contact, where, RigidJoint<Real>::least_speed(p), block.friction, event);
        if (none(event)) return changed;
        auto const at = place(t, s, p);
        auto velocity = at.velocity;
        block.joint(at, p).settle(event, t, end, where, memory, contact, velocity);
        put_velocity(event, at, velocity, s);
        return changed;
    }

    /// Components of the state that are rates of the others, a bit each, and what the rates of those are.
    static constexpr unsigned rate_components = 0b1011'1000'1100;
    template <class Real> SLIDEWAY_FN void put_place_rates(Real const* s, RigidSliderParameters<Real> const& p, Real* rates) const {
        Real const zero(0.0);
        auto const turning = SliderTurning<Real>::of(s);
        rates[0] = s[2];
        rates[1] = s[3];
        turning.put_rates({zero, zero, zero}, turning.axes, p.inertia, p.inverse_inertia, rates);
        if (states() > state_size) rates[10] = s[11];
    }

    /// Impulses of a step of time stepping on what touches in its middle (M13.16).
    /// @param t of the middle  @param h of the step, 0 without one [s]  @param s places in the middle, and the rates at the start
    /// @param free the same with the rates that the step has without impulses, and then with them
    /// @param contact of the report in the middle, then with the impulses' books and modes  @return lanes where there are no such impulses
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> push(Real t, Real h, Real const* s, Real* free, RigidSliderParameters<Real> const& p,
                                      RigidJointContact<Real>& contact) const {
        auto const changed = [&](int i) { return abs(free[i] - s[i]); };
        // Of a rate, and of where it leads to.
        auto const turned = [&](int i) { return fma(h, s[i] * s[i], changed(i)); };
        Real const of_apices = p.joint.geometry.half_length * ((turned(7) + turned(8)) + turned(9));
        auto const at = place(t, free, p);
        auto velocity = at.velocity;
        Mask<Real> touching;
        auto const failed = block.joint(at, p).push(h, (changed(2) + changed(3)) + of_apices, place(t, s, p).velocity, contact, velocity, touching);
        put_velocity(touching, at, velocity, free);
        return failed;
    }

    /// Keeps an offset, which the slopes of a state are, to the pairs that last.
    template <class Real>
    SLIDEWAY_NOINLINE void keep_offset(Mask<Real> in, Tangent<Real> const& t, Tangent<Real>* s, RigidSliderParameters<Tangent<Real>> const& p,
                                       RigidJointMemory<Tangent<Real>> const& memory) const {
        JointOffset<Real> const offset(in, memory, p, block.friction);
        if (none(offset.any())) return;
        offset.keep_place(place(t, s, p), s);
        offset.keep_velocity(place(t, s, p), s);
    }
    /// How long ago the slips of pairs that have just come to rest still were slips [s]; 0 where none has.
    template <class Real>
    SLIDEWAY_FN Real since_slip(RigidJointContact<Real> const& contact, RigidJointContact<Tangent<Real>> const& flow,
                                RigidSliderParameters<Real> const& p) const {
        return min(contact.since_slip(flow), Real(1e-4) / p.rate_scale);
    }

private:
    /// Has a function see the pairs that last: lanes where one slips, and how fast [m/s].
    template <class Real, class See>
    SLIDEWAY_HD void each_slip(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory, See const& see_slip) const {
        RigidJointContact<Real> contact;
        see(t, s, p, memory, contact);
        Real const unit = Real(block.slip_units) * p.slip_scale;
        for (int i = 0; i < pair_count; ++i) {
            Real const first = number_of(contact.slip[0], i), second = number_of(contact.slip[1], i);
            see_slip(i, number_of(contact.slides, i) > Real(0.5), unit * sqrt(fma(first, first, second * second)));
        }
    }

    template <class Real> constexpr GuideFunctions<Real> const& guide_of() const {
        if constexpr (is_tangent<Real>) return *sloped_guide;
        else return *guide;
    }
    template <class Real> JointPairs<Real> place(Real t, Real const* s, RigidSliderParameters<Real> const& p) const {
        return guide_of<Real>().place(t, s, p, block);
    }

    /// @param at where the slider is, with the velocity that it had
    template <class Real> SLIDEWAY_FN void put_velocity(Mask<Real> in, JointPairs<Real> const& at, Twist<Real> const& velocity, Real* s) const {
        auto const put = [&](int i, Real value) { s[i] = select(in, value, s[i]); };
        put(2, velocity.linear.y);
        put(3, velocity.linear.z);
        put(7, velocity.angular.x);
        put(8, velocity.angular.y);
        put(9, velocity.angular.z);
        if (states() > state_size) put(11, s[11] + at.rate_change(velocity - at.velocity));
    }
    template <class Real> SLIDEWAY_HD static void keep_loads(Mask<Real> in, ApexLoads<Real> const& from, ApexLoads<Real>& to) {
        for (int i = 0; i < pair_count; ++i) {
            auto const keep = [&](Real value, Real& kept) { kept = select(in, value, kept); };
            keep(number_of(from.normal, i), number_of(to.normal, i));
            for (int j = 0; j < 2; ++j) keep(number_of(from.along[j], i), number_of(to.along[j], i));
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
