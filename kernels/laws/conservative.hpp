#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The conservative law: no switching.  The elastic force is −∂U/∂δ of U = Σ_apices K δⁿ⁺¹/(n+1) + Σ_edges V(h_e) + ½ k H², with the
/// harmonic means h_e = 2δiδj/(δi+δj) of an edge's apices and H = 4/Σ(1/δ) of all four, which vanish smoothly with any one
/// of their apices.  Source: model.md 4 (ours); where apices share a penetration it is the paper's law of that mode plus the
/// softer modes in parallel.
struct ConservativeLaw {
    static constexpr bool switches = false;  // it conserves energy, but for friction and damping

    /// Not inlined: a mechanism calls it for four faces in several variants, and the code would multiply.
    /// @tparam Full also the elastic forces and the potential; without, they are zero.
    template <class Damping, bool Full = true, class Real>
    SLIDEWAY_NOINLINE static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        Real const zero(0.0);
        FaceForces<Real> f{{zero, zero, zero, zero}, {zero, zero, zero, zero}, zero, mask_of<Real>(false)};
        Quad<Mask<Real>> t = m.touching;
        // A floor for the depths of apices out of contact keeps every dead side finite.
        Real const dead(1e-6);
        Quad<Real> depth{select(t.a, m.depth.a, dead), select(t.b, m.depth.b, dead), select(t.c, m.depth.c, dead),
                         select(t.d, m.depth.d, dead)};
        add_point<Damping>(t.a, depth.a, m.rate.a, m.impact_speed.a, contact, f.normal.a, f.elastic.a, f.potential);
        add_point<Damping>(t.b, depth.b, m.rate.b, m.impact_speed.b, contact, f.normal.b, f.elastic.b, f.potential);
        add_point<Damping>(t.c, depth.c, m.rate.c, m.impact_speed.c, contact, f.normal.c, f.elastic.c, f.potential);
        add_point<Damping>(t.d, depth.d, m.rate.d, m.impact_speed.d, contact, f.normal.d, f.elastic.d, f.potential);

        Mask<Real> const ab = t.a & t.b, bc = t.b & t.c, cd = t.c & t.d, da = t.d & t.a;
        Quad<Mask<Real>> edge{ab, bc, cd, da};
        if (any((ab | bc) | (cd | da))) add_edges<Damping>(edge, depth, m, face, contact, f);
        Mask<Real> const surface = ab & cd;
        if (any(surface)) add_surface<Damping>(surface, depth, m, face, contact, f);
        // Made anew, so that the sums above live in registers and not in the caller's memory.
        if constexpr (Full) return {f.normal, f.elastic, f.potential, f.outside};
        return {f.normal, {zero, zero, zero, zero}, zero, f.outside};
    }

private:
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_point(Mask<Real> touching, Real const& depth, Real const& rate, Real const& v0,
                                      ContactParameters<Real> const& contact, Real& normal, Real& elastic,
                                      Real& potential) {
        if (none(touching)) return;
        Real const zero(0.0);
        Real const load = point_load(depth, contact.point);
        normal = select(touching, Damping::point_force(load, depth, rate, v0, contact.point, contact.damping), zero);
        elastic = select(touching, load, zero);
        potential = potential + select(touching, load * depth * contact.point.potential_share, zero);
    }

    /// The harmonic mean h = 2δiδj/(δi+δj) of an edge's apices and its slopes ∂h/∂δi = 2δj²/(δi+δj)².
    template <class Real> struct EdgeMean { Real mean, slope_i, slope_j; };

    template <class Real> SLIDEWAY_FN static EdgeMean<Real> edge_mean(Real depth_i, Real depth_j, Real reciprocal) {
        Real const two(2.0);
        Real const part_i = depth_i * reciprocal, part_j = depth_j * reciprocal;
        return {two * depth_i * part_j, two * part_j * part_j, two * part_i * part_i};
    }

    template <class Damping, class Real>
    SLIDEWAY_FN static void add_edges(Quad<Mask<Real>> const& edge, Quad<Real> const& d, FaceMotion<Real> const& m,
                                      FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                      FaceForces<Real>& f) {
        Real const one(1.0);
        auto inverse = reciprocals(Quad<Real>{select(edge.a, d.a + d.b, one), select(edge.b, d.b + d.c, one),
                                              select(edge.c, d.c + d.d, one), select(edge.d, d.d + d.a, one)});
        auto ab = edge_mean(d.a, d.b, inverse.a), bc = edge_mean(d.b, d.c, inverse.b);
        auto cd = edge_mean(d.c, d.d, inverse.c), da = edge_mean(d.d, d.a, inverse.d);
        auto lines = line_loads<Real>(edge, {ab.mean, bc.mean, cd.mean, da.mean}, face.across, face.along);
        add_edge<Damping>(edge.a, lines.a, ab, m.rate.a, m.rate.b, m.impact_speed.a, m.impact_speed.b, contact,
                          f.normal.a, f.normal.b, f.elastic.a, f.elastic.b, f);
        add_edge<Damping>(edge.b, lines.b, bc, m.rate.b, m.rate.c, m.impact_speed.b, m.impact_speed.c, contact,
                          f.normal.b, f.normal.c, f.elastic.b, f.elastic.c, f);
        add_edge<Damping>(edge.c, lines.c, cd, m.rate.c, m.rate.d, m.impact_speed.c, m.impact_speed.d, contact,
                          f.normal.c, f.normal.d, f.elastic.c, f.elastic.d, f);
        add_edge<Damping>(edge.d, lines.d, da, m.rate.d, m.rate.a, m.impact_speed.d, m.impact_speed.a, contact,
                          f.normal.d, f.normal.a, f.elastic.d, f.elastic.a, f);
    }

    /// P(h) ∂h/∂δ on both apices.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_edge(Mask<Real> touching, LineLoad<Real> const& line, EdgeMean<Real> const& edge,
                                     Real const& rate_i, Real const& rate_j, Real const& v0_i, Real const& v0_j,
                                     ContactParameters<Real> const& contact, Real& normal_i, Real& normal_j,
                                     Real& elastic_i, Real& elastic_j, FaceForces<Real>& f) {
        if (none(touching)) return;
        Real const zero(0.0);
        f.outside = f.outside | (touching & line.outside);
        Real const mean_rate = fma(edge.slope_i, rate_i, edge.slope_j * rate_j);
        Real const load = select(touching, line.load, zero);
        Real const damped = load * Damping::line_factor(mean_rate, max(v0_i, v0_j), contact.damping);
        normal_i = fma(damped, edge.slope_i, normal_i);
        normal_j = fma(damped, edge.slope_j, normal_j);
        elastic_i = fma(load, edge.slope_i, elastic_i);
        elastic_j = fma(load, edge.slope_j, elastic_j);
        f.potential = f.potential + select(touching, line.potential, zero);
    }

    /// k H ∂H/∂δ.  With the products of the other three, p_a = bcd …, and q = p/Σp: H = 4 a q_a and ∂H/∂δ_a = 4 q_a²; one
    /// division serves all.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, Quad<Real> const& d, FaceMotion<Real> const& m,
                                        FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                        FaceForces<Real>& f) {
        Real const zero(0.0);
        Real const ab = d.a * d.b, cd = d.c * d.d;
        Quad<Real> p{d.b * cd, d.a * cd, ab * d.d, ab * d.c};
        Real const scale = Real(2.0) / sum(p);
        Quad<Real> q{p.a * scale, p.b * scale, p.c * scale, p.d * scale};  // twice q
        Quad<Real> slope{q.a * q.a, q.b * q.b, q.c * q.c, q.d * q.d};
        Real const mean = Real(2.0) * d.a * q.a;
        Real const mean_rate = fma(slope.a, m.rate.a, slope.b * m.rate.b) + fma(slope.c, m.rate.c, slope.d * m.rate.d);
        Real const v0 = max(max(m.impact_speed.a, m.impact_speed.b), max(m.impact_speed.c, m.impact_speed.d));
        Real const load = select(surface, face.surface_stiffness * mean, zero);
        Real const damped = load * Damping::surface_factor(mean_rate, v0, contact.damping);
        f.normal = {fma(damped, slope.a, f.normal.a), fma(damped, slope.b, f.normal.b),
                    fma(damped, slope.c, f.normal.c), fma(damped, slope.d, f.normal.d)};
        f.elastic = {fma(load, slope.a, f.elastic.a), fma(load, slope.b, f.elastic.b), fma(load, slope.c, f.elastic.c),
                     fma(load, slope.d, f.elastic.d)};
        f.potential = f.potential + Real(0.5) * load * mean;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
