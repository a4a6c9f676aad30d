#pragma once

#include "kernels/math/tangent.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/lasting_forces.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Keeps an offset from a slider to the pairs that last, as they keep the slider: it changes neither their gaps nor how fast these change, nor
/// the slips of pairs that stick.  What it takes away is what impulses of these pairs would.  Compiled once per instruction set, as a RigidJoint is.
template <class Real> class JointOffset {
public:
    using Number = Tangent<Real>;
    using Memory = RigidJointMemory<Number>;

    SLIDEWAY_FN JointOffset(Mask<Real> in, Memory const& memory, SliderParameters<Number> const& p, bool friction)
        : p_(p), friction_(friction), last_(LastingPairs<Number>::of(in, memory)), any_(last_.any()) {}

    /// Lanes with pairs that last.
    SLIDEWAY_FN Mask<Real> any() const { return any_; }

    /// @param at the state s, whose slopes are the offset.  A displacement is to gaps what a velocity is to their rates.
    SLIDEWAY_NOINLINE void keep_place(JointPairs<Number> const& at, Number* s) const;
    SLIDEWAY_NOINLINE void keep_velocity(JointPairs<Number> const& at, Number* s) const;

private:
    SLIDEWAY_FN static Number constant(Real const& value) { return {value, Real(0.0)}; }

    /// A motion without what the pairs take from it.
    SLIDEWAY_HD Twist<Number> rest(JointPairs<Number> const& at, Twist<Number> const& motion, Number const* coefficient) const {
        PairSolver<Number> pairs(at, motion);
        for (int i = 0; i < pair_count; ++i) {
            if (none(last_.held[i])) continue;
            auto& row = pairs.add(i);
            at.put_pair(i, row.pair);
            row.start(last_.held[i], Number(0.0));
        }
        pairs.rest(any_, last_.held, last_.sticks, coefficient);
        return pairs.after;
    }

    SliderParameters<Number> const& p_;
    bool const friction_;
    LastingPairs<Number> const last_;
    Mask<Real> const any_;
};

template <class Real> SLIDEWAY_HD void JointOffset<Real>::keep_place(JointPairs<Number> const& at, Number* s) const {
    auto const &roll = at.turning.angles.roll, &yaw = at.turning.angles.yaw;
    Number const zero(0.0), up = constant(s[6].slope) * constant(yaw.cos.value), aside = constant(s[5].slope);
    Number const turned = fnma(constant(s[6].slope), constant(yaw.sin.value), constant(s[4].slope));
    Number const sine = constant(roll.sin.value), cosine = constant(roll.cos.value);
    Twist<Number> const moved{{constant(at.x.slope), constant(s[0].slope), constant(s[1].slope)},
                              {turned, fma(up, sine, aside * cosine), fms(up, cosine, aside * sine)}};
    auto const kept = rest(at, moved, nullptr);
    Number turn[10];
    SliderTurning<Number> turning = at.turning;
    turning.omega = kept.angular;
    turning.pitch_rate = fma(kept.angular.y, sine, kept.angular.z * cosine) / yaw.cos;
    Vec3<Number> const no{zero, zero, zero};
    turning.put_rates(no, at.motion.axes, p_.inertia, p_.inverse_inertia, turn);
    auto const put = [this](Number& number, Number const& by) { number.slope = select(any_, by.value, number.slope); };
    put(s[0], kept.linear.y);
    put(s[1], kept.linear.z);
    for (int i = 4; i < 7; ++i) put(s[i], turn[i]);
}

template <class Real> SLIDEWAY_HD void JointOffset<Real>::keep_velocity(JointPairs<Number> const& at, Number* s) const {
    auto const kept = rest(at, at.velocity, friction_ ? &p_.joint.friction.kinetic_coefficient : nullptr);
    auto const put = [this](Number& number, Number const& by) { number.slope = select(any_, by.slope, number.slope); };
    put(s[2], kept.linear.y);
    put(s[3], kept.linear.z);
    put(s[7], kept.angular.x);
    put(s[8], kept.angular.y);
    put(s[9], kept.angular.z);
}

}  // namespace slideway::inline SLIDEWAY_ISA
