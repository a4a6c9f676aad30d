#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/gap_history.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// At which events of the contacts steps end, the same for a whole block.
enum class Watching {
    nothing,
    touches,           // pairs meet: what restitution needs, v0 changing only at accepted touch events (model.md 4)
    touches_and_parts, // pairs part too: for a law that switches there, between shadows and their member
    modes,             // a law that switches has its contacts held within a step, so that the derivative is smooth and the stepper keeps its
                       // order; a pair whose depth changes sign ends the step and is turned over explicitly
};

/// Ends steps where pairs touch or part, and keeps what a member remembers of it.
/// With `modes` what is held is always the sign of the depth at the start.  A pair may change twice in a step and seem untouched at its end, and
/// error control would never know: what is held apart exerts no force.
/// @tparam quads of pairs, as of GapHistory
template <class Real, int quads = face_count> class ContactWatch : public GapHistory<Real, quads> {
public:
    using Memory = ContactMemory<Real, quads>;

    /// Depth [clearances] up to which an event counts as located: below it a touch has no force, and a switch next to no jump.
    static constexpr double tolerance(Watching watching) { return watching == Watching::modes ? 1e-12 : 1e-8; }

    /// What the first step starts from.
    template <class Contact> SLIDEWAY_FN void begin(Mask<Real> fresh, Contact const& r, Memory& memory, Watching watching) {
        if (watching == Watching::modes) {
            memory.holding = select(fresh, Real(1.0), memory.holding);
            turn_pairs(fresh, r, memory);
        }
        this->keep(fresh, r);
    }

    /// Fraction of the step at which the first pair touches or parts, 1 where none does before the end or the end is the event.
    /// @param located depth [m] up to which it counts as that
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching watching) const {
        bool const touches_alone = watching == Watching::touches;
        Real fraction(1.0);
        auto const of_pair = [&](Real d0, Real v0, Real d1, Real v1) {
            auto const change = GapHistory<Real, quads>::first_change(candidates, d0, v0, d1, v1, step, located);
            if (!touches_alone) return change.fraction;
            // A pair that parts needs no end of its own, unless it touches again in the same step: then the step ends at the parting,
            // and a later one at the touch.
            return select((d0 <= Real(0.0)) | change.returns, change.fraction, Real(1.0));
        };
        for (int face = 0; face < quads; ++face) fraction = min(fraction, this->least_of_face(face, end, of_pair));
        return fraction;
    }

    /// After an accepted step: remembers what has just happened.  @return lanes where it changes the derivative.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> update(Mask<Real> accepted, Contact const& end, Memory& memory, Real*, Watching watching) {
        auto const changed =
            watching == Watching::modes ? turn_pairs(accepted, end, memory) : take_speeds(accepted, end, memory);
        this->keep(accepted, end);
        return changed;
    }

private:
    /// Sets the impact speed of pairs that have just touched.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> take_speeds(Mask<Real> accepted, Contact const& end, Memory& memory) const {
        auto touched = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const& d0 = this->start_depth_[face];
            auto const& d1 = end.penetration[face];
            auto const& v1 = end.rate[face];
            auto& speed = memory.impact_speed[face];
            auto const a = touch(accepted, d0.a, d1.a, v1.a, speed.a), b = touch(accepted, d0.b, d1.b, v1.b, speed.b);
            auto const c = touch(accepted, d0.c, d1.c, v1.c, speed.c), d = touch(accepted, d0.d, d1.d, v1.d, speed.d);
            touched = touched | a | b | c | d;
        }
        return touched;
    }

    SLIDEWAY_FN static Mask<Real> touch(Mask<Real> accepted, Real before, Real after, Real rate, Real& speed) {
        auto const touched = accepted & (before <= Real(0.0)) & (after > Real(0.0));
        speed = select(touched, max(rate, Real(least_impact_speed)), speed);
        return touched;
    }

    /// Turns over the pairs that have changed.
    template <class Contact>
    SLIDEWAY_FN static Mask<Real> turn_pairs(Mask<Real> accepted, Contact const& end, Memory& memory) {
        auto changed = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const& d = end.penetration[face];
            auto& held = memory.held[face];
            auto const a = turn(accepted, d.a, held.a), b = turn(accepted, d.b, held.b);
            auto const c = turn(accepted, d.c, held.c), e = turn(accepted, d.d, held.d);
            changed = changed | a | b | c | e;
        }
        return changed;
    }

    SLIDEWAY_FN static Mask<Real> turn(Mask<Real> accepted, Real depth, Real& held) {
        Real const now = select(depth > Real(0.0), Real(1.0), Real(0.0));
        auto const turned = accepted & (now != held);
        held = select(accepted, now, held);
        return turned;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
