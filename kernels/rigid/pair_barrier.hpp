#pragma once

#include "kernels/math/dense_solve.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/touching_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs by Newton's method for (M13.11) with all its conditions made smooth,
///   Λ s = ν,  s = γ − target > 0,  Λ > 0;   T √(|v|² + ε²) = −μ Λ v,
/// where ν and ε fall to nothing (a primal-dual interior-point method; for T as Chan, Golub & Mulet 1999 do in total variation).  Some
/// fifteen steps, each six equations, whatever the pairs share: four apices on a face, or friction at the edge of sticking, where
/// sweeps from pair to pair need thousands.
template <class Guide, class Real> class PairBarrier {
public:
    using Pairs = JointPairs<Guide, Real>;
    static constexpr int most_steps = 30;
    static constexpr double settled = 3e-12;  // of the motion
    static constexpr double least = 1e-15;    // of Λ s at the start: below it rounding is all that moves

    /// @param rows `count` pairs, their loads overwritten in lanes `in`  @param before motion without loads  @param friction some pair may stick
    SLIDEWAY_HD PairBarrier(Pairs const& pairs, TouchingPair<Real>* rows, int count, Twist<Real> const& before, bool friction)
        : pairs_(pairs), rows_(rows), count_(count), before_(before), friction_(friction) {
        for (int k = 0; k < count; ++k) {
            pairs.feel(rows[k].pair.normal, felt_[k].normal);
            pairs.feel(rows[k].act, felt_[k].act);
            if (!friction) continue;
            for (int j = 0; j < 2; ++j) pairs.feel(rows[k].pair.slip[j], felt_[k].slip[j]);
        }
    }

    /// @return the motion after them
    SLIDEWAY_HD Twist<Real> solve(Mask<Real> in, Twist<Real> const& so_far) {
        Real const one(1.0);
        auto const all = in;
        begin(in);
        Real length = one, best(1e300);
        for (int step = 0; step < most_steps; ++step) {
            auto const missed = measure(in, moved());
            auto const better = in & (missed.largest < best);
            keep(better);
            best = select(better, missed.largest, best);
            // Next to the solution the equations become singular, and rounding leads away from it again.
            auto const lost = (best <= Real(1e-6) * size_) & (missed.largest > Real(100.0) * best);
            in = in & (missed.largest > Real(settled) * size_) & (missed.mean > Real(least) * first_) & !lost;
            if (none(in)) break;
            if (step > 0) tighten(length, missed.mean);
            length = advance(in);
        }
        take_kept(all);
        return select(all, moved(), so_far);
    }

private:
    /// What a pair moves and misses in the point of the moment, and its share of a step.
    struct Course {
        Real normal[6], act[6], slip[2][6];  // directions as the free velocities feel them
        Real slack, rate, v[2];      // s, γ⁺, slip [m/s]
        Real d_rate, d_slip[2];      // their changes
        Real best_normal, best[2];   // loads of the best point so far
    };
    struct Missed { Real largest, mean; };
    /// Linear equations of one pair: dΛ = c_n − k dγ,  dT = c_t − K dv + h dΛ.
    struct Local { Real c_n, k, c_t[2], K[2][2], h[2]; };

    SLIDEWAY_HD void begin(Mask<Real> in) {
        Real const zero(0.0), one(1.0);
        size_ = zero;
        Real near = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            size_ = max(size_, select(row.here, row.target - dot(row.pair.normal, before_), zero));
            near = near + slideway::count<Real>(row.here);
        }
        Real const share = size_ / max(near, one);
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            row.normal = select(in, select(row.here, share * row.per_own, zero), row.normal);
            for (auto& along : row.along) along = select(in, zero, along);
        }
        auto const after = moved();
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            felt_[k].slack = max(dot(row.pair.normal, after) - row.target, size_);
        }
        smooth_ = size_;
        barrier_ = Real(0.3) * share * size_;
        first_ = share * size_;
    }

    SLIDEWAY_HD void keep(Mask<Real> in) {
        for (int k = 0; k < count_; ++k) {
            auto& c = felt_[k];
            c.best_normal = select(in, rows_[k].normal, c.best_normal);
            for (int j = 0; j < 2; ++j) c.best[j] = select(in, rows_[k].along[j], c.best[j]);
        }
    }
    SLIDEWAY_HD void take_kept(Mask<Real> in) {
        for (int k = 0; k < count_; ++k) {
            auto const& c = felt_[k];
            rows_[k].normal = select(in, c.best_normal, rows_[k].normal);
            for (int j = 0; j < 2; ++j) rows_[k].along[j] = select(in, c.best[j], rows_[k].along[j]);
        }
    }

    /// Motion under the loads of the moment.
    SLIDEWAY_HD Twist<Real> moved() const {
        auto after = before_;
        for (int k = 0; k < count_; ++k) after = rows_[k].answer(after);
        return after;
    }

    /// How far the point is from the conditions, as a projected step would change it; the mean of Λ s, both as motion.
    SLIDEWAY_HD Missed measure(Mask<Real> in, Twist<Real> const& after) {
        Real const zero(0.0), one(1.0);
        Missed missed{zero, zero};
        Real near = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto& c = felt_[k];
            auto const here = in & row.here;
            c.rate = dot(row.pair.normal, after);
            Real const push = row.own * row.normal;
            missed.largest = max(missed.largest, select(here, abs(min(c.rate - row.target, push)), zero));
            missed.mean = missed.mean + select(here, push * c.slack, zero);
            near = near + slideway::count<Real>(here);
            if (!friction_) continue;
            for (int j = 0; j < 2; ++j) c.v[j] = dot(row.pair.slip[j], after) - row.hold[j];
            Real const wish[2] = {row.along[0] - c.v[0] * row.per_across, row.along[1] - c.v[1] * row.per_across};
            Real const share = share_within(wish, row.coefficient * row.normal);
            Real const change = max(abs(fms(share, wish[0], row.along[0])), abs(fms(share, wish[1], row.along[1])));
            missed.largest = max(missed.largest, select(here, change * row.across, zero));
        }
        missed.mean = missed.mean / max(near, one);
        return missed;
    }

    /// ν and ε follow what is left, the more the longer the last step was.
    SLIDEWAY_HD void tighten(Real length, Real mean) {
        Real const share = select(length > Real(0.9), Real(0.05), select(length > Real(0.5), Real(0.3), Real(0.8)));
        barrier_ = share * mean;
        auto const some = first_ > Real(0.0);
        smooth_ = max(min(smooth_, size_ * (barrier_ / select(some, first_, Real(1.0)))), Real(1e-13) * size_);
    }

    SLIDEWAY_HD Local local(TouchingPair<Real> const& row, Course const& c) const {
        Real const zero(0.0), one(1.0);
        Local l;
        Real const inverse = one / select(row.here, c.slack, one);
        l.k = select(row.here, row.normal * inverse, zero);
        Real const wanted = fms(barrier_ * row.per_own, inverse, row.normal);
        l.c_n = select(row.here, fnma(l.k, (c.rate - row.target) - c.slack, wanted), zero);
        if (!friction_) return l;
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
        Real matrix[6][6], change[6] = {zero, zero, zero, zero, zero, zero};
        pairs_.masses(matrix);
        Local locals[pair_count];
        for (int k = 0; k < count_; ++k) {
            locals[k] = local(rows_[k], felt_[k]);
            add(felt_[k], locals[k], matrix, change);
        }
        LuFactors<6, Real> factors;
        factors.factor(matrix);
        factors.solve(change);
        Real length = one;
        auto const keep_positive = [&](Mask<Real> here, Real value, Real by) {
            auto const falls = here & (by < zero);
            length = min(length, select(falls, Real(0.95) * value / select(falls, negated(by), one), one));
        };
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto& c = felt_[k];
            c.d_rate = along(c.normal, change);
            keep_positive(row.here, row.normal, fnma(locals[k].k, c.d_rate, locals[k].c_n));
            keep_positive(row.here, c.slack, c.d_rate + ((c.rate - row.target) - c.slack));
            if (!friction_) continue;
            for (int j = 0; j < 2; ++j) c.d_slip[j] = along(c.slip[j], change);
        }
        for (int k = 0; k < count_; ++k) go(in, length, locals[k], felt_[k], rows_[k]);
        return length;
    }

    /// Adds what a pair's linear equations make of the balance of momentum.
    SLIDEWAY_HD void add(Course const& c, Local const& l, Real (&matrix)[6][6], Real (&change)[6]) const {
        for (int i = 0; i < 6; ++i) {
            Real push = c.act[i];
            if (friction_) {
                push = fma(l.h[0], c.slip[0][i], fma(l.h[1], c.slip[1][i], push));
                change[i] = fma(l.c_t[0], c.slip[0][i], fma(l.c_t[1], c.slip[1][i], change[i]));
            }
            change[i] = fma(l.c_n, push, change[i]);
            Real const of_normal = l.k * push;
            for (int j = 0; j < 6; ++j) matrix[i][j] = fma(of_normal, c.normal[j], matrix[i][j]);
            if (!friction_) continue;
            Real const first = fma(c.slip[0][i], l.K[0][0], c.slip[1][i] * l.K[1][0]);
            Real const second = fma(c.slip[0][i], l.K[0][1], c.slip[1][i] * l.K[1][1]);
            for (int j = 0; j < 6; ++j) matrix[i][j] = fma(first, c.slip[0][j], fma(second, c.slip[1][j], matrix[i][j]));
        }
    }

    SLIDEWAY_HD static Real along(Real const (&direction)[6], Real const (&change)[6]) {
        Real sum = direction[0] * change[0];
        for (int i = 1; i < 6; ++i) sum = fma(direction[i], change[i], sum);
        return sum;
    }

    SLIDEWAY_HD void go(Mask<Real> in, Real length, Local const& l, Course& c, TouchingPair<Real>& row) const {
        auto const here = in & row.here;
        Real const push = fnma(l.k, c.d_rate, l.c_n);
        row.normal = select(here, fma(length, push, row.normal), row.normal);
        c.slack = select(here, fma(length, c.d_rate + ((c.rate - row.target) - c.slack), c.slack), c.slack);
        if (!friction_) return;
        Real drag[2];
        for (int i = 0; i < 2; ++i) {
            Real const step = fma(l.h[i], push, fnma(l.K[i][0], c.d_slip[0], fnma(l.K[i][1], c.d_slip[1], l.c_t[i])));
            drag[i] = fma(length, step, row.along[i]);
        }
        Real const share = share_within(drag, row.coefficient * row.normal);
        for (int i = 0; i < 2; ++i) row.along[i] = select(here, share * drag[i], row.along[i]);
    }

    Pairs const& pairs_;
    TouchingPair<Real>* rows_;
    int count_;
    Twist<Real> before_;
    bool friction_;
    Real size_, barrier_, smooth_, first_;
    Course felt_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
