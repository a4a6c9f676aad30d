#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/joint_impact.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Impulses of a step of time stepping (M13.16): of all pairs that touch in its middle, with Newton's restitution of the velocity at its start.
template <class Real> class JointStepImpulse {
public:
    /// @param h of the step [s]  @param change of the rates in it without impulses [m/s]  @param contact of the report in its middle
    SLIDEWAY_HD JointStepImpulse(Real h, Real change, RigidJointContact<Real> const& contact, SliderParameters<Real> const& p) {
        Real const zero(0.0), height = Real(-0.5) * h * change;
        Mask<Real> const in = h > zero;
        touching_ = failed_ = mask_of<Real>(false);
        for (int i = 0; i < pair_count; ++i) {
            Real const depth = number_of(contact.penetration, i);
            near_[i] = in & (depth >= zero);
            touching_ = touching_ | near_[i];
            failed_ = failed_ | (near_[i] & (depth > (i < pair_count / 2 ? p.length_scale_y : p.length_scale_z)));
            auto const hovers = in & (depth >= height) & (abs(number_of(contact.rate, i)) <= change);
            number_of(closed_, i) = count<Real>(hovers);
        }
    }

    /// Pairs that leave by themselves take no part: one that another throws back meets its face in a step of its own, with its restitution.
    /// @param contact with the rates that the step would end with
    SLIDEWAY_HD void keep_meeting(RigidJointContact<Real> const& contact) {
        touching_ = mask_of<Real>(false);
        for (int i = 0; i < pair_count; ++i) {
            near_[i] = near_[i] & (number_of(contact.rate, i) > Real(0.0));
            touching_ = touching_ | near_[i];
        }
    }

    /// Lanes with anything to do.
    SLIDEWAY_FN Mask<Real> touching() const { return touching_; }

    /// @param at in the middle of the step, with the velocity that it has without impulses  @param start velocity at its start
    /// @param coefficient μ, or nullptr without friction  @return the velocity at its end
    SLIDEWAY_HD Twist<Real> solve(JointPairs<Real> const& at, Twist<Real> const& start, Real restitution, Real const* coefficient, Real least_speed) {
        JointImpact<Real> impact(at, at.velocity, near_, coefficient, least_speed, &start);
        Real each[pair_count];
        for (auto& e : each) e = restitution;
        impact.solve(touching_, each);
        auto& pairs = impact.pairs;
        failed_ = failed_ | (touching_ & pairs.failed);
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            Real& closed = number_of(closed_, row.number);
            closed = select(row.here & (row.normal > Real(0.0)), Real(1.0), closed);
        }
        rest(pairs, least_speed, coefficient);
        books_ = impact.books();
        return pairs.after;
    }

    /// Puts books and modes of the impulses into the contact.  @return lanes where there are none that satisfy the conditions
    SLIDEWAY_HD Mask<Real> tell(RigidJointContact<Real>& contact) const {
        contact.books = ImpactBooks<Real>::none();
        contact.books.take(touching_, books_);
        contact.take_modes(closed_);
        return failed_;
    }

private:
    /// Ends what the solver leaves of the motion of pairs that rest, and of the slip of those that stick: it would add up from step to step.
    SLIDEWAY_HD void rest(PairSolver<Real>& pairs, Real least_speed, Real const* coefficient) const {
        Mask<Real> rests[pair_count], still[pair_count];
        auto any_rests = mask_of<Real>(false);
        for (int i = 0; i < pair_count; ++i) rests[i] = still[i] = any_rests;
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            rests[row.number] = row.here & (row.normal > Real(0.0)) & (dot(row.pair.normal, pairs.after) <= least_speed);
            any_rests = any_rests | rests[row.number];
            Real const hold = row.coefficient * row.normal, drag = fma(row.along[0], row.along[0], row.along[1] * row.along[1]);
            still[row.number] = rests[row.number] & (drag < Real(1 - 1e-9) * (hold * hold));
        }
        if (any(any_rests)) pairs.rest(touching_ & any_rests, rests, still, coefficient);
    }

    Mask<Real> near_[pair_count], touching_, failed_;
    Quad<Real> closed_[face_count];  // 1 where a pair pushes, or is no farther and no faster than the step makes it without impulses; else 0
    ImpactBooks<Real> books_ = ImpactBooks<Real>::none();
};

}  // namespace slideway::inline SLIDEWAY_ISA
