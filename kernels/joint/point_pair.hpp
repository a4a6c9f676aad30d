#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/damping.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Elastic force K δⁿ of a pair of points [N]; 0 where it does not touch.
template <class Real> SLIDEWAY_FN Real pair_load(Real depth, PointContact<Real> const& point) {
    auto const touches = depth > Real(0.0);
    return select(touches, point_load(select(touches, depth, Real(1.0)), point), Real(0.0));
}

/// The same with its damping.  @param v0 δ' of its last touch, which counts if `remembers`
template <class Real>
SLIDEWAY_FN Real pair_force(Real load, Real depth, Real rate, Real v0, PointContact<Real> const& point, DampingParameters<Real> const& damping, bool remembers) {
    ApexMotion<Real> const pair{depth, rate, max(v0, Real(least_impact_speed))};
    Real const force = remembers ? RestitutionDamping::point_force(load, pair, point, damping) : PointDamping::point_force(load, pair, point, damping);
    return select(depth > Real(0.0), force, Real(0.0));
}

/// Friction (M5.2) along the slip of a pair, against it [N].  @param power of it, to which its own is added [W]
template <class Real> SLIDEWAY_FN Real pair_friction(Real slip, Real load, FrictionParameters<Real> const& friction, Real& power) {
    Real const speed = abs(slip), drag = StickSlipFriction::coefficient(speed, friction) * load;
    power = fma(drag, speed, power);
    return negated(drag) * (slip / max(speed, Real(1e-70)));
}

}  // namespace slideway::inline SLIDEWAY_ISA
