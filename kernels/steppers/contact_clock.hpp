#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The clock of a step within an impact.  A point contact's force ~ δ^1.5 has no second derivative where the contact begins and ends, and a
/// method of high order gains nothing there.  By the clock s with dt = 2u ds and u = √δ of a pair that touches, δ^1.5 = u³, du/ds = δ' and
/// the whole motion is smooth in s from the touch to the parting.
template <class Real> struct ContactClock {
    Real pair;  // its number, 4 face + place in the face; −1 where time itself is the clock
    Real root;  // u [√m], at one end of the step
    Real rate;  // δ' [m/s] there

    SLIDEWAY_FN Mask<Real> runs() const { return pair > Real(-0.5); }

    /// What a step by the clock takes of time if δ' stays as it is, until u = 0 at the longest; and the other way round.
    SLIDEWAY_FN Real time_of(Real own) const {
        Real const falling = min(rate, Real(-1e-300));
        Real const s = select(rate < Real(0.0), min(own, root / negated(falling)), own);
        return select(runs(), s * fma(rate, s, root + root), own);
    }
    SLIDEWAY_FN Real own_of(Real time) const {
        Real const left = max(fma(rate, time, root * root), Real(0.0));
        return select(runs(), time / max(root + sqrt(left), Real(1e-150)), time);
    }
    /// The step that goes to u = 0, if δ' stays as it is; none where the pair does not rise from its face.
    SLIDEWAY_FN Real way_out() const {
        auto const rises = runs() & (rate < Real(0.0)) & (root > Real(0.0));
        return select(rises, root / negated(select(rises, rate, Real(-1.0))), Real(1e300));
    }
    /// That step in place of one that would nearly go there, or further.
    SLIDEWAY_FN Real ending(Real own) const {
        Real const whole = way_out();
        return select(own > Real(0.9) * whole, whole, own);
    }
};

/// A step by the clock, whose ends are events where a pair touches or parts.  Deep within an impact time itself is the smoother clock: there
/// dt = 2u g ds with g = √(2u₀²/(u₀² + u²)), u₀ that of the step's start, so that the pace hardly changes.
template <class Real> struct ClockedStep {
    Real own;  // by the clock: [√m s/m], or [s] where time is
    ContactClock<Real> start, end;
    Real deep;  // 1 where the step is, else 0

    SLIDEWAY_FN Mask<Real> is_deep() const { return deep > Real(0.5); }

    /// g.
    SLIDEWAY_FN Real evenness(Real root) const {
        Real const from = start.root * start.root, one(1.0);
        return sqrt(select(is_deep(), from + from, one) / select(is_deep(), fma(root, root, from), one));
    }
    /// dt/ds.
    SLIDEWAY_FN Real pace(Real root) const { return pace(root, evenness(root)); }
    SLIDEWAY_FN Real pace(Real root, Real evenness) const { return select(start.runs(), (root + root) * evenness, Real(1.0)); }
    SLIDEWAY_FN Real pace_at_start() const { return pace(start.root); }
    SLIDEWAY_FN Real pace_at_end() const { return pace(end.root); }
    /// du/ds where δ' is `rate`.
    SLIDEWAY_FN Real root_rate(Real root, Real rate) const { return root_rate_by(evenness(root), rate); }
    SLIDEWAY_FN Real root_rate_by(Real evenness, Real rate) const { return select(start.runs(), rate * evenness, Real(0.0)); }

    /// Whether the pair of the clock parts at the end: what is left of u is little, either way.  The impulse that is left goes with u⁵.
    SLIDEWAY_FN Mask<Real> parts() const {
        auto const rises = end.rate < Real(0.0);
        return rises & is_little(end.root);
    }
    SLIDEWAY_FN Mask<Real> is_little(Real root) const { return start.runs() & (abs(root) < Real(0.03) * start.root); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
