#pragma once

#include "kernels/math/tangent.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/pair_solver.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/slider_place.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Keeps an offset from a slider to the pairs that last, as they keep the slider: it changes neither their gaps nor how fast these change, nor
/// the slips of pairs that stick.  What it takes away is what impulses of these pairs would.
template <class Guide, class Real> class JointOffset {
public:
    using Number = Tangent<Real>;
    using Memory = RigidJointMemory<Number>;

    SLIDEWAY_HD JointOffset(SliderParameters<Number> const& p, bool misaligned, bool friction) : p_(p), misaligned_(misaligned), friction_(friction) {}

    /// @param s a state, whose slopes are the offset
    SLIDEWAY_HD void keep(Mask<Real> in, Number const& t, Number* s, Memory const& memory) {
        Number const half(0.5);
        auto some = mask_of<Real>(false);
        for (int i = 0; i < pair_count; ++i) {
            held_[i] = in & (number_of(memory.held, i) > half);
            sticks_[i] = held_[i] & (number_of(memory.sticks, i) > half);
            some = some | held_[i];
        }
        if (none(some)) return;
        keep_place(some, t, s);
        keep_velocity(some, t, s);
    }

private:
    /// A displacement is to gaps what a velocity is to their rates.
    SLIDEWAY_HD void keep_place(Mask<Real> in, Number const& t, Number* s) const {
        auto faults = Faults<Number>::none();
        SliderPlace<Guide, Number> const at(t, s, p_, misaligned_, faults);
        auto const &roll = at.turning.angles.roll, &yaw = at.turning.angles.yaw;
        Number const zero(0.0), up = constant(s[6].slope) * constant(yaw.cos.value), aside = constant(s[5].slope);
        Number const turned = fnma(constant(s[6].slope), constant(yaw.sin.value), constant(s[4].slope));
        Number const sine = constant(roll.sin.value), cosine = constant(roll.cos.value);
        Twist<Number> const moved{{constant(at.guide.x.slope), constant(s[0].slope), constant(s[1].slope)},
                                  {turned, fma(up, sine, aside * cosine), fms(up, cosine, aside * sine)}};
        auto const kept = rest(in, at, moved, nullptr);
        Number turn[10];
        SliderTurning<Number> turning = at.turning;
        turning.omega = kept.angular;
        turning.pitch_rate = fma(kept.angular.y, sine, kept.angular.z * cosine) / yaw.cos;
        Vec3<Number> const no{zero, zero, zero};
        turning.put_rates(no, at.motion.axes, p_.inertia, p_.inverse_inertia, turn);
        auto const put = [in](Number& number, Number const& by) { number.slope = select(in, by.value, number.slope); };
        put(s[0], kept.linear.y);
        put(s[1], kept.linear.z);
        for (int i = 4; i < 7; ++i) put(s[i], turn[i]);
    }

    SLIDEWAY_HD void keep_velocity(Mask<Real> in, Number const& t, Number* s) const {
        auto faults = Faults<Number>::none();
        SliderPlace<Guide, Number> const at(t, s, p_, misaligned_, faults);
        auto const kept = rest(in, at, at.velocity, friction_ ? &p_.joint.friction.kinetic_coefficient : nullptr);
        auto const put = [in](Number& number, Number const& by) { number.slope = select(in, by.slope, number.slope); };
        put(s[2], kept.linear.y);
        put(s[3], kept.linear.z);
        put(s[7], kept.angular.x);
        put(s[8], kept.angular.y);
        put(s[9], kept.angular.z);
    }

    SLIDEWAY_FN static Number constant(Real const& value) { return {value, Real(0.0)}; }

    /// A motion without what the pairs take from it.
    SLIDEWAY_NOINLINE Twist<Number> rest(Mask<Real> in, SliderPlace<Guide, Number> const& at, Twist<Number> const& motion,
                                         Number const* coefficient) const {
        PairSolver<Guide, Number> pairs(at.pairs, motion);
        for (int i = 0; i < pair_count; ++i) {
            if (none(held_[i])) continue;
            auto& row = pairs.add(i);
            at.pairs.put_pair(i, row.pair);
            row.start(held_[i], Number(0.0));
        }
        pairs.rest(in, held_, sticks_, coefficient);
        return pairs.after;
    }

    SliderParameters<Number> const& p_;
    bool const misaligned_, friction_;
    Mask<Real> held_[pair_count], sticks_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
