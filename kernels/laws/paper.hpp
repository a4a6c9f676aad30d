#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The paper's law: each face is in exactly one mode, and its force jumps where the mode changes.  The jumps make energy
/// (model.md 8).  Source: Qian et al. 2020, 3.2.2–3.2.4; the sharing between apices is ours (the paper does not say where the
/// force acts): a surface's kδ_i/4 and a line's P/2 are the shares that make each mode by itself conservative.
struct PaperLaw {
    static constexpr bool switches = true;  // between modes, which makes energy

    /// Not inlined: a mechanism calls it for four faces in several variants, and the code would multiply.
    /// @tparam Full also the elastic forces and the potential; without, they are zero.
    template <class Damping, bool Full = true, class Real>
    SLIDEWAY_NOINLINE static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto modes = face_modes<Real>(m.touching);
        Real const zero(0.0);
        FaceForces<Real> f{{zero, zero, zero, zero}, {zero, zero, zero, zero}, zero, mask_of<Real>(false)};
        if (any(modes.surface)) add_surface<Damping>(modes.surface, m, face, contact, f);
        if (any((modes.ab | modes.bc) | (modes.cd | modes.da))) add_lines<Damping>(modes, m, face, contact, f);
        add_point<Damping>(modes.point.a, m.depth.a, m.rate.a, m.impact_speed.a, contact, f.normal.a, f.elastic.a, f);
        add_point<Damping>(modes.point.b, m.depth.b, m.rate.b, m.impact_speed.b, contact, f.normal.b, f.elastic.b, f);
        add_point<Damping>(modes.point.c, m.depth.c, m.rate.c, m.impact_speed.c, contact, f.normal.c, f.elastic.c, f);
        add_point<Damping>(modes.point.d, m.depth.d, m.rate.d, m.impact_speed.d, contact, f.normal.d, f.elastic.d, f);
        // Made anew, so that the sums above live in registers and not in the caller's memory.
        if constexpr (Full) return {f.normal, f.elastic, f.potential, f.outside};
        return {f.normal, {zero, zero, zero, zero}, zero, f.outside};
    }

private:
    /// F = k δ̄, shared as kδ_i/4; U = k Σδ_i²/8.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact, FaceForces<Real>& f) {
        Real const zero(0.0);
        Real const share = Real(0.25) * face.surface_stiffness;
        Real const v0 = max(max(m.impact_speed.a, m.impact_speed.b), max(m.impact_speed.c, m.impact_speed.d));
        Real const factor = Damping::surface_factor(Real(0.25) * sum(m.rate), v0, contact.damping);
        Quad<Real> elastic{share * m.depth.a, share * m.depth.b, share * m.depth.c, share * m.depth.d};
        f.elastic = {select(surface, elastic.a, zero), select(surface, elastic.b, zero),
                     select(surface, elastic.c, zero), select(surface, elastic.d, zero)};
        f.normal = {f.elastic.a * factor, f.elastic.b * factor, f.elastic.c * factor, f.elastic.d * factor};
        Real const stored =
            fma(elastic.a, m.depth.a, elastic.b * m.depth.b) + fma(elastic.c, m.depth.c, elastic.d * m.depth.d);
        f.potential = select(surface, Real(0.5) * stored, zero);
    }

    /// P(δ̄), δ̄ the mean of both apices, P/2 at each.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_lines(FaceModes<Real> const& modes, FaceMotion<Real> const& m,
                                      FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                      FaceForces<Real>& f) {
        Real const half(0.5), dead(1e-6);
        auto const& d = m.depth;
        Quad<Real> approach{select(modes.ab, half * (d.a + d.b), dead), select(modes.bc, half * (d.b + d.c), dead),
                            select(modes.cd, half * (d.c + d.d), dead), select(modes.da, half * (d.d + d.a), dead)};
        auto lines = line_loads<Real>({modes.ab, modes.bc, modes.cd, modes.da}, approach, face.across, face.along);
        add_line<Damping>(modes.ab, lines.a, m.rate.a, m.rate.b, m.impact_speed.a, m.impact_speed.b, contact,
                          f.normal.a, f.normal.b, f.elastic.a, f.elastic.b, f);
        add_line<Damping>(modes.bc, lines.b, m.rate.b, m.rate.c, m.impact_speed.b, m.impact_speed.c, contact,
                          f.normal.b, f.normal.c, f.elastic.b, f.elastic.c, f);
        add_line<Damping>(modes.cd, lines.c, m.rate.c, m.rate.d, m.impact_speed.c, m.impact_speed.d, contact,
                          f.normal.c, f.normal.d, f.elastic.c, f.elastic.d, f);
        add_line<Damping>(modes.da, lines.d, m.rate.d, m.rate.a, m.impact_speed.d, m.impact_speed.a, contact,
                          f.normal.d, f.normal.a, f.elastic.d, f.elastic.a, f);
    }

    template <class Damping, class Real>
    SLIDEWAY_FN static void add_line(Mask<Real> mode, LineLoad<Real> const& line, Real const& rate_i,
                                     Real const& rate_j, Real const& v0_i, Real const& v0_j,
                                     ContactParameters<Real> const& contact, Real& normal_i, Real& normal_j,
                                     Real& elastic_i, Real& elastic_j, FaceForces<Real>& f) {
        if (none(mode)) return;
        Real const zero(0.0), half(0.5);
        f.outside = f.outside | (mode & line.outside);
        Real const elastic = select(mode, half * line.load, zero);
        Real const factor = Damping::line_factor(half * (rate_i + rate_j), max(v0_i, v0_j), contact.damping);
        Real const normal = elastic * factor;
        normal_i = normal_i + normal;
        normal_j = normal_j + normal;
        elastic_i = elastic_i + elastic;
        elastic_j = elastic_j + elastic;
        f.potential = f.potential + select(mode, line.potential, zero);
    }

    /// K δⁿ + C δ δ'; U = K δⁿ⁺¹/(n + 1).
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_point(Mask<Real> point, Real const& depth, Real const& rate, Real const& v0,
                                      ContactParameters<Real> const& contact, Real& normal, Real& elastic,
                                      FaceForces<Real>& f) {
        if (none(point)) return;
        Real const zero(0.0);
        // A held contact may part by a hair before its step ends.
        Real const d = max(select(point, depth, Real(1e-6)), zero);
        Real const load = point_load(d, contact.point);
        Real const damped = Damping::point_force(load, d, rate, v0, contact.point, contact.damping);
        normal = normal + select(point, damped, zero);
        elastic = elastic + select(point, load, zero);
        f.potential = f.potential + select(point, load * d * contact.point.potential_share, zero);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
