#pragma once

#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/twist.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A pair among those that push at once, in an impact or for a while: loads Λ and what they make of the normal motion γ and the slip v.
/// Velocities and impulses in an impact, accelerations and forces in lasting contact.
template <class Real> struct TouchingPair {
    int number;           // of sixteen
    Mask<Real> here;      // lanes in which it may push
    JointPair<Real> pair;
    Twist<Real> act;      // of a unit load: along the normal, and the friction of a slip that is known
    Twist<Real> pushed;   // what the slider makes of it
    Real own, across;     // change of γ by a unit load; at most, of the slip by a unit of friction [1/kg]
    Real per_own, per_across;  // 1/own, 1/across
    Real target;          // what γ may not fall below
    Real hold[2];         // what the slip of a pair that sticks is to come to
    Real coefficient;     // of what friction can hold, 0 where the slip is known
    Real normal, along[2];  // loads

    /// Of a `pair` without friction, or which has it as the loads find it.
    SLIDEWAY_FN void start(Mask<Real> in, Real holding) {
        Real const zero(0.0);
        here = in;
        act = pair.normal;
        pushed = pair.pushed;
        coefficient = holding;
        hold[0] = hold[1] = zero;
        normal = along[0] = along[1] = zero;
        own = across = per_own = per_across = Real(1.0);
    }
    /// With the kinetic friction of a known slip v.
    SLIDEWAY_FN void slide(Mask<Real> in, Real kinetic, Real const (&v)[2]) {
        Real const square = fma(v[0], v[0], v[1] * v[1]);
        auto const moves = in & (square > Real(0.0));
        Real const share = select(moves, negated(kinetic) / sqrt(select(moves, square, Real(1.0))), Real(0.0)), drag[2] = {share * v[0], share * v[1]};
        act = select(in, fma(drag[0], pair.slip[0], fma(drag[1], pair.slip[1], act)), act);
        pushed = select(in, fma(drag[0], pair.dragged[0], fma(drag[1], pair.dragged[1], pushed)), pushed);
    }
    /// With a change of γ by a unit load.
    SLIDEWAY_FN void weigh(Real by_load) {
        SLIDEWAY_EXPECT(none(here & (by_load < Real(0.0))));
        own = by_load;
        per_own = Real(1.0) / by_load;
    }
    /// With the changes of the slip, which count where friction is to be found.
    SLIDEWAY_FN void weigh_along() {
        Real const first = dot(pair.slip[0], pair.dragged[0]), second = dot(pair.slip[1], pair.dragged[1]);
        across = max(first, second) + abs(dot(pair.slip[0], pair.dragged[1]));
        per_across = Real(1.0) / across;
    }
    /// Of all its loads together.
    SLIDEWAY_FN Twist<Real> load() const {
        return fma(along[0], pair.slip[0], fma(along[1], pair.slip[1], normal * act));
    }
    SLIDEWAY_FN Twist<Real> answer(Twist<Real> const& so_far) const {
        return fma(along[0], pair.dragged[0], fma(along[1], pair.dragged[1], fma(normal, pushed, so_far)));
    }
};

/// Lanes in which a row and the three before it are the pairs of one face, and all may push.  Rows are in the order of their pairs.
template <class Real> SLIDEWAY_FN Mask<Real> ends_whole_face(TouchingPair<Real> const* rows, int i) {
    if (i < 3 || rows[i].number % 4 != 3 || rows[i - 3].number != rows[i].number - 3) return mask_of<Real>(false);
    return (rows[i - 3].here & rows[i - 2].here) & (rows[i - 1].here & rows[i].here);
}

/// Of a search for loads.
template <class Real> struct LoadGoal {
    Real size;      // of the motion: the most that a pair without loads is off its target
    Real enough;    // what the conditions may be missed by, as motion
    Real bearable;  // and where it cannot be made less
};

/// What the conditions of pairs may be missed by where it cannot be made less: `bearable`, or what rounding leaves of the motion that loads large
/// beside it make and take away again.  Loads that have run away have no such excuse.
/// @param load of row k, a function
template <class Real, class Load> SLIDEWAY_HD Real bearable_under(TouchingPair<Real> const* rows, int count, Load const& load, LoadGoal<Real> const& goal) {
    Real moved(0.0);
    for (int k = 0; k < count; ++k) moved = max(moved, select(rows[k].here, rows[k].own * load(k), Real(0.0)));
    return select(moved <= Real(1e6) * goal.size, max(goal.bearable, Real(1e-13) * moved), goal.bearable);
}

/// The share of a vector that is no longer than `bound`.
template <class Real> SLIDEWAY_FN Real share_within(Real const (&of)[2], Real bound) {
    Real const length = sqrt(fma(of[0], of[0], of[1] * of[1]));
    auto const outside = length > bound;
    return select(outside, bound / select(outside, length, Real(1.0)), Real(1.0));
}

}  // namespace slideway::inline SLIDEWAY_ISA
