#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/touch_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where steps of a block between rigid walls end: a corner meets its wall, a lasting contact opens, slips the other way, or no longer
/// sticks.
template <class Real> class RigidWatch : public TouchWatch<Real, 1> {
public:
    /// What pressure and grip may fall below 0 by.
    static constexpr double slack = 1e-9;

    /// Remembers what the next step starts from.
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        TouchWatch<Real, 1>::keep(taken, contact);
        for (int i = 0; i < 2; ++i) {
            pressure_[i] = select(taken, contact.pressure[i], pressure_[i]);
            grip_[i] = select(taken, contact.grip[i], grip_[i]);
        }
    }

    /// Fraction of the step at which the first event is, as of a TouchWatch.
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching watching) const {
        Real fraction = TouchWatch<Real, 1>::earliest(candidates, end, step, located, watching);
        for (int i = 0; i < 2; ++i) {
            fraction = min(fraction, min(falling(candidates, pressure_[i], end.pressure[i]), falling(candidates, grip_[i], end.grip[i])));
        }
        return fraction;
    }

private:
    /// Where a number that must not be negative falls just below 0, by the straight line through both ends.
    SLIDEWAY_FN static Real falling(Mask<Real> candidates, Real before, Real after) {
        auto const falls = candidates & (after < Real(-slack));
        Real const start = max(before, Real(0.0));
        Real const fraction = (start + Real(0.5 * slack)) / select(falls, start - after, Real(1.0));
        return select(falls, min(max(fraction, Real(0.01)), Real(0.99)), Real(1.0));
    }

    Real pressure_[2], grip_[2];
};

}  // namespace slideway::inline SLIDEWAY_ISA
