#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/gap_history.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends steps where the contacts of a law that switches change.  Within a step the contacts are held as they were at its start, so
/// that the derivative is smooth and the stepper keeps its order; a pair whose depth has changed sign by the end shortens the step
/// to its zero, where it is turned over explicitly.
template <class Real> class ModeLocator : public GapHistory<Real> {
public:
    /// Depth [clearances] up to which a change counts as located.
    static constexpr double tolerance = 1e-12;

    /// Holds the contacts of the start.
    SLIDEWAY_FN void begin(Mask<Real> fresh, ContactReport<Real> const& r, HeldContacts<Real>& memory) {
        memory.holding = select(fresh, Real(1.0), memory.holding);
        update(fresh, r, memory);
    }

    /// Fraction of the step at which the first pair changes, 1 where none does before the end or the end is the change.
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, ContactReport<Real> const& end, Real step, Real clearance,
                              HeldContacts<Real> const& memory) const {
        Real fraction(1.0);
        Real const located = clearance * Real(tolerance);
        for (int face = 0; face < face_count; ++face) {
            auto const& d0 = this->start_depth_[face];
            auto const& v0 = this->start_rate_[face];
            auto const& d1 = end.penetration[face];
            auto const& v1 = end.rate[face];
            auto const& held = memory.touching[face];
            fraction = min(fraction, changing_at(candidates, held.a, d0.a, v0.a, d1.a, v1.a, step, located));
            fraction = min(fraction, changing_at(candidates, held.b, d0.b, v0.b, d1.b, v1.b, step, located));
            fraction = min(fraction, changing_at(candidates, held.c, d0.c, v0.c, d1.c, v1.c, step, located));
            fraction = min(fraction, changing_at(candidates, held.d, d0.d, v0.d, d1.d, v1.d, step, located));
        }
        return fraction;
    }

    /// After an accepted step: turns over the pairs that have changed.  @return lanes where one did.
    SLIDEWAY_FN Mask<Real> update(Mask<Real> accepted, ContactReport<Real> const& end, HeldContacts<Real>& memory) {
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
    /// A pair that was turned over at the last zero may lie a hair on the wrong side still: it has no zero to look for, and is
    /// turned back at the end of the step if it stays there.
    SLIDEWAY_FN static Real changing_at(Mask<Real> candidates, Real held, Real d0, Real v0, Real d1, Real v1, Real step,
                                        Real located) {
        Real const zero(0.0);
        auto const touches = held > Real(0.5);
        auto const parts = touches & (d0 > zero) & (d1 < negated(located));
        auto const apart = held < Real(0.5);
        auto const meets = apart & (d0 <= zero) & (d1 > located);
        Real const target = select(touches, Real(-0.5), Real(0.5)) * located;
        return GapHistory<Real>::crossing(candidates & (parts | meets), d0, v0, d1, v1, step, target);
    }

    SLIDEWAY_FN static Mask<Real> turn(Mask<Real> accepted, Real depth, Real& held) {
        Real const now = select(depth > Real(0.0), Real(1.0), Real(0.0));
        auto const turned = accepted & (now != held);
        held = select(accepted, now, held);
        return turned;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
