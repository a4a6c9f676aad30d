#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/touch_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where steps of a slider in a rigid joint end: an apex meets its face, a pair that lasts comes to rest along it or begins to slip.
template <class Real> class JointWatch : public TouchWatch<Real, face_count> {
    using Touches = TouchWatch<Real, face_count>;

public:
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        Touches::keep(taken, contact);
        for (int face = 0; face < face_count; ++face) {
            Touches::take_quad(taken, contact.slip[0][face], slip_[0][face]);
            Touches::take_quad(taken, contact.slip[1][face], slip_[1][face]);
            Touches::take_quad(taken, contact.slides[face], slides_[face]);
        }
    }

    /// Fraction of the step at which the first event is, as of a TouchWatch.
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching watching) const {
        Real fraction = Touches::earliest(candidates, end, step, located, watching);
        auto const see = [&](Real slides, Real u0, Real v0, Real u1, Real v1) {
            fraction = min(fraction, turning(candidates, slides, {u0, v0}, {u1, v1}));
        };
        for (int face = 0; face < face_count; ++face) {
            auto const& kind = slides_[face];
            auto const &u0 = slip_[0][face], &v0 = slip_[1][face], &u1 = end.slip[0][face], &v1 = end.slip[1][face];
            see(kind.a, u0.a, v0.a, u1.a, v1.a);
            see(kind.b, u0.b, v0.b, u1.b, v1.b);
            see(kind.c, u0.c, v0.c, u1.c, v1.c);
            see(kind.d, u0.d, v0.d, u1.d, v1.d);
        }
        return fraction;
    }

private:
    /// Where a slip turns against what it was, or one that was none is no longer that.
    SLIDEWAY_FN static Real turning(Mask<Real> candidates, Real slides, Real const (&before)[2], Real const (&after)[2]) {
        Real const zero(0.0), one(1.0);
        Real const start = sqrt(fma(before[0], before[0], before[1] * before[1]));
        auto const moves = start > zero;
        Real const along = fma(before[0], after[0], before[1] * after[1]) / select(moves, start, one);
        Real const of_slip = Touches::falling(candidates & moves & (slides > zero), start, along);
        Real const end = sqrt(fma(after[0], after[0], after[1] * after[1])), most(slip_again);
        return min(of_slip, Touches::falling(candidates & (slides < zero), most - start, most - end));
    }

    Quad<Real> slip_[2][face_count], slides_[face_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
