// The springs of hunt_crossley.hpp with the dissipation of Lankarani and Nikravesh, which takes a coefficient of restitution.
#pragma once

#include "hunt_crossley.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// a = ¾ (1 − e²)/v0, v0 the speed at the last touch.  Source: Lankarani & Nikravesh, J. Mech. Des. 112 (1990) 369.
struct LankaraniNikravesh : DissipativeSprings<LankaraniNikravesh> {
    static constexpr LawInfo info{.name = "lankarani_nikravesh",
                                  .words = "a spring at each apex with the dissipation of Lankarani and Nikravesh",
                                  .switches = false,
                                  .groups = groups_of(KeyGroup::elastic, KeyGroup::hertz, KeyGroup::restitution),
                                  .needs_restitution = true};

    template <class Real> SLIDEWAY_FN static Real slope(ContactParameters<Real> const& contact, ApexMotion<Real> const& apex) {
        Real const e = contact.damping.restitution;
        return Real(0.75) * fnma(e, e, Real(1.0)) / apex.impact_speed;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA

#undef SLIDEWAY_LAW
#define SLIDEWAY_LAW LankaraniNikravesh
