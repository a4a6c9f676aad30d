#pragma once

#include "kernels/joint/way.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct JointGeometry {
    Real half_length;  // L_k/2 [m]
    Real half_width;   // w_a/2, along Y [m]
    Real half_depth;   // w_b/2, along Z [m]
    Real clearance_y;  // c_a, per side [m]
    Real clearance_z;  // c_b [m]
};

/// The penetrations of the two faces normal to one of the slider's axes, as an affine function of the three signs: for the face
/// on side s, δ = base + s·middle + s·(s_across·across + s_x·along).  The same for their rates.
template <class Real> struct FacePair { Real base, middle, across, along; };

/// δ = −c + s[(n − 1) ρ + …] of the apices (model.md 3, clearance first).  With ρ = (s_x L_k/2, s w/2 − p, s_across w_across/2 −
/// p_across) and n the face's normal: base = −c + (n_main − 1) w/2, middle = −(n_main p + n_across p_across).
template <class Real>
SLIDEWAY_FN FacePair<Real> penetrations(Real clearance, Real half_main, Real half_across, Real half_length,
                                        Real shortfall, Real n_across, Real n_x, Real p_main, Real p_across) {
    return {fms(shortfall, half_main, clearance), negated(fma(n_across, p_across, fma(shortfall, p_main, p_main))),
            n_across * half_across, n_x * half_length};
}

/// δ' = s[(ω × n)·ρ − n_y v_y − n_z v_z], with m = ω × n (model.md 3).
template <class Real>
SLIDEWAY_FN FacePair<Real> penetration_rates(Real half_main, Real half_across, Real half_length, Real n_main,
                                             Real n_across, Real m_main, Real m_across, Real m_x, Real p_main,
                                             Real p_across, Real v_main, Real v_across) {
    Real const turning = fma(m_main, p_main, m_across * p_across);
    Real const moving = fma(n_main, v_main, n_across * v_across);
    return {m_main * half_main, negated(turning + moving), m_across * half_across, m_x * half_length};
}

/// The four apices of the face on `side` (+1 or −1).
template <class Real> SLIDEWAY_FN Quad<Real> apices(FacePair<Real> const& pair, Real side) {
    Real const centre = fma(side, pair.middle, pair.base);
    Real const across = side * pair.across, along = side * pair.along;
    Real const front = centre + along, rear = centre - along;
    return {front + across, front - across, rear - across, rear + across};
}

/// The largest of the four, bit for bit, since rounding keeps the order.
template <class Real> SLIDEWAY_FN Real deepest_apex(FacePair<Real> const& pair, Real side) {
    return (fma(side, pair.middle, pair.base) + abs(pair.along)) + abs(pair.across);
}

}  // namespace slideway::inline SLIDEWAY_ISA
