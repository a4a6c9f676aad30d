#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_barrier.hpp"
#include "kernels/rigid/touching_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of all pairs that touch at once:
///   Λ ≥ 0 ⊥ γ − target ≥ 0,   T = −μ Λ v/|v| where v ≠ 0,   |T| ≤ μ Λ where v = 0,                                      (M13.11)
/// by projected Gauss–Seidel steps from pair to pair (Jourdan, Alart & Jean 1998), which is all that one or two pairs need, and where
/// they are slow by a PairBarrier.  Each lane takes as many as its own numbers ask for.
template <class Guide, class Real> class PairSolver {
public:
    using Pairs = JointPairs<Guide, Real>;
    static constexpr int most_last_sweeps = 24, most_sweeps_of_rest = 1000;
    static constexpr double well_enough = 1e-4;  // of the motion: a change of it that is no failure yet

    Twist<Real> before, after;  // motion of the slider without loads and with them
    Mask<Real> failed;

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
    /// @param enough change of the motion that counts as none  @param sweeps to take at most before the barrier  @param friction some pair may stick
    SLIDEWAY_HD void solve(Mask<Real> in, Real enough, int sweeps, bool friction) {
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
            after = row.answer(after);
        }
        Real change = zero;
        for (int sweep = 0; sweep < sweeps && any(active); ++sweep) {
            change = this->sweep(active, friction);
            active = active & (change > enough);
        }
        failed = mask_of<Real>(false);
        if (none(active)) return;
        after = PairBarrier<Guide, Real>(pairs_, rows_, count_, before, friction).solve(active, after);
        for (int sweep = 0; sweep < most_last_sweeps && any(active); ++sweep) {
            change = this->sweep(active, friction);
            active = active & (change > enough);
        }
        failed = active & !(change <= Real(well_enough) * size);
    }

    /// Takes from pairs that rest what is left of their normal motion, with the friction of the bounces that would have done so, and from those
    /// that are still what is left of their slip: next to nothing, whichever way it goes.
    /// @param coefficient μ, or nullptr without friction
    SLIDEWAY_HD void rest(Mask<Real> in, Mask<Real> const (&rests)[pair_count], Mask<Real> const (&still)[pair_count], Real const* coefficient) {
        Real const zero(0.0);
        Real size = zero, drag[2][pair_count];
        auto const see = [&](Mask<Real> of, Twist<Real> const& direction) { size = max(size, select(of, abs(dot(direction, after)), zero)); };
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            see(rests[row.number], row.pair.normal);
            for (auto const& slip : row.pair.slip) see(still[row.number], slip);
            drag[0][k] = drag[1][k] = zero;
            if (coefficient != nullptr) find_drag(row, rests[row.number] & !still[row.number], *coefficient, drag[0][k], drag[1][k]);
        }
        auto active = in & (size > zero);
        for (int sweep = 0; sweep < most_sweeps_of_rest && any(active); ++sweep) {
            Real change = zero;
            for (int k = 0; k < count_; ++k) {
                auto& row = rows_[k];
                auto const pushed = fma(drag[0][k], row.pair.dragged[0], fma(drag[1][k], row.pair.dragged[1], row.pair.pushed));
                Real const step = stop(active & rests[row.number], row.pair.normal, pushed, change);
                row.normal = row.normal + step;
                for (int j = 0; j < 2; ++j) {
                    Real const held = stop(active & still[row.number], row.pair.slip[j], row.pair.dragged[j], change);
                    row.along[j] = row.along[j] + fma(step, drag[j][k], held);
                }
            }
            active = active & (change > Real(1e-13) * size);
        }
    }

    /// Of all pairs on the slider.
    SLIDEWAY_HD Twist<Real> load() const {
        auto sum = Twist<Real>::zero();
        for (int k = 0; k < count_; ++k) sum = sum + rows_[k].load();
        return sum;
    }

private:
    /// Friction per unit load of a pair that slips; none where it outweighs the push.
    SLIDEWAY_HD void find_drag(TouchingPair<Real> const& row, Mask<Real> slips, Real coefficient, Real& first, Real& second) const {
        Real const zero(0.0), one(1.0);
        Real const slip[2] = {dot(row.pair.slip[0], after), dot(row.pair.slip[1], after)};
        Real const square = fma(slip[0], slip[0], slip[1] * slip[1]);
        auto const moves = slips & (square > zero);
        Real const share = select(moves, negated(coefficient) / sqrt(select(moves, square, one)), zero);
        Real const by_friction = share * fma(slip[0], dot(row.pair.normal, row.pair.dragged[0]), slip[1] * dot(row.pair.normal, row.pair.dragged[1]));
        Real const own = dot(row.pair.normal, row.pair.pushed);
        auto const tame = own + by_friction > Real(0.1) * own;
        first = select(tame, share * slip[0], zero);
        second = select(tame, share * slip[1], zero);
    }

    /// A step that ends the motion along a direction.  @return its load
    SLIDEWAY_HD Real stop(Mask<Real> in, Twist<Real> const& direction, Twist<Real> const& pushed, Real& change) {
        Real const own = dot(direction, pushed);
        Real const step = select(in, negated(dot(direction, after)) / own, Real(0.0));
        after = fma(step, pushed, after);
        change = max(change, abs(step) * own);
        return step;
    }

    /// From pair to pair.  @return the largest change of a motion
    SLIDEWAY_HD Real sweep(Mask<Real> in, bool friction) {
        Real change(0.0);
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            auto const here = in & row.here;
            Real const wish = (row.target - dot(row.pair.normal, after)) * row.per_own;
            Real const step = select(here, max(wish, negated(row.normal)), Real(0.0));
            row.normal = row.normal + step;
            after = fma(step, row.pushed, after);
            change = max(change, abs(step) * row.own);
            if (friction) change = max(change, hold(row, here));
        }
        return change;
    }

    /// A step of the friction of one pair.  @return its largest change of a motion
    SLIDEWAY_HD Real hold(TouchingPair<Real>& row, Mask<Real> here) {
        Real const zero(0.0);
        auto const& pair = row.pair;
        Real wish[2], change[2];
        for (int j = 0; j < 2; ++j) wish[j] = row.along[j] - (dot(pair.slip[j], after) - row.hold[j]) * row.per_across;
        Real const share = share_within(wish, row.coefficient * row.normal);
        for (int j = 0; j < 2; ++j) {
            change[j] = select(here, fms(share, wish[j], row.along[j]), zero);
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
