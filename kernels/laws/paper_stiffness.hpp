#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/contact_stiffness.hpp"
#include "kernels/laws/damping_stiffness.hpp"
#include "kernels/laws/face_stiffness.hpp"
#include "kernels/laws/paper.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Derivatives of PaperLaw::forces inside a mode; its jumps between modes have none.  Source: model.md 4.
template <> struct LawStiffness<PaperLaw> {
    template <class Damping, class Real>
    SLIDEWAY_NOINLINE static FaceStiffness<Real> face(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                      ContactParameters<Real> const& contact) {
        auto const modes = face_modes<Real>(m.touching);
        auto f = FaceStiffness<Real>::none();
        if (any(modes.surface)) add_surface<Damping>(modes.surface, m, face, contact, f);
        add_line<Damping>(modes.ab, m.depth.a, m.depth.b, m.rate.a, m.rate.b, m.impact_speed.a, m.impact_speed.b,
                          face.across, contact, &ApexSlopes<Real>::across, f.normal.a, f.normal.b, f.by_depth.a,
                          f.by_depth.b, f.by_rate.a, f.by_rate.b);
        add_line<Damping>(modes.bc, m.depth.b, m.depth.c, m.rate.b, m.rate.c, m.impact_speed.b, m.impact_speed.c,
                          face.along, contact, &ApexSlopes<Real>::along, f.normal.b, f.normal.c, f.by_depth.b,
                          f.by_depth.c, f.by_rate.b, f.by_rate.c);
        add_line<Damping>(modes.cd, m.depth.c, m.depth.d, m.rate.c, m.rate.d, m.impact_speed.c, m.impact_speed.d,
                          face.across, contact, &ApexSlopes<Real>::across, f.normal.c, f.normal.d, f.by_depth.c,
                          f.by_depth.d, f.by_rate.c, f.by_rate.d);
        add_line<Damping>(modes.da, m.depth.d, m.depth.a, m.rate.d, m.rate.a, m.impact_speed.d, m.impact_speed.a,
                          face.along, contact, &ApexSlopes<Real>::along, f.normal.d, f.normal.a, f.by_depth.d,
                          f.by_depth.a, f.by_rate.d, f.by_rate.a);
        add_point<Damping>(modes.point.a, m.depth.a, m.rate.a, m.impact_speed.a, contact, f.normal.a, f.by_depth.a,
                           f.by_rate.a);
        add_point<Damping>(modes.point.b, m.depth.b, m.rate.b, m.impact_speed.b, contact, f.normal.b, f.by_depth.b,
                           f.by_rate.b);
        add_point<Damping>(modes.point.c, m.depth.c, m.rate.c, m.impact_speed.c, contact, f.normal.c, f.by_depth.c,
                           f.by_rate.c);
        add_point<Damping>(modes.point.d, m.depth.d, m.rate.d, m.impact_speed.d, contact, f.normal.d, f.by_depth.d,
                           f.by_rate.d);
        return f;
    }

private:
    /// F_i = kδ_i/4 · factor(mean rate): ∂F_i/∂δ_i = k/4 · factor, and all four rates change all four forces.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact, FaceStiffness<Real>& f) {
        Real const zero(0.0), quarter(0.25);
        Real const v0 = max(max(m.impact_speed.a, m.impact_speed.b), max(m.impact_speed.c, m.impact_speed.d));
        auto const damping = DampingStiffness<Damping>::surface(quarter * sum(m.rate), v0, contact.damping);
        Real const share = select(surface, quarter * face.surface_stiffness, zero);
        Real const stiffness = share * damping.factor;
        auto const add = [&](Real depth, Real& normal, ApexSlopes<Real>& by_depth, ApexSlopes<Real>& by_rate) {
            normal = stiffness * depth;
            by_depth.own = stiffness;
            if constexpr (DampingStiffness<Damping>::couples) {
                by_rate.own = by_rate.across = by_rate.along = by_rate.opposite =
                    quarter * share * depth * damping.by_rate;
            }
        };
        add(m.depth.a, f.normal.a, f.by_depth.a, f.by_rate.a);
        add(m.depth.b, f.normal.b, f.by_depth.b, f.by_rate.b);
        add(m.depth.c, f.normal.c, f.by_depth.c, f.by_rate.c);
        add(m.depth.d, f.normal.d, f.by_depth.d, f.by_rate.d);
    }

    /// F_i = F_j = P(δ̄)/2 · factor(δ̄'): all four derivatives are equal, P'/4 · factor.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_line(Mask<Real> line, Real const& depth_i, Real const& depth_j, Real const& rate_i,
                                     Real const& rate_j, Real const& v0_i, Real const& v0_j,
                                     LineContact<Real> const& edge, ContactParameters<Real> const& contact,
                                     Real ApexSlopes<Real>::*partner, Real& normal_i, Real& normal_j,
                                     ApexSlopes<Real>& by_depth_i, ApexSlopes<Real>& by_depth_j,
                                     ApexSlopes<Real>& by_rate_i, ApexSlopes<Real>& by_rate_j) {
        if (none(line)) return;
        Real const zero(0.0), half(0.5), quarter(0.25);
        Real const approach = select(line, half * (depth_i + depth_j), Real(1e-6));
        auto const elastic = line_stiffness(approach, edge);
        auto const damping =
            DampingStiffness<Damping>::line(half * (rate_i + rate_j), max(v0_i, v0_j), contact.damping);
        Real const load = select(line, elastic.load, zero);
        Real const normal = half * load * damping.factor;
        Real const slope = select(line, quarter * elastic.slope * damping.factor, zero);
        normal_i = normal_i + normal;
        normal_j = normal_j + normal;
        by_depth_i.own = by_depth_i.own + slope;
        by_depth_j.own = by_depth_j.own + slope;
        by_depth_i.*partner = slope;
        by_depth_j.*partner = slope;
        if constexpr (DampingStiffness<Damping>::couples) {
            Real const viscosity = quarter * load * damping.by_rate;
            by_rate_i.own = by_rate_i.own + viscosity;
            by_rate_j.own = by_rate_j.own + viscosity;
            by_rate_i.*partner = by_rate_i.*partner + viscosity;
            by_rate_j.*partner = by_rate_j.*partner + viscosity;
        }
    }

    template <class Damping, class Real>
    SLIDEWAY_FN static void add_point(Mask<Real> point, Real const& depth, Real const& rate, Real const& v0,
                                      ContactParameters<Real> const& contact, Real& normal, ApexSlopes<Real>& by_depth,
                                      ApexSlopes<Real>& by_rate) {
        if (none(point)) return;
        Real const zero(0.0);
        Real const d = select(point, depth, Real(1e-6));
        auto const elastic = point_stiffness(d, contact.point);
        auto const damped =
            DampingStiffness<Damping>::point(elastic.load, elastic.slope, d, rate, v0, contact.point, contact.damping);
        normal = normal + select(point, damped.force, zero);
        by_depth.own = by_depth.own + select(point, damped.by_depth, zero);
        by_rate.own = by_rate.own + select(point, damped.by_rate, zero);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
