#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of the two contacts that a block between two walls may have at once, one at its front and one at its rear: along the wall's normal,
/// positive where the contact opens, and along the wall.  Velocities [m/s], accelerations [m/s²], forces [N] or impulses [N s].
template <class Real> struct PairOf {
    Real normal[2], along[2];

    SLIDEWAY_FN Real size() const { return (abs(normal[0]) + abs(normal[1])) + (abs(along[0]) + abs(along[1])); }
};
template <class Real> SLIDEWAY_FN PairOf<Real> select(Mask<Real> m, PairOf<Real> const& yes, PairOf<Real> const& no) {
    return {{select(m, yes.normal[0], no.normal[0]), select(m, yes.normal[1], no.normal[1])},
            {select(m, yes.along[0], no.along[0]), select(m, yes.along[1], no.along[1])}};
}

/// What a contact does.  @tparam Real may be in many lanes, each with its own
template <class Real> struct ContactState {
    Mask<Real> closed;
    Mask<Real> sticks;  // then it is closed
    Real way;           // sign of its slip, 0 where it sticks or is open
    Real drag;          // way times the coefficient of friction
};
template <class Real> SLIDEWAY_FN ContactState<Real> select(Mask<Real> m, ContactState<Real> const& yes, ContactState<Real> const& no) {
    auto const of = [m](Mask<Real> a, Mask<Real> b) -> Mask<Real> { return (m & a) | (negation(m) & b); };
    return {of(yes.closed, no.closed), of(yes.sticks, no.sticks), select(m, yes.way, no.way), select(m, yes.drag, no.drag)};
}

/// Two contacts of one rigid body: how each answers to forces in either.  With γ the velocities (or accelerations) of the contacts and Λ the
/// impulses (forces), γ_after = γ_before + G Λ, and G is what is stored here.  (M13.2)
template <class Real> struct ContactPair {
    Real nn[2][2];  // normal by normal [1/kg]
    Real tt[2][2];  // along by along
    Real nt[2][2];  // normal of the first index by what acts along of the second, and the other way round

    /// γ after forces in both contacts.
    SLIDEWAY_FN PairOf<Real> after(PairOf<Real> const& before, PairOf<Real> const& force) const {
        PairOf<Real> motion;
        for (int i = 0; i < 2; ++i) {
            Real const normal = fma(nn[i][0], force.normal[0], nn[i][1] * force.normal[1]);
            motion.normal[i] = before.normal[i] + fma(nt[i][0], force.along[0], fma(nt[i][1], force.along[1], normal));
            Real const along = fma(tt[i][0], force.along[0], tt[i][1] * force.along[1]);
            motion.along[i] = before.along[i] + fma(nt[0][i], force.normal[0], fma(nt[1][i], force.normal[1], along));
        }
        return motion;
    }

    /// The forces with which closed contacts come to `target` along their normals, those that stick to rest along the wall, and the
    /// others have none.  At most one of the two may stick.  Not finite where there are none.
    SLIDEWAY_FN PairOf<Real> solve(PairOf<Real> const& before, Real const (&target)[2], ContactState<Real> const (&state)[2]) const {
        Real const zero(0.0), one(1.0);
        auto const sticks = state[0].sticks | state[1].sticks;
        // Along the wall of the contact that sticks: along + Σ row_j N_j + own T = 0.
        auto const of_sticking = [&](Real first, Real second) { return select(state[0].sticks, first, second); };
        Real const own = of_sticking(tt[0][0], tt[1][1]);
        Real const inverse = select(sticks, one / select(sticks, own, one), zero);
        Real const along = of_sticking(before.along[0], before.along[1]);
        Real const row[2] = {of_sticking(nt[0][0], fnma(state[0].drag, tt[1][0], nt[0][1])),
                             of_sticking(fnma(state[1].drag, tt[0][1], nt[1][0]), nt[1][1])};
        Real a[2][2], b[2];
        for (int i = 0; i < 2; ++i) {
            Real const by_sticking = of_sticking(nt[i][0], nt[i][1]) * inverse;
            for (int j = 0; j < 2; ++j) {
                Real const slipping = fnma(state[j].drag, nt[i][j], nn[i][j]);
                Real const coupled = fnma(by_sticking, row[j], slipping);
                a[i][j] = select(state[i].closed & state[j].closed, coupled, i == j ? one : zero);
            }
            b[i] = select(state[i].closed, (target[i] - before.normal[i]) + by_sticking * along, zero);
        }
        Real const scale = one / fms(a[0][0], a[1][1], a[0][1] * a[1][0]);
        PairOf<Real> force;
        force.normal[0] = fms(b[0], a[1][1], b[1] * a[0][1]) * scale;
        force.normal[1] = fms(b[1], a[0][0], b[0] * a[1][0]) * scale;
        Real const stuck = negated(fma(row[0], force.normal[0], fma(row[1], force.normal[1], along))) * inverse;
        for (int i = 0; i < 2; ++i) {
            force.along[i] = select(state[i].sticks, stuck, negated(state[i].drag) * force.normal[i]);
        }
        return force;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
