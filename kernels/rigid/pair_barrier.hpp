#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs by Newton's method for (M13.11) with all its conditions made smooth,
///   Λ s = ν,  s = γ − target > 0,  Λ > 0;   T √(|v|² + ε²) = −μ Λ v,
/// where ν and ε fall to nothing (a primal-dual interior-point method; for T as Chan, Golub & Mulet 1999 do in total variation).  Some
/// fifteen steps, whatever the pairs share: four apices on a face, or friction at the edge of sticking, where sweeps from pair to pair
/// need thousands.
template <class Guide, class Real> class PairBarrier : PairMotion<Guide, Real> {
    using Base = PairMotion<Guide, Real>;
    using typename Base::Local;
    using Base::count_, Base::course_, Base::rows_;

public:
    static constexpr int most_steps = 30;
    static constexpr double settled = 3e-12;  // of the motion
    static constexpr double least = 1e-15;    // of Λ s at the start: below it rounding is all that moves

    using Base::Base;

    /// @param size of the motion: the most that a pair without loads is off its target  @return the motion after them
    SLIDEWAY_HD Twist<Real> solve(Mask<Real> in, Real size, Twist<Real> const& so_far) {
        Real const one(1.0);
        auto const all = in;
        size_ = size;
        begin(in);
        Real length = one, best(1e300);
        for (int step = 0; step < most_steps; ++step) {
            Real const missed = this->measure(in, this->moved()), product = mean_product(in);
            auto const better = in & (missed < best);
            keep(better);
            best = select(better, missed, best);
            // Next to the solution the equations become singular, and rounding leads away from it again.
            auto const lost = (best <= Real(1e-6) * size_) & (missed > Real(100.0) * best);
            in = in & (missed > Real(settled) * size_) & (product > Real(least) * first_) & !lost;
            if (none(in)) break;
            if (step > 0) tighten(length, product);
            length = advance(in);
        }
        take_kept(all);
        return select(all, this->moved(), so_far);
    }

private:
    struct Loads { Real normal, along[2]; };

    SLIDEWAY_HD void begin(Mask<Real> in) {
        Real const zero(0.0), one(1.0);
        Real near = zero;
        for (int k = 0; k < count_; ++k) near = near + slideway::count<Real>(rows_[k].here);
        Real const share = size_ / max(near, one);
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            row.normal = select(in, select(row.here, share * row.per_own, zero), row.normal);
            for (auto& along : row.along) along = select(in, zero, along);
        }
        auto const after = this->moved();
        for (int k = 0; k < count_; ++k) slack_[k] = max(dot(rows_[k].pair.normal, after) - rows_[k].target, size_);
        smooth_ = size_;
        barrier_ = Real(0.3) * share * size_;
        first_ = share * size_;
    }

    SLIDEWAY_HD void keep(Mask<Real> in) {
        for (int k = 0; k < count_; ++k) {
            best_[k].normal = select(in, rows_[k].normal, best_[k].normal);
            for (int j = 0; j < 2; ++j) best_[k].along[j] = select(in, rows_[k].along[j], best_[k].along[j]);
        }
    }
    SLIDEWAY_HD void take_kept(Mask<Real> in) {
        for (int k = 0; k < count_; ++k) {
            rows_[k].normal = select(in, best_[k].normal, rows_[k].normal);
            for (int j = 0; j < 2; ++j) rows_[k].along[j] = select(in, best_[k].along[j], rows_[k].along[j]);
        }
    }

    /// The mean of Λ s, as motion.
    SLIDEWAY_HD Real mean_product(Mask<Real> in) const {
        Real const zero(0.0), one(1.0);
        Real sum = zero, near = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const here = in & row.here;
            sum = sum + select(here, row.own * row.normal * slack_[k], zero);
            near = near + slideway::count<Real>(here);
        }
        return sum / max(near, one);
    }

    /// ν and ε follow what is left, the more the longer the last step was.
    SLIDEWAY_HD void tighten(Real length, Real mean) {
        Real const share = select(length > Real(0.9), Real(0.05), select(length > Real(0.5), Real(0.3), Real(0.8)));
        barrier_ = share * mean;
        auto const some = first_ > Real(0.0);
        smooth_ = max(min(smooth_, size_ * (barrier_ / select(some, first_, Real(1.0)))), Real(1e-13) * size_);
    }

    SLIDEWAY_HD Local local(int k) const {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const& c = course_[k];
        Local l;
        Real const inverse = one / select(row.here, slack_[k], one);
        l.k = select(row.here, row.normal * inverse, zero);
        Real const wanted = fms(barrier_ * row.per_own, inverse, row.normal);
        l.c_n = select(row.here, fnma(l.k, (c.rate - row.target) - slack_[k], wanted), zero);
        if (!this->friction_) return l;
        Real const square = fma(c.v[0], c.v[0], fma(c.v[1], c.v[1], smooth_ * smooth_));
        Real const inverse_speed = select(row.here, one / sqrt(select(row.here, square, one)), zero);
        Real const drag = row.coefficient * inverse_speed, damping = drag * row.normal, turn = inverse_speed * inverse_speed;
        for (int i = 0; i < 2; ++i) {
            l.h[i] = negated(drag) * c.v[i];
            l.c_t[i] = select(row.here, fms(l.h[i], row.normal, row.along[i]), zero);
            for (int j = 0; j < 2; ++j) l.K[i][j] = fma(row.along[i] * turn, c.v[j], i == j ? damping : zero);
        }
        return l;
    }

    /// A step of Newton's method.  @return the share of it that keeps Λ and s above zero
    SLIDEWAY_HD Real advance(Mask<Real> in) {
        Real const zero(0.0), one(1.0);
        Local locals[pair_count];
        for (int k = 0; k < count_; ++k) locals[k] = local(k);
        this->factor(locals);
        this->step(locals);
        Real length = one;
        auto const keep_positive = [&](Mask<Real> here, Real value, Real by) {
            auto const falls = here & (by < zero);
            length = min(length, select(falls, Real(0.95) * value / select(falls, negated(by), one), one));
        };
        for (int k = 0; k < count_; ++k) {
            keep_positive(rows_[k].here, rows_[k].normal, Base::push(locals[k], course_[k]));
            keep_positive(rows_[k].here, slack_[k], widening(k));
        }
        for (int k = 0; k < count_; ++k) go(in, length, locals[k], k);
        return length;
    }
    /// What a step makes of s.
    SLIDEWAY_HD Real widening(int k) const {
        auto const& c = course_[k];
        return c.d_rate + ((c.rate - rows_[k].target) - slack_[k]);
    }

    SLIDEWAY_HD void go(Mask<Real> in, Real length, Local const& l, int k) {
        auto& row = rows_[k];
        auto const here = in & row.here;
        Real const push = Base::push(l, course_[k]);
        row.normal = select(here, fma(length, push, row.normal), row.normal);
        slack_[k] = select(here, fma(length, widening(k), slack_[k]), slack_[k]);
        if (!this->friction_) return;
        Real drag[2];
        for (int i = 0; i < 2; ++i) drag[i] = fma(length, Base::drag(l, course_[k], push, i), row.along[i]);
        Real const share = share_within(drag, row.coefficient * row.normal);
        for (int i = 0; i < 2; ++i) row.along[i] = select(here, share * drag[i], row.along[i]);
    }

    Real size_, barrier_, smooth_, first_;
    Real slack_[pair_count];   // s
    Loads best_[pair_count];   // of the best point so far
};

}  // namespace slideway::inline SLIDEWAY_ISA
