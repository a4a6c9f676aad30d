#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/touch_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where steps of a block between rigid walls end: a corner meets its wall, a lasting contact opens, slips the other way, or no longer
/// sticks.
template <class Real> class RigidWatch : public TouchWatch<Real, 1> {
public:
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
            fraction = min(fraction, min(this->falling(candidates, pressure_[i], end.pressure[i]), this->falling(candidates, grip_[i], end.grip[i])));
        }
        return fraction;
    }

    template <class Contact> SLIDEWAY_FN Real way_on(Contact const& end, Real step, Real located) const {
        auto way = this->way_of_touches(end, located);
        for (int i = 0; i < 2; ++i) {
            way.fall(mask_of<Real>(true), pressure_[i], end.pressure[i], step);
            way.fall(mask_of<Real>(true), grip_[i], end.grip[i], step);
        }
        return way.time();
    }

private:
    Real pressure_[2], grip_[2];
};

}  // namespace slideway::inline SLIDEWAY_ISA
