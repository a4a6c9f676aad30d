#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/direct_loads.hpp"
#include "kernels/rigid/pair_barrier.hpp"
#include "kernels/rigid/pair_newton.hpp"
#include "kernels/rigid/pair_path.hpp"
#include "kernels/rigid/pair_rest.hpp"
#include "kernels/rigid/touching_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of all pairs that touch at once:
///   Λ ≥ 0 ⊥ γ − target ≥ 0,   T = −μ Λ v/|v| where v ≠ 0,   |T| ≤ μ Λ where v = 0,                                      (M13.11)
/// by projected Gauss–Seidel steps from pair to pair (Jourdan, Alart & Jean 1998), which is all that one or two pairs need, and where
/// they are slow by a PairBarrier.  Each lane takes as many as its own numbers ask for.
template <class Guide, class Real> class PairSolver {
public:
    using Pairs = JointPairs<Guide, Real>;
    static constexpr int most_last_sweeps = 24;
    static constexpr int first_lot = 32;         // of sweeps where all else has failed
    static constexpr double well_enough = 1e-4;  // of the motion: a change of it that is no failure yet
    static constexpr double far_enough = 1e-9;   // and one with which to stop while there still is patience
    static constexpr double eased = 0.3;         // share of a step

    Twist<Real> before, after;  // motion of the slider without loads and with them
    Mask<Real> failed;
    bool follows_path = true;  // where nothing else settles

    SLIDEWAY_HD PairSolver(Pairs const& pairs, Twist<Real> const& motion) : before(motion), after(motion), pairs_(pairs) {}

    /// One more pair, to be filled in.
    SLIDEWAY_FN TouchingPair<Real>& add(int number) {
        auto& row = rows_[count_++];
        row.number = number;
        return row;
    }
    SLIDEWAY_FN int count() const { return count_; }
    SLIDEWAY_FN TouchingPair<Real>& row(int k) { return rows_[k]; }
    SLIDEWAY_FN TouchingPair<Real> const& row(int k) const { return rows_[k]; }

    /// From the loads that the rows have.
    /// @param enough change of the motion that counts as none  @param bearable one that does where it cannot be made less
    /// @param sweeps to begin with  @param patience the most in one lot where nothing else settles  @param friction some pair may stick
    SLIDEWAY_HD void solve(Mask<Real> in, Real enough, Real bearable, int sweeps, int patience, bool friction) {
        Real const zero(0.0);
        after = before;
        Real size = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            size = max(size, select(row.here, row.target - dot(row.pair.normal, before), zero));
        }
        auto active = in & (size > zero);
        // Without loads nothing comes nearer than it may: then there are none.
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            for (auto* load : {&row.normal, &row.along[0], &row.along[1]}) *load = select(active, *load, zero);
            if (sweeps > 0) after = row.answer(after);
        }
        // Where no sweep is to come first the loads are those of contact that lasts: nearly always all pairs push.
        if (sweeps == 0 && any(active)) active = DirectLoads<Real>(rows_, count_, before).solve(active, size, bearable, after);
        Real change = zero;
        for (int sweep = 0; sweep < sweeps && any(active); ++sweep) {
            change = this->sweep(active, friction);
            active = active & (change > enough);
        }
        failed = mask_of<Real>(false);
        if (none(active)) return;
        active = PairNewton<Guide, Real>(pairs_, rows_, count_, before, friction).solve(active, size, enough, bearable, after);
        if (none(active)) return;
        after = PairBarrier<Guide, Real>(pairs_, rows_, count_, before, friction).solve(active, size, after);
        for (int sweep = 0; sweep < most_last_sweeps && any(active); ++sweep) {
            change = this->sweep(active, friction);
            active = active & !(change <= enough);
        }
        active = active & !(change <= Real(well_enough) * size);
        if (any(active)) active = persist(active, size, enough, bearable, patience, friction);
        if (follows_path && any(active)) active = PairPath<Guide, Real>(pairs_, rows_, count_, before, friction).solve(active, size, Real(well_enough) * size, after);
        failed = active;
    }

    /// Ends what is left of the motion of pairs that rest, and of the slip of those that are still (PairRest).
    SLIDEWAY_HD void rest(Mask<Real> in, Mask<Real> const (&rests)[pair_count], Mask<Real> const (&still)[pair_count], Real const* coefficient) {
        after = PairRest<Guide, Real>(pairs_, rows_, count_, before, coefficient != nullptr).solve(in, rests, still, coefficient, after);
    }

    /// Of all pairs on the slider.
    SLIDEWAY_HD Twist<Real> load() const {
        auto sum = Twist<Real>::zero();
        for (int k = 0; k < count_; ++k) sum = sum + rows_[k].load();
        return sum;
    }

private:
    /// Where neither method settles: more and more sweeps, after each lot of which Newton's method begins anew where they have come to.
    /// Every second lot goes but a part of the way, which ends the cycles that large friction makes.  @return lanes that still are not solved
    SLIDEWAY_HD Mask<Real> persist(Mask<Real> active, Real size, Real enough, Real bearable, int patience, bool friction) {
        bool eases = true;
        for (int lot = first_lot; lot <= patience && any(active); lot *= 2, eases = !eases) {
            Real change(0.0);
            for (int sweep = 0; sweep < lot && any(active); ++sweep) {
                change = this->sweep(active, friction, Real(eases ? eased : 1.0));
                active = active & !(change <= enough);
            }
            active = active & !(change <= Real(lot < patience ? far_enough : well_enough) * size);
            if (any(active)) active = try_newton(active, size, enough, bearable, friction);
        }
        return active;
    }

    /// From the loads of the moment, which stay where it does not solve them.
    SLIDEWAY_HD Mask<Real> try_newton(Mask<Real> active, Real size, Real enough, Real bearable, bool friction) {
        Real kept[3][pair_count];
        for (int k = 0; k < count_; ++k) kept[0][k] = rows_[k].normal, kept[1][k] = rows_[k].along[0], kept[2][k] = rows_[k].along[1];
        active = PairNewton<Guide, Real>(pairs_, rows_, count_, before, friction).solve(active, size, enough, bearable, after);
        for (int k = 0; k < count_; ++k) {
            rows_[k].normal = select(active, kept[0][k], rows_[k].normal);
            for (int j = 0; j < 2; ++j) rows_[k].along[j] = select(active, kept[1 + j][k], rows_[k].along[j]);
        }
        return active;
    }

    /// From pair to pair.  @param share of the way of each step  @return the largest change of a motion
    SLIDEWAY_HD Real sweep(Mask<Real> in, bool friction, Real share = Real(1.0)) {
        Real change(0.0);
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            auto const here = in & row.here;
            Real const wish = (row.target - dot(row.pair.normal, after)) * row.per_own;
            Real const step = select(here, share * max(wish, negated(row.normal)), Real(0.0));
            row.normal = row.normal + step;
            after = fma(step, row.pushed, after);
            change = max(change, abs(step) * row.own);
            if (friction) change = max(change, hold(row, here, share));
        }
        return change;
    }

    /// A step of the friction of one pair.  @return its largest change of a motion
    SLIDEWAY_HD Real hold(TouchingPair<Real>& row, Mask<Real> here, Real part) {
        Real const zero(0.0);
        auto const& pair = row.pair;
        Real wish[2], change[2];
        for (int j = 0; j < 2; ++j) wish[j] = row.along[j] - (dot(pair.slip[j], after) - row.hold[j]) * row.per_across;
        Real const share = share_within(wish, row.coefficient * row.normal);
        for (int j = 0; j < 2; ++j) {
            change[j] = select(here, part * fms(share, wish[j], row.along[j]), zero);
            row.along[j] = row.along[j] + change[j];
            after = fma(change[j], pair.dragged[j], after);
        }
        return max(abs(change[0]), abs(change[1])) * row.across;
    }

    Pairs const& pairs_;
    TouchingPair<Real> rows_[pair_count];
    int count_ = 0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
