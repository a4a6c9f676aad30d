#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Why a state has no derivative.
template <class Real> struct Faults {
    Mask<Real> geometry;        // the rod does not reach, or the slider has left its way
    Mask<Real> contact_domain;  // a line contact beyond its domain

    SLIDEWAY_FN static Faults none() { return of(mask_of<Real>(false), mask_of<Real>(false)); }
    SLIDEWAY_FN Faults or_else(Faults const& other) const {
        return of(geometry | other.geometry, contact_domain | other.contact_domain);
    }
    SLIDEWAY_FN Faults within(Mask<Real> lanes_seen) const {
        return of(geometry & lanes_seen, contact_domain & lanes_seen);
    }

private:
    SLIDEWAY_FN static Faults of(Mask<Real> geometry, Mask<Real> contact_domain) {
        Faults faults;
        faults.geometry = geometry;
        faults.contact_domain = contact_domain;
        return faults;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
