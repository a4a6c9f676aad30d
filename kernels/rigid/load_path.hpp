#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"
#include "kernels/rigid/spring_loads.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A path of loads from a problem that is easy to (M13.11), from whose points SpringLoads find its solution:
///   Λ s = ν,  s = γ − target > 0,  Λ > 0;   T √(|v|² + (s/μ)²) = −μ Λ v,                                                  (M13.14)
/// whose ν falls to nothing; for T as Chan, Golub & Mulet 1999 do in total variation.  Where springs find none, what comes to within `well_enough` of it
/// stands in its place.
template <class Real> class LoadPath : protected PairMotion<Real> {
    using Base = PairMotion<Real>;

public:
    static constexpr double well_enough = 1e-4;  // of the motion
    static constexpr int spring_turns = 16;

    SLIDEWAY_HD LoadPath(JointPairs<Real> const& pairs, TouchingPair<Real>* rows, int count, Twist<Real> const& before, bool friction, LoadGoal<Real> const& goal)
        : Base(pairs, rows, count, before, friction), goal_(goal), best_(Real(well_enough) * goal.size), found_(mask_of<Real>(false)) {}

protected:
    using Base::count_, Base::rows_;
    using typename Base::Local;

    /// SpringLoads from the point of the path, whose pairs with own Λ < s are about to part and lose their loads first: at first the loads tell no more than
    /// which pairs push, then they are Λ⁰ and T⁰.  s is that of the last step, before it.  @return lanes that these do not solve, whose loads stay as they are
    SLIDEWAY_HD Mask<Real> polish(Mask<Real> in, Twist<Real>& after) {
        Real kept[3][pair_count] = {};
        this->keep_loads(kept);
        for (auto const start : {SpringLoads<Real>::Start::loads, SpringLoads<Real>::Start::multipliers}) {
            if (none(in)) break;
            for (int k = 0; k < count_; ++k) {
                auto& row = rows_[k];
                auto const goes = in & (row.own * row.normal < slack_[k]);
                for (auto* load : {&row.normal, &row.along[0], &row.along[1]}) *load = select(goes, Real(0.0), *load);
            }
            in = SpringLoads<Real>(this->pairs_, rows_, count_, this->before_, this->friction_).solve(in, start, spring_turns, goal_, after);
            this->put_loads(in, kept);
        }
        return in;
    }

    /// Loads to begin with: without friction, and each makes as much of its own pair's motion.
    SLIDEWAY_HD void push_equally(Mask<Real> in, Real motion) {
        Real const zero(0.0);
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            row.normal = select(in, select(row.here, motion * row.per_own, zero), row.normal);
            for (auto& along : row.along) along = select(in, zero, along);
        }
    }

    /// What is nearest to (M13.11) so far, if it is near enough.  @param missed by how much
    SLIDEWAY_HD void note(Mask<Real> in, Real missed) {
        auto const better = in & (missed < best_);
        best_ = select(better, missed, best_);
        found_ = found_ | better;
        if (any(better)) this->keep_loads(near_, better);
    }
    /// @return lanes in which nothing is near enough
    SLIDEWAY_HD Mask<Real> take_nearest(Mask<Real> in, Twist<Real>& after) {
        auto const close = in & found_;
        this->put_loads(close, near_);
        after = slideway::select(close, this->moved(), after);
        return in & !close;
    }

    /// The largest slip without loads of a pair that can stick, or `least`.
    SLIDEWAY_HD Real largest_slip(Real least) const {
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const holds = row.here & (row.coefficient > Real(0.0));
            for (int j = 0; j < 2; ++j) least = max(least, select(holds, abs(dot(row.pair.slip[j], this->before_) - row.hold[j]), Real(0.0)));
        }
        return least;
    }
    /// Of the lanes' pairs.
    SLIDEWAY_HD Real number_of_pairs() const {
        Real near(0.0);
        for (int k = 0; k < count_; ++k) near = near + slideway::count<Real>(rows_[k].here);
        return max(near, Real(1.0));
    }

    /// Friction of T √(|v|² + (s/μ)²) = −μ Λ v about a slip v and a width s/μ > 0, of which s changes as Λ s = ν has it.
    /// @return (s/μ)²/(|v|² + (s/μ)²)
    SLIDEWAY_HD Real put_cone(int k, Real const (&v)[2], Real slack, Real normal, Real const (&along)[2], Local& l) const {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const holds = row.here & (row.coefficient > zero);
        Real const width = slack / select(holds, row.coefficient, one);
        Real const square = fma(v[0], v[0], fma(v[1], v[1], width * width));
        Real const inverse = one / sqrt(select(holds, square, one)), inverse_square = select(holds, inverse * inverse, zero);
        Real const drag = select(holds, row.coefficient * inverse, zero), damping = drag * normal, narrows = width * width * inverse_square;
        for (int i = 0; i < 2; ++i) {
            l.h[i] = fma(along[i], narrows / select(holds, normal, one), negated(drag) * v[i]);
            for (int j = 0; j < 2; ++j) l.K[i][j] = fma(along[i] * inverse_square, v[j], i == j ? damping : zero);
        }
        return narrows;
    }

    LoadGoal<Real> const goal_;
    Real slack_[pair_count];  // s = γ − target
    Local local_[pair_count];

private:
    Real best_;                      // by how much the nearest loads so far miss (M13.11)
    Mask<Real> found_;               // lanes with such loads
    Real near_[3][pair_count] = {};  // these
};

}  // namespace slideway::inline SLIDEWAY_ISA
