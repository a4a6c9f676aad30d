#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/gap_history.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends steps where the contacts of a law that switches change.  Within a step the contacts are held as they were at its start, so
/// that the derivative is smooth and the stepper keeps its order; a pair whose depth changes sign shortens the step to the first
/// zero, where it is turned over explicitly.  What is held is so always the sign of the depth at the start.  A pair may change twice
/// in a step and seem untouched at its end, and error control would never know: what is held apart exerts no force.
template <class Real> class ModeLocator : public GapHistory<Real> {
public:
    /// Depth [clearances] up to which a change counts as located.
    static constexpr double tolerance = 1e-12;

    /// Holds the contacts of the start.
    SLIDEWAY_FN void begin(Mask<Real> fresh, ContactReport<Real> const& r, HeldContacts<Real>& memory) {
        memory.holding = select(fresh, Real(1.0), memory.holding);
        update(fresh, r, memory, nullptr);
    }

    /// Fraction of the step at which the first pair changes, 1 where none does before the end or the end is the change.
    /// @param located depth [m] up to which it counts as that
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, ContactReport<Real> const& end, Real step, Real located,
                              HeldContacts<Real> const&) const {
        Real fraction(1.0);
        auto const of_pair = [&](Real d0, Real v0, Real d1, Real v1) {
            return this->first_change(candidates, d0, v0, d1, v1, step, located).fraction;
        };
        for (int face = 0; face < face_count; ++face) fraction = min(fraction, this->least_of_face(face, end, of_pair));
        return fraction;
    }

    /// After an accepted step: turns over the pairs that have changed.  @return lanes where one did.
    SLIDEWAY_FN Mask<Real> update(Mask<Real> accepted, ContactReport<Real> const& end, HeldContacts<Real>& memory,
                                  Real*) {
        auto changed = mask_of<Real>(false);
        for (int face = 0; face < face_count; ++face) {
            auto const& d = end.penetration[face];
            auto& held = memory.touching[face];
            auto const a = turn(accepted, d.a, held.a), b = turn(accepted, d.b, held.b);
            auto const c = turn(accepted, d.c, held.c), e = turn(accepted, d.d, held.d);
            changed = changed | a | b | c | e;
        }
        this->keep(accepted, end);
        return changed;
    }

private:
    SLIDEWAY_FN static Mask<Real> turn(Mask<Real> accepted, Real depth, Real& held) {
        Real const now = select(depth > Real(0.0), Real(1.0), Real(0.0));
        auto const turned = accepted & (now != held);
        held = select(accepted, now, held);
        return turned;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
