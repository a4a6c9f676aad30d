#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/gap_history.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Finds where pairs touch inside an accepted step, so that steps end there, and keeps the speeds of touch that
/// restitution needs (model.md 4: v0 changes only at accepted touch events).
/// @tparam partings steps end where pairs part too: for a law that switches there, between shadows and their member
/// @tparam quads of pairs, as of GapHistory
template <class Real, bool partings = false, int quads = face_count>
class TouchLocator : public GapHistory<Real, quads> {
public:
    /// Depth [clearances] up to which a new touch counts as located: below it the contact force is nil.
    static constexpr double tolerance = 1e-8;

    /// What the first step starts from.
    template <class Contact> SLIDEWAY_FN void begin(Mask<Real> fresh, Contact const& r, ImpactSpeeds<Real, quads>&) {
        this->keep(fresh, r);
    }

    /// Fraction of the step at which the first pair touches, 1 where none touches before the end or the end is the touch.
    /// @param located depth [m] up to which it counts as that
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located,
                              ImpactSpeeds<Real, quads> const&) const {
        Real fraction(1.0);
        auto const of_pair = [&](Real d0, Real v0, Real d1, Real v1) {
            return touching_at(candidates, d0, v0, d1, v1, step, located);
        };
        for (int face = 0; face < quads; ++face) fraction = min(fraction, this->least_of_face(face, end, of_pair));
        return fraction;
    }

    /// After an accepted step: sets the impact speed of pairs that have just touched.  @return lanes where one did.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> update(Mask<Real> accepted, Contact const& end, ImpactSpeeds<Real, quads>& memory, Real*) {
        auto touched = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const& d0 = this->start_depth_[face];
            auto const& d1 = end.penetration[face];
            auto const& v1 = end.rate[face];
            auto& speed = memory.speeds[face];
            auto const a = touch(accepted, d0.a, d1.a, v1.a, speed.a), b = touch(accepted, d0.b, d1.b, v1.b, speed.b);
            auto const c = touch(accepted, d0.c, d1.c, v1.c, speed.c), d = touch(accepted, d0.d, d1.d, v1.d, speed.d);
            touched = touched | a | b | c | d;
        }
        this->keep(accepted, end);
        return touched;
    }

private:
    /// A pair that parts needs no end of its own, unless it touches again in the same step: then the step ends at the parting, and
    /// a later one at the touch.
    SLIDEWAY_FN static Real touching_at(Mask<Real> candidates, Real d0, Real v0, Real d1, Real v1, Real step,
                                        Real located) {
        auto const change = GapHistory<Real, quads>::first_change(candidates, d0, v0, d1, v1, step, located);
        if constexpr (partings) return change.fraction;
        return select((d0 <= Real(0.0)) | change.returns, change.fraction, Real(1.0));
    }

    SLIDEWAY_FN static Mask<Real> touch(Mask<Real> accepted, Real before, Real after, Real rate, Real& speed) {
        auto const touched = accepted & (before <= Real(0.0)) & (after > Real(0.0));
        speed = select(touched, max(rate, Real(least_impact_speed)), speed);
        return touched;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
