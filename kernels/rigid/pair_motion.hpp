#pragma once

#include "kernels/math/dense_solve.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/touching_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Pairs whose loads are sought, the motion under the loads of the moment, and a step of Newton's method for both: six equations for
/// the free velocities, whatever the number of pairs.
template <class Real> class PairMotion {
public:
    using Pairs = JointPairs<Real>;

    /// @param rows `count` pairs, whose loads are overwritten  @param before motion without loads  @param friction some pair may stick
    SLIDEWAY_HD PairMotion(Pairs const& pairs, TouchingPair<Real>* rows, int count, Twist<Real> const& before, bool friction)
        : pairs_(pairs), rows_(rows), count_(count), before_(before), friction_(friction) {
        for (int k = 0; k < count; ++k) {
            pairs.feel(rows[k].pair.normal, course_[k].normal);
            pairs.feel(rows[k].act, course_[k].act);
            if (!friction) continue;
            for (int j = 0; j < 2; ++j) pairs.feel(rows[k].pair.slip[j], course_[k].slip[j]);
        }
    }

protected:
    /// Linear equations of one pair: dΛ = c_n − k dγ,  dT = c_t − K dv + h dΛ.
    struct Local { Real c_n, k, c_t[2], K[2][2], h[2]; };
    /// A pair's directions as the free velocities feel them, how it moves, and how a step changes that.
    struct Course {
        Real normal[6], act[6], slip[2][6];
        Real rate, v[2];
        Real d_rate, d_slip[2];
    };

    /// 1/ε of (M13.13), of what a pair's own load makes of its motion.
    static constexpr double stiffness = 1e7;

    /// Loads of all pairs, put aside and back.
    SLIDEWAY_HD void keep_loads(Real (&kept)[3][pair_count], Mask<Real> in = mask_of<Real>(true)) const {
        for (int k = 0; k < count_; ++k) {
            kept[0][k] = select(in, rows_[k].normal, kept[0][k]);
            for (int j = 0; j < 2; ++j) kept[1 + j][k] = select(in, rows_[k].along[j], kept[1 + j][k]);
        }
    }
    SLIDEWAY_HD void put_loads(Mask<Real> in, Real const (&kept)[3][pair_count]) {
        for (int k = 0; k < count_; ++k) {
            rows_[k].normal = select(in, kept[0][k], rows_[k].normal);
            for (int j = 0; j < 2; ++j) rows_[k].along[j] = select(in, kept[1 + j][k], rows_[k].along[j]);
        }
    }

    /// The most that the load along the normal of one of some pairs makes of its motion [1/kg]; 0 where none is.  @param counts lanes of row k
    template <class Counts> SLIDEWAY_HD Real largest_own(Counts const& counts) const {
        Real const zero(0.0);
        Real own = zero;
        for (int k = 0; k < count_; ++k) own = max(own, select(counts(k), dot(rows_[k].pair.normal, rows_[k].pair.pushed), zero));
        return own;
    }

    /// Motion under the loads of the moment.
    SLIDEWAY_HD Twist<Real> moved() const {
        auto after = before_;
        for (int k = 0; k < count_; ++k) after = rows_[k].answer(after);
        return after;
    }

    /// Fills in how the pairs move.  @return how far they are from (M13.11), as a projected step would change the motion
    SLIDEWAY_HD Real measure(Mask<Real> in, Twist<Real> const& after) {
        Real const zero(0.0);
        Real missed = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto& c = course_[k];
            auto const here = in & row.here;
            c.rate = dot(row.pair.normal, after);
            missed = max(missed, select(here, abs(min(c.rate - row.target, row.own * row.normal)), zero));
            if (!friction_) continue;
            for (int j = 0; j < 2; ++j) c.v[j] = dot(row.pair.slip[j], after) - row.hold[j];
            Real const wish[2] = {row.along[0] - c.v[0] * row.per_across, row.along[1] - c.v[1] * row.per_across};
            Real const share = share_within(wish, row.coefficient * row.normal);
            Real const change = max(abs(fms(share, wish[0], row.along[0])), abs(fms(share, wish[1], row.along[1])));
            missed = max(missed, select(here, change * row.across, zero));
        }
        // Of numbers that are none the largest may be one.
        Real const whole = dot(after, after);
        return missed + (whole - whole);
    }

    /// The balance of momentum, M du = Σ dΛ n + dT t, with what `locals` make of it.
    SLIDEWAY_HD void factor(Local const* locals) {
        Real matrix[6][6];
        pairs_.masses(matrix);
        for (int k = 0; k < count_; ++k) stiffen(course_[k], locals[k], matrix);
        factors_.factor(matrix);
    }
    /// Changes of the motion by a step.
    SLIDEWAY_HD void step(Local const* locals) {
        Real const zero(0.0);
        Real change[6] = {zero, zero, zero, zero, zero, zero};
        for (int k = 0; k < count_; ++k) drive(course_[k], locals[k], change);
        factors_.solve(change);
        for (int k = 0; k < count_; ++k) {
            auto& c = course_[k];
            c.d_rate = along(c.normal, change);
            if (!friction_) continue;
            for (int j = 0; j < 2; ++j) c.d_slip[j] = along(c.slip[j], change);
        }
    }
    SLIDEWAY_FN static Real push(Local const& l, Course const& c) { return fnma(l.k, c.d_rate, l.c_n); }
    SLIDEWAY_FN static Real drag(Local const& l, Course const& c, Real push, int i) {
        return fma(l.h[i], push, fnma(l.K[i][0], c.d_slip[0], fnma(l.K[i][1], c.d_slip[1], l.c_t[i])));
    }

    /// Takes a share of the step to the loads of one pair.
    SLIDEWAY_HD void add_step(Mask<Real> in, int k, Local const& l, Real share) {
        auto& row = rows_[k];
        auto const& c = course_[k];
        auto const here = in & row.here;
        Real const by = push(l, c);
        row.normal = select(here, fma(share, by, row.normal), row.normal);
        if (!friction_) return;
        for (int i = 0; i < 2; ++i) row.along[i] = select(here, fma(share, drag(l, c, by, i), row.along[i]), row.along[i]);
    }

    Pairs const& pairs_;
    TouchingPair<Real>* rows_;
    int count_;
    Twist<Real> before_;
    bool friction_;
    Course course_[pair_count];

private:
    SLIDEWAY_HD void stiffen(Course const& c, Local const& l, Real (&matrix)[6][6]) const {
        for (int i = 0; i < 6; ++i) {
            Real push = c.act[i];
            if (friction_) push = fma(l.h[0], c.slip[0][i], fma(l.h[1], c.slip[1][i], push));
            Real const of_normal = l.k * push;
            for (int j = 0; j < 6; ++j) matrix[i][j] = fma(of_normal, c.normal[j], matrix[i][j]);
            if (!friction_) continue;
            Real const first = fma(c.slip[0][i], l.K[0][0], c.slip[1][i] * l.K[1][0]);
            Real const second = fma(c.slip[0][i], l.K[0][1], c.slip[1][i] * l.K[1][1]);
            for (int j = 0; j < 6; ++j) matrix[i][j] = fma(first, c.slip[0][j], fma(second, c.slip[1][j], matrix[i][j]));
        }
    }
    SLIDEWAY_HD void drive(Course const& c, Local const& l, Real (&change)[6]) const {
        for (int i = 0; i < 6; ++i) {
            Real push = c.act[i];
            if (friction_) {
                push = fma(l.h[0], c.slip[0][i], fma(l.h[1], c.slip[1][i], push));
                change[i] = fma(l.c_t[0], c.slip[0][i], fma(l.c_t[1], c.slip[1][i], change[i]));
            }
            change[i] = fma(l.c_n, push, change[i]);
        }
    }
    SLIDEWAY_HD static Real along(Real const (&direction)[6], Real const (&change)[6]) {
        Real sum = direction[0] * change[0];
        for (int i = 1; i < 6; ++i) sum = fma(direction[i], change[i], sum);
        return sum;
    }

    LuFactors<6, Real> factors_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
