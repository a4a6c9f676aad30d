#pragma once

#include "kernels/block.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a stop finds of one offset.
template <class Real> struct OffsetGrowth {
    Real growth;       // ln of it since the last stop
    Real distance;     // that the next interval starts from
    Mask<Real> moved;  // lanes where the shadow goes back to d0
    Mask<Real> lost;   // lanes where the offset had shrunk into rounding
};

/// One shadow is left alone within its bounds; several, made orthogonal, always go back.
/// @param at lanes at a stop.  @param length of the offset, of several what the earlier ones left of it.
/// @param distance after the last stop, > 0  @param least what rounding makes of offsets
template <class Real>
SLIDEWAY_FN OffsetGrowth<Real> offset_growth(ShadowPlan const& plan, Mask<Real> at, Real length, Real distance, Real least) {
    SLIDEWAY_EXPECT(none(at & (distance <= Real(0.0))) && none(least <= Real(0.0)));
    Real const reached = max(length, least);
    auto moved = at;
    auto const lost = !(length > least);
    if (plan.count == 1) moved = at & (lost | !((reached >= Real(plan.lower)) & (reached <= Real(plan.upper))));
    return {log_positive(reached / distance), select(at, select(moved, Real(plan.d0), reached), distance), moved, lost};
}

}  // namespace slideway::inline SLIDEWAY_ISA
