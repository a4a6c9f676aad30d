#pragma once

#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/pair_problem.hpp"
#include "kernels/rigid/rigid_memory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The block with the two corners at which it may touch its walls: with a clearance above zero one in front and one behind at most.
/// Corner i has its place (ρx, ρy) from the block's centre and the side of its wall,
///   γ_N = −side (y' + ρx ψ'),   γ_T = x' − ρy ψ',                                            (M13.1)
/// and a force N away from the wall and T along X acts by (T, −side N) on the centre, by −side ρx N − ρy T on the turning.
template <class Real> struct PlanarStance {
    Real side[2];
    Real x[2], y[2];  // ρ [m]
    ContactPair<Real> pair;

    /// @param sides of the walls of the corner in front and the one behind; 0 where neither of the two touches
    SLIDEWAY_FN PlanarStance(PlanarLinks<Real> const& links, SinCos<Real> const& tilt, Real front, Real rear,
                             PlanarParameters<Real> const& p)
        : side{front, rear} {
        Real const length_x = p.half_length * tilt.cos, length_y = p.half_length * tilt.sin;
        Real const height_x = p.half_height * tilt.sin, height_y = p.half_height * tilt.cos;
        for (int i = 0; i < 2; ++i) {
            Real const along = i == 0 ? Real(1.0) : Real(-1.0);
            x[i] = fnma(side[i], height_x, along * length_x);
            y[i] = fma(side[i], height_y, along * length_y);
        }
        // How the centre answers to a force on it.
        auto const by_x = links.response(Real(1.0), Real(0.0), p);
        auto const by_y = links.response(Real(0.0), Real(1.0), p);
        Real const xx = negated(fma(links.y1, by_x.a1, links.y2 * by_x.a2));
        Real const xy = negated(fma(links.y1, by_y.a1, links.y2 * by_y.a2));
        Real const yy = fma(links.x1, by_y.a1, links.x2 * by_y.a2);
        Real const turning = Real(1.0) / p.slider_inertia;
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                pair.nn[i][j] = side[i] * side[j] * fma(x[i] * x[j], turning, yy);
                pair.tt[i][j] = fma(y[i] * y[j], turning, xx);
                pair.nt[i][j] = side[i] * fms(x[i] * y[j], turning, xy);
            }
        }
    }

    /// Velocities of the contacts.
    SLIDEWAY_FN PairOf<Real> motion(Real vx, Real vy, Real spin) const {
        PairOf<Real> motion;
        for (int i = 0; i < 2; ++i) {
            motion.normal[i] = negated(side[i]) * fma(x[i], spin, vy);
            motion.along[i] = fnma(y[i], spin, vx);
        }
        return motion;
    }

    /// Their accelerations.  @param ax, ay of the centre  @param spin_rate ψ'' without forces in the contacts
    SLIDEWAY_FN PairOf<Real> acceleration(Real ax, Real ay, Real spin, Real spin_rate) const {
        Real const square = spin * spin;
        PairOf<Real> motion;
        for (int i = 0; i < 2; ++i) {
            motion.normal[i] = negated(side[i]) * (fnma(y[i], square, ay) + x[i] * spin_rate);
            motion.along[i] = fnma(x[i], square, ax) - y[i] * spin_rate;
        }
        return motion;
    }

    /// What forces in the contacts come to: on the centre, and about it.
    struct Load { Real x, y, torque; };
    SLIDEWAY_FN Load load(PairOf<Real> const& force) const {
        Real const n0 = negated(side[0]) * force.normal[0], n1 = negated(side[1]) * force.normal[1];
        return {force.along[0] + force.along[1], n0 + n1,
                fma(x[0], n0, x[1] * n1) - fma(y[0], force.along[0], y[1] * force.along[1])};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
