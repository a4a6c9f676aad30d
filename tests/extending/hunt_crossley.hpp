// A spring that dissipates in proportion to its force, at each apex (Hunt and Crossley); laws with another dissipation share what it does.
#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/laws/point.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// F = max(0, K δⁿ (1 + a δ')), U = K δⁿ⁺¹/(n + 1).  @tparam Law has `slope(contact, apex)`, a [s/m]
template <class Law> struct DissipativeSprings {
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const&, ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        Real const zero(0.0), one(1.0);
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& elastic) {
            Real const load = point_load(select(touching, apex.depth, one), contact.point);  // both sides are evaluated
            normal = select(touching, clamped(load * fma(Law::slope(contact, apex), apex.rate, one)), zero);
            elastic = select(touching, load, zero);
            f.potential = fma(contact.point.potential_share * elastic, apex.depth, f.potential);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.elastic.a);
        add(m.touching.b, m.apex.b, f.normal.b, f.elastic.b);
        add(m.touching.c, m.apex.c, f.normal.c, f.elastic.c);
        add(m.touching.d, m.apex.d, f.normal.d, f.elastic.d);
        return f;
    }

    /// ∂F/∂δ and ∂F/∂δ' of its own apex, where it pushes: what the stiff method steps by.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const&, ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        Real const zero(0.0), one(1.0);
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& by_depth, Real& by_rate) {
            auto const elastic = point_slope(select(touching, apex.depth, one), contact.point);
            Real const slope = Law::slope(contact, apex), factor = fma(slope, apex.rate, one);
            auto const pushing = touching & (factor > zero);
            normal = select(pushing, elastic.load * factor, zero);
            by_depth = select(pushing, elastic.slope * factor, zero);
            by_rate = select(pushing, elastic.load * slope, zero);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.by_depth.a.own, f.by_rate.a.own);
        add(m.touching.b, m.apex.b, f.normal.b, f.by_depth.b.own, f.by_rate.b.own);
        add(m.touching.c, m.apex.c, f.normal.c, f.by_depth.c.own, f.by_rate.c.own);
        add(m.touching.d, m.apex.d, f.normal.d, f.by_depth.d.own, f.by_rate.d.own);
        return f;
    }
};

/// a = (3/2) α.  Source: Hunt & Crossley, J. Appl. Mech. 42 (1975) 440.
struct HuntCrossley : DissipativeSprings<HuntCrossley> {
    static constexpr Key keys[] = {
        {"contact.dissipation", &Inputs::law_a, "s/m", Rule::not_negative, KeyGroup::law, "dissipation of an apex", 0}};
    static constexpr LawInfo info{.name = "hunt_crossley",
                                  .words = "a spring at each apex that dissipates in proportion to its force",
                                  .switches = false,
                                  .groups = groups_of(KeyGroup::elastic, KeyGroup::hertz),
                                  .keys = keys};

    template <class Real> SLIDEWAY_FN static Real slope(ContactParameters<Real> const& contact, ApexMotion<Real> const&) {
        return Real(1.5) * contact.of_law.a;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA

#define SLIDEWAY_LAW HuntCrossley
