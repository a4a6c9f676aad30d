#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/elements.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/law_info.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The conservative law: no switching.  The elastic force is −∂U/∂δ of U = Σ_apices K δⁿ⁺¹/(n+1) + Σ_edges V(h_e) + ½ k H², with the
/// harmonic means h_e = 2δiδj/(δi+δj) of an edge's apices and H = 4/Σ(1/δ) of all four, which vanish smoothly with any one
/// of their apices.  Source: model.md 4 (ours); where apices share a penetration it is the paper's law of that mode plus the
/// softer modes in parallel.
struct ConservativeLaw {
    static constexpr LawInfo info{.name = "conservative",
                                  .words = "one potential of all contacts, no switching",
                                  .switches = false,
                                  .continuous = true,
                                  .groups = contact_groups,
                                  .of_touching_alone = true};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& motion, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        auto m = with_safe_depths(motion, motion.touching);
        add_points<Damping>(m.touching, m, contact, f);
        auto edge = touching_edges<Real>(m.touching);
        if (any_of(edge)) add_lines<HarmonicMean, Damping>(edge, depth_reciprocals(edge, m), m, face, contact, f);
        Mask<Real> const surface = edge.a & edge.c;
        if (any(surface)) add_surface<Damping>(surface, m, face, contact, f);
        return f;
    }

    /// The Hessian of U times the damping factors, and what the factors add (elements.hpp).
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& motion, FaceContact<Real> const& face,
                                                           ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        auto const m = with_safe_depths(motion, motion.touching);
        add_points<Damping>(m.touching, m, contact, f);
        auto const edge = touching_edges<Real>(m.touching);
        add_lines<HarmonicMean, Damping>(edge, m, face, contact, f);
        Mask<Real> const surface = edge.a & edge.c;
        if (any(surface)) add_surface_slopes<Damping>(surface, m, face, contact, f);
        return f;
    }

private:
    /// 1/(δi + δj) of the edges that touch, by one division.
    template <class Real>
    SLIDEWAY_FN static Quad<Real> depth_reciprocals(Quad<Mask<Real>> const& edge, FaceMotion<Real> const& m) {
        auto const& d = m.apex;
        Real const one(1.0);
        if (none((edge.b | edge.c) | edge.d)) return {one / select(edge.a, d.a.depth + d.b.depth, one), one, one, one};
        return reciprocals(Quad<Real>{
            select(edge.a, d.a.depth + d.b.depth, one), select(edge.b, d.b.depth + d.c.depth, one),
            select(edge.c, d.c.depth + d.d.depth, one), select(edge.d, d.d.depth + d.a.depth, one)});
    }

    /// H = 4/Σ(1/δ) of a face and its slopes ∂H/∂δ.  With the products of the other three, p_a = bcd …, and q = p/Σp: H = 4 a q_a and
    /// ∂H/∂δ_a = 4 q_a²; one division serves all.
    template <class Real> struct SurfaceMean {
        Quad<Real> q;  // twice q
        Quad<Real> slope;
        Real mean, rate;
    };
    template <class Real> SLIDEWAY_FN static SurfaceMean<Real> surface_mean(Quad<ApexMotion<Real>> const& apex) {
        Real const ab = apex.a.depth * apex.b.depth, cd = apex.c.depth * apex.d.depth;
        Quad<Real> p{apex.b.depth * cd, apex.a.depth * cd, ab * apex.d.depth, ab * apex.c.depth};
        Real const scale = Real(2.0) / sum(p);
        Quad<Real> q{p.a * scale, p.b * scale, p.c * scale, p.d * scale};
        Quad<Real> slope{q.a * q.a, q.b * q.b, q.c * q.c, q.d * q.d};
        return {q, slope, Real(2.0) * apex.a.depth * q.a,
                fma(slope.a, apex.a.rate, slope.b * apex.b.rate) + fma(slope.c, apex.c.rate, slope.d * apex.d.rate)};
    }

    /// k H ∂H/∂δ.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact, FaceForces<Real>& f) {
        Real const zero(0.0);
        auto h = surface_mean(m.apex);
        Real const load = select(surface, face.surface_stiffness * h.mean, zero);
        Real const damped = load * Damping::surface_factor(h.rate, impact_speed(m), contact.damping);
        f.normal = {fma(damped, h.slope.a, f.normal.a), fma(damped, h.slope.b, f.normal.b),
                    fma(damped, h.slope.c, f.normal.c), fma(damped, h.slope.d, f.normal.d)};
        f.elastic = {fma(load, h.slope.a, f.elastic.a), fma(load, h.slope.b, f.elastic.b),
                     fma(load, h.slope.c, f.elastic.c), fma(load, h.slope.d, f.elastic.d)};
        f.potential = f.potential + Real(0.5) * load * h.mean;
    }

    /// H_i = 4 q_i² and H H_ij = 2 H_i H_j − [i=j] 32 q_i³: ∂F_i/∂δ_j = (3 k f + drag_j) H_i H_j − [i=j] 32 k f q_i³.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface_slopes(Mask<Real> surface, FaceMotion<Real> const& m,
                                               FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                               FaceStiffness<Real>& f) {
        Real const zero(0.0), four(4.0);
        auto const h = surface_mean(m.apex);
        auto const damping = Damping::surface_slopes(h.rate, impact_speed(m), contact.damping);
        Real const k = select(surface, face.surface_stiffness, zero);
        Real const stiffness = k * damping.factor;
        Quad<Real> drag{zero, zero, zero, zero};
        if constexpr (Damping::couples) drag = surface_drag(k, damping.by_rate, h, m);
        Real const three = Real(3.0) * stiffness;
        Quad<Real> const column{h.slope.a * (three + drag.a), h.slope.b * (three + drag.b),
                                h.slope.c * (three + drag.c), h.slope.d * (three + drag.d)};
        auto const add = [&](Real q_i, Real h_i, ApexSlopes<Real> const& by, Real& normal, ApexSlopes<Real>& by_depth) {
            normal = fma(stiffness * h.mean, h_i, normal);
            by_depth.own = by_depth.own + h_i * fnma(four * stiffness, q_i, by.own);
            by_depth.across = fma(h_i, by.across, by_depth.across);
            by_depth.along = fma(h_i, by.along, by_depth.along);
            by_depth.opposite = h_i * by.opposite;
        };
        add(h.q.a, h.slope.a, {column.a, column.b, column.d, column.c}, f.normal.a, f.by_depth.a);
        add(h.q.b, h.slope.b, {column.b, column.a, column.c, column.d}, f.normal.b, f.by_depth.b);
        add(h.q.c, h.slope.c, {column.c, column.d, column.b, column.a}, f.normal.c, f.by_depth.c);
        add(h.q.d, h.slope.d, {column.d, column.c, column.a, column.b}, f.normal.d, f.by_depth.d);
        if constexpr (Damping::couples) add_surface_rates(k * h.mean * damping.by_rate, h.slope, f);
    }

    /// H Σ_k H_jk δ_k' = 2 H_j (h' − 4 q_j δ_j'), as a share of H_j and times k ∂f/∂h'.
    template <class Real>
    SLIDEWAY_FN static Quad<Real> surface_drag(Real k, Real by_rate, SurfaceMean<Real> const& h,
                                               FaceMotion<Real> const& m) {
        auto const drag = [&](Real q_j, Real rate) {
            return Real(2.0) * k * by_rate * fnma(q_j + q_j, rate, h.rate);
        };
        return {drag(h.q.a, m.apex.a.rate), drag(h.q.b, m.apex.b.rate), drag(h.q.c, m.apex.c.rate),
                drag(h.q.d, m.apex.d.rate)};
    }

    /// ∂F_i/∂δ'_j = P ∂f/∂h' h_i h_j.  @param viscosity P ∂f/∂h'
    template <class Real>
    SLIDEWAY_FN static void add_surface_rates(Real viscosity, Quad<Real> const& slope, FaceStiffness<Real>& f) {
        auto const add = [&](Real h_i, Real across, Real along, Real opposite, ApexSlopes<Real>& by_rate) {
            Real const viscous = viscosity * h_i;
            by_rate.own = fma(viscous, h_i, by_rate.own);
            by_rate.across = fma(viscous, across, by_rate.across);
            by_rate.along = fma(viscous, along, by_rate.along);
            by_rate.opposite = viscous * opposite;
        };
        add(slope.a, slope.b, slope.d, slope.c, f.by_rate.a);
        add(slope.b, slope.a, slope.c, slope.d, f.by_rate.b);
        add(slope.c, slope.d, slope.b, slope.a, f.by_rate.c);
        add(slope.d, slope.c, slope.a, slope.b, f.by_rate.d);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
