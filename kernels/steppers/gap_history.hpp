#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Depths and rates of the apex–face pairs at the start of a step, and where inside it they reach a depth.
template <class Real> class GapHistory {
public:
    /// Remembers the gaps at the start of the next step.
    SLIDEWAY_FN void keep(Mask<Real> taken, ContactReport<Real> const& r) {
        for (int face = 0; face < face_count; ++face) {
            keep(taken, r.penetration[face], start_depth_[face]);
            keep(taken, r.rate[face], start_rate_[face]);
        }
    }

protected:
    /// Where in (0, 1) the cubic through both ends' depths and rates crosses `target`, by bisection under a mask; 1 elsewhere.
    /// @param crosses lanes whose depth is below `target` at one end and above it at the other.
    SLIDEWAY_FN static Real crossing(Mask<Real> crosses, Real d0, Real v0, Real d1, Real v1, Real step, Real target) {
        Real const one(1.0), half(0.5);
        if (none(crosses)) return one;
        Real const change = d1 - d0;
        Real const start = fms(step, v0, change);
        Real const end = fnma(step, v1, change) - start;
        Real const direction = select(d1 > d0, one, Real(-1.0));
        Real low(0.0), high(1.0);
        for (int i = 0; i < 48; ++i) {
            Real const middle = half * (low + high);
            Real const rest = one - middle;
            Real const depth = fma(middle, fma(rest, fma(middle, end, start), change), d0);
            auto const before = direction * (depth - target) < Real(0.0);
            low = select(before, middle, low);
            high = select(before, high, middle);
        }
        return select(crosses, min(high, Real(0.999)), one);
    }

    Quad<Real> start_depth_[face_count], start_rate_[face_count];

private:
    SLIDEWAY_FN static void keep(Mask<Real> taken, Quad<Real> const& from, Quad<Real>& to) {
        to = {select(taken, from.a, to.a), select(taken, from.b, to.b), select(taken, from.c, to.c),
              select(taken, from.d, to.d)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
