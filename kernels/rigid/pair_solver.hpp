#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/arc_path.hpp"
#include "kernels/rigid/direct_loads.hpp"
#include "kernels/rigid/long_steps.hpp"
#include "kernels/rigid/pair_rest.hpp"
#include "kernels/rigid/spring_loads.hpp"
#include "kernels/rigid/touching_pair.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of all pairs that touch at once:
///   Λ ≥ 0 ⊥ γ − target ≥ 0,   T = −μ Λ v/|v| where v ≠ 0,   |T| ≤ μ Λ where v = 0,                                      (M13.11)
/// by SpringLoads, in an impact after two sweeps from pair to pair, while contact lasts after one linear system of at most six pairs of which none sticks
/// (DirectLoads), and where those find nothing along a path that leads to them, in LongSteps or by its arc (ArcPath).
template <class Real> class PairSolver {
public:
    using Pairs = JointPairs<Real>;
    using Springs = SpringLoads<Real>;
    static constexpr int sweeps = 2;  // of an impact
    static constexpr int turns = 10;  // of springs, from each start

    Twist<Real> before, after;  // motion of the slider without loads and with them
    Mask<Real> failed;

    SLIDEWAY_HD PairSolver(Pairs const& pairs, Twist<Real> const& motion) : before(motion), after(motion), pairs_(pairs) {}

    /// One more pair, to be filled in.
    SLIDEWAY_FN TouchingPair<Real>& add(int number) {
        SLIDEWAY_EXPECT(count_ < pair_count && number >= 0 && number < pair_count && (count_ == 0 || number > rows_[count_ - 1].number));
        auto& row = rows_[count_++];
        row.number = number;
        return row;
    }
    SLIDEWAY_FN int count() const { return count_; }
    SLIDEWAY_FN TouchingPair<Real>& row(int k) { return rows_[k]; }
    SLIDEWAY_FN TouchingPair<Real> const& row(int k) const { return rows_[k]; }

    /// From the loads that the rows have.
    /// @param enough change of the motion that counts as none  @param bearable one that does where it cannot be made less
    /// @param friction some pair may stick  @param lasts the loads are those of contact that lasts: nearly always all pairs push
    SLIDEWAY_HD void solve(Mask<Real> in, Real enough, Real bearable, bool friction, bool lasts) {
        SLIDEWAY_EXPECT(none(bearable < enough));
        Real const zero(0.0);
        after = before;
        Real size = zero;
        for (int k = 0; k < count_; ++k) size = max(size, select(rows_[k].here, lack(k), zero));
        auto active = in & (size > zero);
        failed = mask_of<Real>(false);
        // Without loads nothing comes nearer than it may: then there are none.
        clear(!active);
        if (none(active)) return;
        LoadGoal<Real> const goal{size, enough, lasts ? max(bearable, Real(4.0) * unevenness(size)) : bearable};
        if (lasts) {
            active = DirectLoads<Real>(rows_, count_, before).solve(active, goal, after);
        } else {
            for (int sweep = 0; sweep < sweeps && any(active); ++sweep) active = active & !(take_sweep(active, friction) <= enough);
        }
        for (auto const start : {Springs::Start::loads, Springs::Start::multipliers, Springs::Start::all}) {
            if (none(active)) return;
            active = Springs(pairs_, rows_, count_, before, friction).solve(active, start, turns, goal, after);
        }
        if (none(active)) return;
        active = LongSteps<Real>(pairs_, rows_, count_, before, friction, goal).solve(active, after);
        if (any(active)) active = ArcPath<Real>(pairs_, rows_, count_, before, friction, goal).solve(active, after);
        failed = active;
        clear(failed);
        after = select(failed, before, after);
    }

    /// What a pair without loads is off its target.
    SLIDEWAY_FN Real lack(int k) const { return rows_[k].target - dot(rows_[k].pair.normal, before); }

    /// The most that rounding leaves of b₀ − b₁ + b₂ − b₃ on a face all of whose apices push while contact lasts, b being `lack`: they lie in a plane, and no
    /// loads end that.
    SLIDEWAY_HD Real unevenness(Real size) const {
        Real most(0.0);
        for (int i = 3; i < count_; ++i) {
            auto const whole = ends_whole_face(rows_, i);
            if (any(whole)) most = max(most, select(whole, abs((lack(i - 3) - lack(i - 2)) + (lack(i - 1) - lack(i))), Real(0.0)));
        }
        return select(most <= Real(1e-9) * size, most, Real(0.0));
    }

    /// Ends what is left of the motion of pairs that rest, and of the slip of those that are still (PairRest).
    SLIDEWAY_HD void rest(Mask<Real> in, Mask<Real> const (&rests)[pair_count], Mask<Real> const (&still)[pair_count], Real const* coefficient) {
        after = PairRest<Real>(pairs_, rows_, count_, before, coefficient != nullptr).solve(in, rests, still, coefficient, after);
    }

    /// Of all pairs on the slider.
    SLIDEWAY_HD Twist<Real> load() const {
        auto sum = Twist<Real>::zero();
        for (int k = 0; k < count_; ++k) sum = sum + rows_[k].load();
        return sum;
    }

private:
    /// A step of projection from pair to pair (Jourdan, Alart & Jean 1998), which tells those that push and is all that one needs.
    /// @return the largest change of a motion
    SLIDEWAY_HD Real take_sweep(Mask<Real> in, bool friction) {
        Real const zero(0.0);
        Real change = zero;
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            auto const here = in & row.here;
            Real const wish = (row.target - dot(row.pair.normal, after)) * row.per_own;
            Real const step = select(here, max(wish, negated(row.normal)), zero);
            row.normal = row.normal + step;
            after = fma(step, row.pushed, after);
            change = max(change, abs(step) * row.own);
            if (!friction) continue;
            Real drag[2];
            for (int j = 0; j < 2; ++j) drag[j] = row.along[j] - (dot(row.pair.slip[j], after) - row.hold[j]) * row.per_across;
            Real const share = share_within(drag, row.coefficient * row.normal);
            for (int j = 0; j < 2; ++j) {
                Real const by = select(here, fms(share, drag[j], row.along[j]), zero);
                row.along[j] = row.along[j] + by;
                after = fma(by, row.pair.dragged[j], after);
                change = max(change, abs(by) * row.across);
            }
        }
        // Of numbers that are none the largest may be one.
        Real const whole = dot(after, after);
        return change + (whole - whole);
    }

    SLIDEWAY_HD void clear(Mask<Real> in) {
        for (int k = 0; k < count_; ++k) {
            for (auto* load : {&rows_[k].normal, &rows_[k].along[0], &rows_[k].along[1]}) *load = select(in, Real(0.0), *load);
        }
    }

    Pairs const& pairs_;
    TouchingPair<Real> rows_[pair_count];
    int count_ = 0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
