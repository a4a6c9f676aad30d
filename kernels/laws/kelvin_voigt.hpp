#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/law_info.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A linear spring and damper at each of the sixteen pairs of apex and face, never pulling: F = max(0, kδ + cδ'), U = kδ²/2.
/// No mode but that an apex touches or not; without damping and friction it keeps energy.  Source: model.md 4.
struct KelvinVoigt {
    static constexpr Key keys[] = {
        {"contact.apex_stiffness", &Inputs::law_a, "N/m", Rule::positive, KeyGroup::law, "stiffness of an apex", follows, nullptr,
         "E_s A / (4 l) of its face"},
        {"contact.apex_damping", &Inputs::law_b, "N s/m", Rule::not_negative, KeyGroup::law, "damping of an apex", 0}};
    static constexpr double face_stiffness(Inputs const& in, double surface, double) {
        return in.law_a == in.law_a ? 4 * in.law_a : surface;
    }
    static constexpr LawInfo info{.name = "kelvin_voigt",
                                  .words = "a linear spring and damper at each apex, no modes",
                                  .switches = false,
                                  .ends_steps = true,
                                  .groups = groups_of(KeyGroup::elastic),
                                  .of_touching_alone = true,
                                  .keys = keys,
                                  .face_stiffness = &face_stiffness};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                               ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        Real const zero(0.0), k = stiffness_of(face, contact);
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& elastic) {
            Real const load = k * apex.depth;
            normal = select(touching, clamped(fma(contact.of_law.b, apex.rate, load)), zero);
            elastic = select(touching, load, zero);
            f.potential = fma(Real(0.5) * elastic, apex.depth, f.potential);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.elastic.a);
        add(m.touching.b, m.apex.b, f.normal.b, f.elastic.b);
        add(m.touching.c, m.apex.c, f.normal.c, f.elastic.c);
        add(m.touching.d, m.apex.d, f.normal.d, f.elastic.d);
        return f;
    }

    /// ∂F/∂δ = k and ∂F/∂δ' = c of its own apex, where it pushes.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        Real const zero(0.0), k = stiffness_of(face, contact), c = contact.of_law.b;
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& by_depth, Real& by_rate) {
            Real const force = fma(c, apex.rate, k * apex.depth);
            auto const pushing = touching & (force > zero);
            normal = select(pushing, force, zero);
            by_depth = select(pushing, k, zero);
            by_rate = select(pushing, c, zero);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.by_depth.a.own, f.by_rate.a.own);
        add(m.touching.b, m.apex.b, f.normal.b, f.by_depth.b.own, f.by_rate.b.own);
        add(m.touching.c, m.apex.c, f.normal.c, f.by_depth.c.own, f.by_rate.c.own);
        add(m.touching.d, m.apex.d, f.normal.d, f.by_depth.d.own, f.by_rate.d.own);
        return f;
    }

private:
    /// k: as given, else a quarter of the stiffness of the face's surface, E_s A/(4 l).
    template <class Real>
    SLIDEWAY_FN static Real stiffness_of(FaceContact<Real> const& face, ContactParameters<Real> const& contact) {
        Real const given = contact.of_law.a;
        return select(given == given, given, Real(0.25) * face.surface_stiffness);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
