#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/elements.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/law_info.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The paper's law: each face is in exactly one mode, and its force jumps where the mode changes.  The jumps make energy
/// (model.md 8).  Source: Qian et al. 2020, 3.2.2–3.2.4; the sharing between apices is ours (the paper does not say where the
/// force acts): a surface's kδ_i/4 and a line's P/2 are the shares that make each mode by itself conservative.
struct PaperLaw {
    static constexpr LawInfo info{
        .name = "paper",
        .words = "one mode per face: surface, lines or points (makes energy where it switches)",
        .switches = true,
        .groups = contact_groups,
        .of_touching_alone = true};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto modes = face_modes<Real>(m.touching);
        auto f = no_forces<Real>();
        if (any(modes.surface)) add_surface<Damping>(modes.surface, m, face, contact, f);
        if (any_of(modes.line)) {
            Real const zero(0.0);
            add_lines<ArithmeticMean, Damping>(modes.line, {zero, zero, zero, zero}, m, face, contact, f);
        }
        if (any_of(modes.point)) add_points<Damping>(modes.point, with_safe_depths(m, modes.point), contact, f);
        return f;
    }

    /// Derivatives of the forces inside a mode; the jumps between modes have none.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                           ContactParameters<Real> const& contact) {
        auto const modes = face_modes<Real>(m.touching);
        auto f = FaceStiffness<Real>::none();
        if (any(modes.surface)) add_surface_slopes<Damping>(modes.surface, m, face, contact, f);
        add_lines<ArithmeticMean, Damping>(modes.line, m, face, contact, f);
        if (any_of(modes.point)) add_points<Damping>(modes.point, with_safe_depths(m, modes.point), contact, f);
        return f;
    }

private:
    /// F = k δ̄, shared as kδ_i/4; U = k Σδ_i²/8.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact, FaceForces<Real>& f) {
        Real const zero(0.0);
        Real const share = Real(0.25) * face.surface_stiffness;
        Real const factor = Damping::surface_factor(mean_rate(m), impact_speed(m), contact.damping);
        auto const& apex = m.apex;
        Quad<Real> elastic{share * apex.a.depth, share * apex.b.depth, share * apex.c.depth, share * apex.d.depth};
        f.elastic = {select(surface, elastic.a, zero), select(surface, elastic.b, zero),
                     select(surface, elastic.c, zero), select(surface, elastic.d, zero)};
        f.normal = {f.elastic.a * factor, f.elastic.b * factor, f.elastic.c * factor, f.elastic.d * factor};
        Real const stored = fma(elastic.a, apex.a.depth, elastic.b * apex.b.depth) +
                            fma(elastic.c, apex.c.depth, elastic.d * apex.d.depth);
        f.potential = select(surface, Real(0.5) * stored, zero);
    }

    /// F_i = kδ_i/4 · factor(mean rate): ∂F_i/∂δ_i = k/4 · factor, and all four rates change all four forces.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface_slopes(Mask<Real> surface, FaceMotion<Real> const& m,
                                               FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                               FaceStiffness<Real>& f) {
        Real const zero(0.0), quarter(0.25);
        auto const damping = Damping::surface_slopes(mean_rate(m), impact_speed(m), contact.damping);
        Real const share = select(surface, quarter * face.surface_stiffness, zero);
        Real const stiffness = share * damping.factor;
        auto const add = [&](Real depth, Real& normal, ApexSlopes<Real>& by_depth, ApexSlopes<Real>& by_rate) {
            normal = stiffness * depth;
            by_depth.own = stiffness;
            if constexpr (Damping::couples) {
                by_rate.own = by_rate.across = by_rate.along = by_rate.opposite =
                    quarter * share * depth * damping.by_rate;
            }
        };
        add(m.apex.a.depth, f.normal.a, f.by_depth.a, f.by_rate.a);
        add(m.apex.b.depth, f.normal.b, f.by_depth.b, f.by_rate.b);
        add(m.apex.c.depth, f.normal.c, f.by_depth.c, f.by_rate.c);
        add(m.apex.d.depth, f.normal.d, f.by_depth.d, f.by_rate.d);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
