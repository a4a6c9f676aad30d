#pragma once

#include "kernels/laws/contact.hpp"
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
        .groups = contact_groups};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto modes = face_modes<Real>(m.touching);
        auto f = no_forces<Real>();
        if (any(modes.surface)) add_surface<Damping>(modes.surface, m, face, contact, f);
        if (any_of(modes.line)) add_lines<Damping>(modes.line, m, face, contact, f);
        add_point<Damping, 0>(modes.point, m, contact, f);
        add_point<Damping, 1>(modes.point, m, contact, f);
        add_point<Damping, 2>(modes.point, m, contact, f);
        add_point<Damping, 3>(modes.point, m, contact, f);
        return f;
    }

    /// Derivatives of the forces inside a mode; the jumps between modes have none.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                           ContactParameters<Real> const& contact) {
        auto const modes = face_modes<Real>(m.touching);
        auto f = FaceStiffness<Real>::none();
        if (any(modes.surface)) add_surface_slopes<Damping>(modes.surface, m, face, contact, f);
        add_line_slopes<Damping, 0>(modes.line, m, face.across, contact, f);
        add_line_slopes<Damping, 1>(modes.line, m, face.along, contact, f);
        add_line_slopes<Damping, 2>(modes.line, m, face.across, contact, f);
        add_line_slopes<Damping, 3>(modes.line, m, face.along, contact, f);
        add_point_slopes<Damping, 0>(modes.point, m, contact, f);
        add_point_slopes<Damping, 1>(modes.point, m, contact, f);
        add_point_slopes<Damping, 2>(modes.point, m, contact, f);
        add_point_slopes<Damping, 3>(modes.point, m, contact, f);
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

    /// δ̄ of a line: the mean of both its apices, and the same of their rates.
    template <int edge, class Real>
    SLIDEWAY_FN static Real line_approach(Quad<Mask<Real>> const& line, FaceMotion<Real> const& m) {
        Real const mean = Real(0.5) * (at<edge>(m.apex).depth + at<edge + 1>(m.apex).depth);
        return select(at<edge>(line), mean, Real(1e-6));
    }
    template <int edge, class Real> SLIDEWAY_FN static Real line_rate(FaceMotion<Real> const& m) {
        return Real(0.5) * (at<edge>(m.apex).rate + at<edge + 1>(m.apex).rate);
    }

    /// P(δ̄), P/2 at each apex.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_lines(Quad<Mask<Real>> const& line, FaceMotion<Real> const& m,
                                      FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                      FaceForces<Real>& f) {
        Quad<Real> approach{line_approach<0>(line, m), line_approach<1>(line, m), line_approach<2>(line, m),
                            line_approach<3>(line, m)};
        auto loads = line_loads<Real>(line, approach, face.across, face.along);
        add_line<Damping, 0>(line, loads, m, contact, f);
        add_line<Damping, 1>(line, loads, m, contact, f);
        add_line<Damping, 2>(line, loads, m, contact, f);
        add_line<Damping, 3>(line, loads, m, contact, f);
    }

    template <class Damping, int edge, class Real>
    SLIDEWAY_FN static void add_line(Quad<Mask<Real>> const& line, Quad<LineLoad<Real>> const& loads,
                                     FaceMotion<Real> const& m, ContactParameters<Real> const& contact,
                                     FaceForces<Real>& f) {
        auto const mode = at<edge>(line);
        if (none(mode)) return;
        Real const zero(0.0);
        auto const& load = at<edge>(loads);
        f.outside = f.outside | (mode & load.outside);
        Real const elastic = select(mode, Real(0.5) * load.load, zero);
        Real const normal =
            elastic * Damping::line_factor(line_rate<edge>(m), edge_impact_speed<edge>(m), contact.damping);
        at<edge>(f.normal) = at<edge>(f.normal) + normal;
        at<edge + 1>(f.normal) = at<edge + 1>(f.normal) + normal;
        at<edge>(f.elastic) = at<edge>(f.elastic) + elastic;
        at<edge + 1>(f.elastic) = at<edge + 1>(f.elastic) + elastic;
        f.potential = f.potential + select(mode, load.potential, zero);
    }

    /// F_i = F_j = P(δ̄)/2 · factor(δ̄'): all four derivatives are equal, P'/4 · factor.
    template <class Damping, int edge, class Real>
    SLIDEWAY_FN static void add_line_slopes(Quad<Mask<Real>> const& line, FaceMotion<Real> const& m,
                                            LineContact<Real> const& of_edge, ContactParameters<Real> const& contact,
                                            FaceStiffness<Real>& f) {
        auto const mode = at<edge>(line);
        if (none(mode)) return;
        Real const zero(0.0), half(0.5), quarter(0.25);
        auto const elastic = line_slope(line_approach<edge>(line, m), of_edge);
        auto const damping = Damping::line_slopes(line_rate<edge>(m), edge_impact_speed<edge>(m), contact.damping);
        Real const load = select(mode, elastic.load, zero);
        Real const normal = half * load * damping.factor;
        Real const slope = select(mode, quarter * elastic.slope * damping.factor, zero);
        auto const add = [&](Real& force, ApexSlopes<Real>& by_depth, ApexSlopes<Real>& by_rate) {
            force = force + normal;
            by_depth.own = by_depth.own + slope;
            partner<edge>(by_depth) = slope;
            if constexpr (Damping::couples) {
                Real const viscosity = quarter * load * damping.by_rate;
                by_rate.own = by_rate.own + viscosity;
                partner<edge>(by_rate) = partner<edge>(by_rate) + viscosity;
            }
        };
        add(at<edge>(f.normal), at<edge>(f.by_depth), at<edge>(f.by_rate));
        add(at<edge + 1>(f.normal), at<edge + 1>(f.by_depth), at<edge + 1>(f.by_rate));
    }

    /// K δⁿ + C δ δ'; U = K δⁿ⁺¹/(n + 1).
    template <class Damping, int i, class Real>
    SLIDEWAY_FN static void add_point(Quad<Mask<Real>> const& points, FaceMotion<Real> const& m,
                                      ContactParameters<Real> const& contact, FaceForces<Real>& f) {
        auto const point = at<i>(points);
        if (none(point)) return;
        Real const zero(0.0);
        // A held contact may part by a hair before its step ends.
        auto apex = at<i>(m.apex);
        apex.depth = max(select(point, apex.depth, Real(1e-6)), zero);
        Real const load = point_load(apex.depth, contact.point);
        Real const damped = Damping::point_force(load, apex, contact.point, contact.damping);
        at<i>(f.normal) = at<i>(f.normal) + select(point, damped, zero);
        at<i>(f.elastic) = at<i>(f.elastic) + select(point, load, zero);
        f.potential = f.potential + select(point, load * apex.depth * contact.point.potential_share, zero);
    }

    template <class Damping, int i, class Real>
    SLIDEWAY_FN static void add_point_slopes(Quad<Mask<Real>> const& points, FaceMotion<Real> const& m,
                                             ContactParameters<Real> const& contact, FaceStiffness<Real>& f) {
        auto const point = at<i>(points);
        if (none(point)) return;
        Real const zero(0.0);
        auto apex = at<i>(m.apex);
        apex.depth = select(point, apex.depth, Real(1e-6));
        auto const damped =
            Damping::point_slopes(point_slope(apex.depth, contact.point), apex, contact.point, contact.damping);
        at<i>(f.normal) = at<i>(f.normal) + select(point, damped.force, zero);
        at<i>(f.by_depth).own = at<i>(f.by_depth).own + select(point, damped.by_depth, zero);
        at<i>(f.by_rate).own = at<i>(f.by_rate).own + select(point, damped.by_rate, zero);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
