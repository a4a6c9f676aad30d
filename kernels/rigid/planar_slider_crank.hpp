#pragma once

#include "kernels/inputs.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/planar_base.hpp"
#include "kernels/mechanisms/planar_corners.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/planar_settlement.hpp"
#include "kernels/rigid/planar_stance.hpp"
#include "kernels/rigid/planar_step_impulse.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_observer.hpp"
#include "kernels/rigid/rigid_planar_report.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The planar slider-crank whose block and walls are rigid (model.md 13), as the lanes integrate it: corners fly, meet their walls in impacts without
/// duration (`settle`), and are held there by a constraint as long as that pushes.
struct RigidPlanarSliderCrank : RigidLanes<PlanarBase> {
    template <class Real> using Report = RigidPlanarReport<Real>;
    template <class Real> using Memory = RigidMemory<Real>;
    template <class Real> using Watch = RigidWatch<Real>;
    template <class Real> using Observer = RigidObserver<Real, RigidPlanarReport>;
    static constexpr bool sees_contacts = false, has_patterns = false;  // its watch asks for forces

    bool friction = false;
    DrivePlan drive;
    LoadList loads;

    explicit constexpr RigidPlanarSliderCrank(Parts const& parts) : friction(parts.friction), drive(parts.drive), loads(parts.loads) {}

    SLIDEWAY_HD bool has_loads() const { return loads.count > 0; }

    /// Of a member; what a law needs of its restitution is not worked out.
    SLIDEWAY_FN static PlanarParameters<double> parameters(Inputs in) {
        double const restitution = in.restitution;
        in.restitution = 1;
        auto p = planar_parameters(in);
        p.restitution = restitution;
        return p;
    }

    /// Components of the state, a bit each.
    constexpr unsigned prescribed() const { return drive.turns_freely() ? 0 : info.prescribed; }

    /// Depth [m] up to which a corner that meets its wall is located: what rounding leaves of its height, as the crank's angle grows too.
    template <class Real> SLIDEWAY_FN static Real located(PlanarParameters<Real> const& p, Real end) {
        Real const turned = fma(p.rate_scale, end, Real(6.3));
        Real const rounding = Real(4 * 2.220446049250313e-16) * fma(p.crank_length, turned, p.rod_length);
        return fma(Real(2e-12), max(p.clearance, Real(1e-3) * p.rod_length), rounding);
    }
    template <class Real> SLIDEWAY_FN Real gap(Real t, Real const* s, PlanarParameters<Real> const& p, bool, int corner) const {
        return planar_gap(t, s, p, drive, {false, corner});
    }
    /// The bit of a corner among those that an impact `met`.
    static constexpr int met_bit(bool, int corner) { return corner; }

    /// Time derivative of the state.  @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE Faults<Real> derivative(Real t, Real const* s, PlanarParameters<Real> const& p, RigidMemory<Real> const& memory,
                                              Real* rates, RigidPlanarReport<Real>* report) const {
        Real const zero(0.0);
        PlanarLinks<Real> links(t, s, p, drive, loads);
        PlanarCorners<Real> corners(links, s, p);
        if constexpr (Full) begin_report(corners, memory, report->contact);
        // NaN in a lane whose angles are, whatever its neighbours touch.
        auto const nothing = corners.push_of_nothing();
        auto motion = links.accelerations(nothing.fx, nothing.fy, p);
        Real torque = nothing.torque + links.loads.torque;
        auto jammed = memory.jammed > zero;
        auto const held = (memory.held[0].side != zero) | (memory.held[1].side != zero);
        if (any(held)) {
            PlanarStance<Real> const stance(links, sincos(s[2]), memory.held[0].side, memory.held[1].side, p);
            auto centre = links.centre_acceleration(motion);
            using Settlement = PlanarSettlement<Real>;
            ContactState<Real> const state[2] = {Settlement::state_of(memory.held[0], p, friction), Settlement::state_of(memory.held[1], p, friction)};
            auto const force = stance.pair.solve(stance.acceleration(centre.x, centre.y, s[5], links.loads.torque / p.slider_inertia), {zero, zero}, state);
            auto const load = stance.load(force);
            auto const pushed = links.accelerations(load.x, load.y, p);
            motion.a1 = select(held, pushed.a1, motion.a1);
            motion.a2 = select(held, pushed.a2, motion.a2);
            motion.r1 = select(held, pushed.r1, motion.r1);
            torque = select(held, load.torque + links.loads.torque, torque);
            jammed = jammed | (held & (max(force.normal[0], force.normal[1]) > Real(jamming_force) * force_scale(p)));
            if constexpr (Full) tell(stance, links, s[5], force, state, p, report->contact);
        }
        rates[0] = links.w1;
        rates[1] = links.w2;
        rates[2] = s[5];
        rates[3] = motion.a1;
        rates[4] = motion.a2;
        rates[5] = select(memory.jammed > zero, Real(not_a_number), torque / p.slider_inertia);
        if constexpr (Full) links.tell(motion, s[5], p, *report);
        auto faults = Faults<Real>::none();
        faults.contact_domain = jammed;
        faults.geometry = (memory.begun == zero) & (corners.deepest() > Real(1e-6) * p.clearance);
        return faults;
    }

    /// What follows from where a step has ended: impacts, contacts that begin or end, and none of the drift of those that last.
    /// @param end of the run [s]  @param contact of the report there  @return lanes where state or contacts have changed
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> settle(Mask<Real> in, Real t, Real end, Real* s, PlanarParameters<Real> const& p, RigidMemory<Real>& memory,
                                        RigidPlanarContact<Real> const& contact) const {
        PlanarSettlement<Real> settlement(p, friction, drive, loads, located(p, end), end);
        return settlement.run(in, t, s, memory, contact);
    }

    /// Components of the state that are rates of the others, a bit each, and what the rates of those are.
    static constexpr unsigned rate_components = 0b111000;
    template <class Real> SLIDEWAY_FN static void put_place_rates(Real const* s, PlanarParameters<Real> const&, Real* rates) {
        for (int i = 0; i < 3; ++i) rates[i] = s[3 + i];
    }

    /// Impulses of a step of time stepping, as of a RigidSlider.
    template <class Real>
    SLIDEWAY_NOINLINE Mask<Real> push(Real t, Real h, Real const* s, Real* free, PlanarParameters<Real> const& p,
                                      RigidPlanarContact<Real>& contact) const {
        return PlanarStepImpulse<Real>(p, friction, drive).run(t, h, s, free, contact);
    }

private:
    /// Of corners that are not held.
    template <class Real>
    SLIDEWAY_FN static void begin_report(PlanarCorners<Real> const& corners, RigidMemory<Real> const& memory,
                                         RigidPlanarContact<Real>& contact) {
        Real const one(1.0), minus(-1.0), far(-1.0);
        auto const& d = corners.depth;
        contact.start(d, corners.rate);
        auto const& front = memory.held[0].side;
        auto const& rear = memory.held[1].side;
        contact.watched[0] = {select(front == one, far, d.a), select(front == minus, far, d.b), select(rear == minus, far, d.c),
                              select(rear == one, far, d.d)};
        for (int i = 0; i < 2; ++i) contact.pressure[i] = contact.grip[i] = one;
        contact.books = memory.books;
    }

    /// Of those that are.
    template <class Real>
    SLIDEWAY_FN void tell(PlanarStance<Real> const& stance, PlanarLinks<Real> const& links, Real spin, PairOf<Real> const& force,
                          ContactState<Real> const (&state)[2], PlanarParameters<Real> const& p, RigidPlanarContact<Real>& contact) const {
        Real const zero(0.0), one(1.0), minus(-1.0);
        auto const motion = stance.motion(links.vx, links.vy, spin);
        auto const of = [&](int i, Real side) { return select(stance.side[i] == side, force.normal[i], zero); };
        contact.normal_force[0] = {of(0, one), of(0, minus), of(1, minus), of(1, one)};
        for (int i = 0; i < 2; ++i) {
            Real const lost = select(state[i].closed & !state[i].sticks, negated(force.along[i]) * motion.along[i], zero);
            contact.friction_power = contact.friction_power + lost;
            Real const push = force.normal[i] / force_scale(p);
            contact.pressure[i] = select(state[i].closed, push, one);
            if (!friction) continue;
            Real const hold = (holding_coefficient(p.friction) * force.normal[i] - abs(force.along[i])) / force_scale(p);
            Real const slide = state[i].way * motion.along[i] / slip_scale(p);
            contact.grip[i] = select(state[i].sticks, hold, select(state[i].closed, slide, one));
        }
        contact.count_modes({state[0].closed, state[1].closed}, stance.side);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
