#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/impact_energy.hpp"
#include "kernels/rigid/pair_choice.hpp"
#include "kernels/rigid/planar_stance.hpp"
#include "kernels/rigid/rigid_planar_report.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Impulses of a step of time stepping (M13.16) of the rigid planar slider-crank: of the corners that touch in its middle, with Newton's restitution of the
/// velocity at its start.
template <class Real> class PlanarStepImpulse {
public:
    SLIDEWAY_HD PlanarStepImpulse(PlanarParameters<Real> const& p, bool friction, DrivePlan const& drive)
        : p_(p), friction_(friction), drive_(drive) {}

    /// As RigidPlanarSliderCrank::push.
    SLIDEWAY_HD Mask<Real> run(Real t, Real h, Real const* s, Real* free, RigidPlanarContact<Real>& contact) {
        Real const zero(0.0);
        // Of a rate, and of where it leads to.
        auto const changed = [&](int i) { return fma(h, s[i] * s[i], abs(free[i] - s[i])); };
        find(h, fma(p_.crank_length, changed(3), fma(p_.rod_length, changed(4), p_.half_length * changed(5))), contact);
        contact.books = ImpactBooks<Real>::none();
        contact.count_modes(closed_, side_);
        if (none(near_[0] | near_[1])) return failed_;
        PlanarLinks<Real> links(t, free, p_, drive_, {});  // impulses alone
        PlanarStance<Real> const stance(links, sincos(free[2]), side_[0], side_[1], p_);
        auto const before = stance.motion(links.vx, links.vy, free[5]);
        // A corner that leaves by itself takes no part: one that the other throws back meets its wall in a step of its own, with its restitution.
        for (int i = 0; i < 2; ++i) near_[i] = near_[i] & (before.normal[i] < zero);
        Mask<Real> const touching = near_[0] | near_[1];
        if (none(touching)) return failed_;
        auto start_links = links;
        start_links.turn_at(s[3], s[4]);
        auto const start = stance.motion(start_links.vx, start_links.vy, s[5]);
        auto const impulse = solve(touching, stance.pair, before, start, contact);
        auto const load = stance.load(impulse);
        auto const change = links.response(load.x, load.y, p_);
        if (links.turns_freely) free[3] = select(touching, links.w1 + change.a1, free[3]);
        free[4] = select(touching, links.w2 + change.a2, free[4]);
        free[5] = select(touching, free[5] + load.torque / p_.slider_inertia, free[5]);
        if (!links.turns_freely) contact.books.work = select(touching, links.w1 * fms(change.m12, change.a2, change.r1), zero);
        book(start, stance.pair.after(before, impulse), impulse, contact);
        return failed_;
    }

private:
    /// Which corners touch.  @param change of the rates in the step without impulses [m/s]
    SLIDEWAY_HD void find(Real h, Real change, RigidPlanarContact<Real> const& contact) {
        auto const& d = contact.penetration[0];
        auto const& v = contact.rate[0];
        Mask<Real> const in = h > Real(0.0);
        Real const height = Real(-0.5) * h * change, rate_above[2] = {v.a, v.d}, rate_below[2] = {v.b, v.c};
        Real const above[2] = {d.a, d.d}, below[2] = {d.b, d.c};
        failed_ = mask_of<Real>(false);
        for (int i = 0; i < 2; ++i) {
            Real const depth = max(above[i], below[i]);
            side_[i] = select(above[i] >= below[i], Real(1.0), Real(-1.0));
            near_[i] = in & (depth >= Real(0.0));
            failed_ = failed_ | (near_[i] & (depth > p_.clearance));
            Real const rate = select(above[i] >= below[i], rate_above[i], rate_below[i]);
            closed_[i] = in & (depth >= height) & (abs(rate) <= change);
        }
    }

    /// @param before motion without impulses  @param start motion at the start of the step
    SLIDEWAY_HD PairOf<Real> solve(Mask<Real> touching, ContactPair<Real> const& pair, PairOf<Real> const& before, PairOf<Real> const& start,
                               RigidPlanarContact<Real>& contact) {
        Real const zero(0.0);
        auto question = PairQuestion<Real>::of(before, near_[0], near_[1], friction_ ? p_.friction.kinetic_coefficient : zero);
        for (int i = 0; i < 2; ++i) question.target[i] = negated(p_.restitution) * min(start.normal[i], zero);
        auto answer = PairChoice<Real>(pair, question).answer(friction_);
        Real const speed = before.size() + start.size();
        if (!friction_) {
            failed_ = failed_ | (touching & !answer.fits(speed));
            return answer.force;
        }
        // With e > 0 and friction there need not be impulses, and they may make energy: then those without restitution are what is left.
        Real const gain = energy_made(before, pair.after(before, answer.force), answer.force);
        auto const gains = touching & (gain > Real(1e-12) * energy_moved(before, answer.force)), none_fit = touching & !answer.fits(speed);
        if (any(gains | none_fit)) {
            question.target[0] = question.target[1] = zero;
            auto const dead = PairChoice<Real>(pair, question).answer(friction_);
            limit_energy(gains, pair, before, dead.force, answer.force);
            answer.force = select(none_fit, dead.force, answer.force);
            failed_ = failed_ | (none_fit & !dead.fits(speed));
            contact.books.capped = count<Real>(gains | none_fit);
        }
        return answer.force;
    }

    /// Losses, impulses and modes.
    SLIDEWAY_HD void book(PairOf<Real> const& start, PairOf<Real> const& end, PairOf<Real> const& impulse, RigidPlanarContact<Real>& contact) {
        Real const zero(0.0), half(0.5);
        auto& books = contact.books;
        for (int i = 0; i < 2; ++i) {
            auto const add = [&](Real& sum, Real amount) { sum = select(near_[i], sum + amount, sum); };
            add(books.friction, negated(half * (start.along[i] + end.along[i])) * impulse.along[i]);
            add(books.damping, negated(half * (start.normal[i] + end.normal[i])) * impulse.normal[i]);
            add(books.impulse, impulse.normal[i]);
            closed_[i] = closed_[i] | (near_[i] & (impulse.normal[i] > zero));
        }
        contact.count_modes(closed_, side_);
    }

    PlanarParameters<Real> const& p_;
    bool friction_;
    DrivePlan const& drive_;
    Real side_[2];
    Mask<Real> near_[2], failed_;
    Mask<Real> closed_[2];  // where a corner pushes, or is no farther and no faster than the step makes it without impulses
};

}  // namespace slideway::inline SLIDEWAY_ISA
