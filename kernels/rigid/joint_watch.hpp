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
        each_slip(end, [&](Falls const& slides, Falls const& sticks) {
            fraction = min(fraction, Touches::falling(candidates & slides.in, slides.before, slides.after));
            fraction = min(fraction, Touches::falling(candidates & sticks.in, sticks.before, sticks.after));
        });
        return fraction;
    }

    template <class Contact> SLIDEWAY_FN Real way_on(Contact const& end, Real step, Real located) const {
        auto way = Touches::way_of_touches(end, located);
        each_slip(end, [&](Falls const& slides, Falls const& sticks) {
            way.fall(slides.in, slides.before, slides.after, step);
            way.fall(sticks.in, sticks.before, sticks.after, step);
        });
        return way.time();
    }

private:
    /// A number of a pair that must not become negative.
    struct Falls {
        Mask<Real> in;
        Real before, after;
    };

    /// Has a function see of each pair its slip, where it slides, along what that was, and what is left of it until one that sticks slips.
    template <class Contact, class See> SLIDEWAY_FN void each_slip(Contact const& end, See const& see) const {
        auto const one_pair = [&](Real slides, Real u0, Real v0, Real u1, Real v1) {
            Real const zero(0.0), most(slip_again);
            if (none(slides != zero)) return;
            Real const start = sqrt(fma(u0, u0, v0 * v0));
            auto const moves = start > zero;
            Real const along = fma(u0, u1, v0 * v1) / select(moves, start, Real(1.0));
            Real const now = sqrt(fma(u1, u1, v1 * v1));
            see(Falls{Mask<Real>(moves & (slides > zero)), start, along}, Falls{Mask<Real>(slides < zero), most - start, most - now});
        };
        for (int face = 0; face < face_count; ++face) {
            auto const& kind = slides_[face];
            auto const &u0 = slip_[0][face], &v0 = slip_[1][face], &u1 = end.slip[0][face], &v1 = end.slip[1][face];
            one_pair(kind.a, u0.a, v0.a, u1.a, v1.a);
            one_pair(kind.b, u0.b, v0.b, u1.b, v1.b);
            one_pair(kind.c, u0.c, v0.c, u1.c, v1.c);
            one_pair(kind.d, u0.d, v0.d, u1.d, v1.d);
        }
    }

    Quad<Real> slip_[2][face_count], slides_[face_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
