#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs as of equal, very stiff springs, whose compliance ε is then made up for:
///   Λ = max(0, Λ⁰ + (target − γ)/ε),   T = the part within μ Λ of T⁰ − (v − hold)/ε,                                        (M13.13)
/// first with Λ⁰ = T⁰ = 0, then with what that gave, until (M13.11) holds (the method of multipliers).  Each is solved by Newton's method with
/// the pairs that push and stick as found so far.  Where (M13.11) leaves open which pair carries what, this is the share of equal springs
/// under a rigid slider.
template <class Guide, class Real> class PairNewton : PairMotion<Guide, Real> {
    using Base = PairMotion<Guide, Real>;
    using typename Base::Local;
    using Base::count_, Base::course_, Base::friction_, Base::rows_;

public:
    static constexpr int most_steps = 16;
    static constexpr double unchanged = 1e-5;  // of the motion: Λ is that of its springs

    using Base::Base;

    /// From the loads that the rows have.
    /// @param size of the motion  @param enough what of it counts as none  @param bearable what does where no step makes it less
    /// @param after the motion, changed in lanes that are solved  @return lanes that are not
    SLIDEWAY_HD Mask<Real> solve(Mask<Real> in, Real size, Real enough, Real bearable, Twist<Real>& after) {
        begin();
        Real last(1e300);
        for (int turn = 0; turn < most_steps; ++turn) {
            auto const motion = this->moved();
            Real const missed = this->measure(in, motion);
            Real const borne = bearable_under<Real>(rows_, count_, [&](int k) { return rows_[k].normal; }, size, bearable);
            // The loads at the start are never good enough: what they leave would add up over steps.
            auto const done = in & mask_of<Real>(turn > 0) & ((missed <= enough) | ((missed <= borne) & (missed > Real(0.5) * last)));
            last = missed;
            after = slideway::select(done, motion, after);
            in = in & !done;
            if (none(in)) break;
            Real const off = look(turn == 0);
            take_for_start(in & (off <= Real(unchanged) * size));
            // Without friction to find, the equations change with the pairs that push alone.
            if (friction_ || any(in & changed_)) this->factor(local_);
            this->step(local_);
            for (int k = 0; k < count_; ++k) go(in, k);
        }
        return in;
    }

private:
    SLIDEWAY_HD void begin() {
        Real const zero(0.0);
        for (int k = 0; k < count_; ++k) normal_[k] = along_[0][k] = along_[1][k] = zero;
        Real const own = this->largest_own([&](int k) { return rows_[k].here; });
        auto const some = own > zero;
        stiff_ = select(some, Real(Base::stiffness) / select(some, own, Real(1.0)), zero);
    }

    /// The linear equations of all pairs.  @return the largest change of a motion that the laws ask for at once
    SLIDEWAY_HD Real look(bool first) {
        Real const zero(0.0);
        Real off = zero;
        changed_ = mask_of<Real>(first);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const& c = course_[k];
            auto& l = local_[k];
            Real const spring = fma(stiff_, row.target - c.rate, normal_[k]);
            auto const pushes = row.here & ((first ? row.normal : spring) > zero);
            Real const stiff = select(pushes, stiff_, zero);
            if (!first) changed_ = changed_ | (stiff != l.k);
            l.k = stiff;
            l.c_n = select(pushes, spring - row.normal, select(row.here, negated(row.normal), zero));
            off = max(off, select(row.here, abs(l.c_n) * row.own, zero));
            if (friction_) off = max(off, look_along(k, pushes));
        }
        return off;
    }

    /// Of friction, as Alart & Curnier 1991: what T − (v − hold)/own tells sticks, or slips that way.
    SLIDEWAY_HD Real look_along(int k, Mask<Real> pushes) {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const& c = course_[k];
        auto& l = local_[k];
        Real pull[2], spring[2];
        for (int j = 0; j < 2; ++j) {
            pull[j] = fnma(row.per_across, c.v[j], row.along[j]);
            spring[j] = fnma(stiff_, c.v[j], along_[j][k]) - row.along[j];
        }
        Real const bound = row.coefficient * max(row.normal, zero), length = sqrt(fma(pull[0], pull[0], pull[1] * pull[1]));
        auto const holds = pushes & (row.coefficient > zero);
        auto const sticks = holds & (length <= bound), slips = holds & !sticks;
        Real const inverse = select(slips, one / select(slips, length, one), zero), share = bound * inverse;
        Real const rest = one / max(one - share, Real(1.0 / Base::stiffness)), damping = share * rest * row.per_across;
        Real const unit[2] = {pull[0] * inverse, pull[1] * inverse};
        Real const lies = fma(row.along[0], unit[0], row.along[1] * unit[1]);
        for (int i = 0; i < 2; ++i) {
            l.h[i] = row.coefficient * unit[i];
            Real const turn = rest * fnma(lies, unit[i], row.along[i]), wanted = fms(bound - lies, unit[i], turn);
            l.c_t[i] = select(sticks, spring[i], select(slips, wanted, select(row.here, negated(row.along[i]), zero)));
            for (int j = 0; j < 2; ++j) {
                Real const across = i == j ? fnma(unit[i], unit[j], one) : negated(unit[i] * unit[j]);
                l.K[i][j] = select(sticks, i == j ? stiff_ : zero, select(slips, damping * across, zero));
            }
        }
        return select(row.here, max(abs(l.c_t[0]), abs(l.c_t[1])) * row.across, zero);
    }

    /// From here on Λ⁰ and T⁰ are the loads of the moment, and their springs are as they are.
    SLIDEWAY_HD void take_for_start(Mask<Real> in) {
        if (none(in)) return;
        Real const zero(0.0);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const& c = course_[k];
            auto& l = local_[k];
            auto const pushes = in & (l.k > zero);
            normal_[k] = select(pushes, row.normal, normal_[k]);
            l.c_n = select(pushes, stiff_ * (row.target - c.rate), l.c_n);
            if (!friction_) continue;
            // What slips has its direction from its slip alone, and has to be linearised anew.
            auto const sticks = pushes & (l.h[0] == zero) & (l.h[1] == zero) & (row.coefficient > zero);
            for (int j = 0; j < 2; ++j) {
                along_[j][k] = select(sticks, row.along[j], along_[j][k]);
                l.c_t[j] = select(sticks, negated(stiff_ * c.v[j]), l.c_t[j]);
            }
        }
    }

    SLIDEWAY_HD void go(Mask<Real> in, int k) {
        auto& row = rows_[k];
        auto const& c = course_[k];
        auto const& l = local_[k];
        auto const here = in & row.here;
        Real const push = Base::push(l, c);
        if (friction_) {
            for (int i = 0; i < 2; ++i) row.along[i] = select(here, row.along[i] + Base::drag(l, c, push, i), row.along[i]);
        }
        row.normal = select(here, row.normal + push, row.normal);
    }

    Real stiff_;
    Mask<Real> changed_;
    Real normal_[pair_count], along_[2][pair_count];  // Λ⁰, T⁰
    Local local_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
