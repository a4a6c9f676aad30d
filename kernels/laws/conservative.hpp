#pragma once

#include "kernels/laws/contact.hpp"
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
                                  .groups = contact_groups};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& motion, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        auto m = with_safe_depths(motion);
        add_point<Damping, 0>(m, contact, f);
        add_point<Damping, 1>(m, contact, f);
        add_point<Damping, 2>(m, contact, f);
        add_point<Damping, 3>(m, contact, f);
        auto edge = touching_edges<Real>(m.touching);
        if (any_of(edge)) add_edges<Damping>(edge, m, face, contact, f);
        Mask<Real> const surface = edge.a & edge.c;
        if (any(surface)) add_surface<Damping>(surface, m, face, contact, f);
        return f;
    }

    /// The Hessian of U times the damping factors, and what the factors add.  A line or surface of mean penetration h has
    /// F_i = P(h) f(h') h_i, where h_i = ∂h/∂δ_i and h' = Σ h_i δ_i', so that
    /// ∂F_i/∂δ_j = P' f h_i h_j + P f h_ij + P ∂f/∂h' h_i Σ_k h_jk δ_k' and ∂F_i/∂δ'_j = P ∂f/∂h' h_i h_j.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& motion, FaceContact<Real> const& face,
                                                           ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        auto const m = with_safe_depths(motion);
        add_point_slopes<Damping, 0>(m, contact, f);
        add_point_slopes<Damping, 1>(m, contact, f);
        add_point_slopes<Damping, 2>(m, contact, f);
        add_point_slopes<Damping, 3>(m, contact, f);
        auto const edge = touching_edges<Real>(m.touching);
        add_edge_slopes<Damping, 0>(edge, m, face.across, contact, f);
        add_edge_slopes<Damping, 1>(edge, m, face.along, contact, f);
        add_edge_slopes<Damping, 2>(edge, m, face.across, contact, f);
        add_edge_slopes<Damping, 3>(edge, m, face.along, contact, f);
        Mask<Real> const surface = edge.a & edge.c;
        if (any(surface)) add_surface_slopes<Damping>(surface, m, face, contact, f);
        return f;
    }

private:
    /// A floor for the depths of apices out of contact keeps every dead side finite.
    template <class Real> SLIDEWAY_FN static FaceMotion<Real> with_safe_depths(FaceMotion<Real> m) {
        Real const dead(1e-6);
        m.apex.a.depth = select(m.touching.a, m.apex.a.depth, dead);
        m.apex.b.depth = select(m.touching.b, m.apex.b.depth, dead);
        m.apex.c.depth = select(m.touching.c, m.apex.c.depth, dead);
        m.apex.d.depth = select(m.touching.d, m.apex.d.depth, dead);
        return m;
    }

    template <class Damping, int i, class Real>
    SLIDEWAY_FN static void add_point(FaceMotion<Real> const& m, ContactParameters<Real> const& contact,
                                      FaceForces<Real>& f) {
        auto const touching = at<i>(m.touching);
        if (none(touching)) return;
        Real const zero(0.0);
        auto const& apex = at<i>(m.apex);
        Real const load = point_load(apex.depth, contact.point);
        at<i>(f.normal) = select(touching, Damping::point_force(load, apex, contact.point, contact.damping), zero);
        at<i>(f.elastic) = select(touching, load, zero);
        f.potential = f.potential + select(touching, load * apex.depth * contact.point.potential_share, zero);
    }

    template <class Damping, int i, class Real>
    SLIDEWAY_FN static void add_point_slopes(FaceMotion<Real> const& m, ContactParameters<Real> const& contact,
                                             FaceStiffness<Real>& f) {
        auto const touching = at<i>(m.touching);
        if (none(touching)) return;
        Real const zero(0.0);
        auto const& apex = at<i>(m.apex);
        auto const damped =
            Damping::point_slopes(point_slope(apex.depth, contact.point), apex, contact.point, contact.damping);
        at<i>(f.normal) = select(touching, damped.force, zero);
        at<i>(f.by_depth).own = select(touching, damped.by_depth, zero);
        at<i>(f.by_rate).own = select(touching, damped.by_rate, zero);
    }

    /// The harmonic mean h = 2δiδj/(δi+δj) of an edge's apices and its slopes ∂h/∂δi = 2δj²/(δi+δj)².
    template <class Real> struct EdgeMean {
        Real mean, slope_i, slope_j;
        Real part_i, part_j;  // δi/(δi+δj) and δj/(δi+δj)
    };

    /// @param reciprocal 1/(δi+δj)
    template <int edge, class Real>
    SLIDEWAY_FN static EdgeMean<Real> edge_mean(FaceMotion<Real> const& m, Real reciprocal) {
        Real const two(2.0);
        Real const part_i = at<edge>(m.apex).depth * reciprocal, part_j = at<edge + 1>(m.apex).depth * reciprocal;
        return {two * at<edge>(m.apex).depth * part_j, two * part_j * part_j, two * part_i * part_i, part_i, part_j};
    }
    template <int edge, class Real> SLIDEWAY_FN static Real depth_sum(FaceMotion<Real> const& m) {
        return at<edge>(m.apex).depth + at<edge + 1>(m.apex).depth;
    }
    /// h' = Σ ∂h/∂δ δ'.
    template <int edge, class Real>
    SLIDEWAY_FN static Real edge_rate(EdgeMean<Real> const& mean, FaceMotion<Real> const& m) {
        return fma(mean.slope_i, at<edge>(m.apex).rate, mean.slope_j * at<edge + 1>(m.apex).rate);
    }

    template <class Damping, class Real>
    SLIDEWAY_FN static void add_edges(Quad<Mask<Real>> const& edge, FaceMotion<Real> const& m,
                                      FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                      FaceForces<Real>& f) {
        Real const one(1.0);
        auto inverse =
            reciprocals(Quad<Real>{select(edge.a, depth_sum<0>(m), one), select(edge.b, depth_sum<1>(m), one),
                                   select(edge.c, depth_sum<2>(m), one), select(edge.d, depth_sum<3>(m), one)});
        Quad<EdgeMean<Real>> mean{edge_mean<0>(m, inverse.a), edge_mean<1>(m, inverse.b), edge_mean<2>(m, inverse.c),
                                  edge_mean<3>(m, inverse.d)};
        auto lines = line_loads<Real>(edge, {mean.a.mean, mean.b.mean, mean.c.mean, mean.d.mean}, face.across, face.along);
        add_edge<Damping, 0>(at<0>(edge), lines.a, mean.a, m, contact, f);
        add_edge<Damping, 1>(at<1>(edge), lines.b, mean.b, m, contact, f);
        add_edge<Damping, 2>(at<2>(edge), lines.c, mean.c, m, contact, f);
        add_edge<Damping, 3>(at<3>(edge), lines.d, mean.d, m, contact, f);
    }

    /// P(h) ∂h/∂δ on both apices.
    template <class Damping, int edge, class Real>
    SLIDEWAY_FN static void add_edge(Mask<Real> touching, LineLoad<Real> const& line, EdgeMean<Real> const& mean,
                                     FaceMotion<Real> const& m, ContactParameters<Real> const& contact,
                                     FaceForces<Real>& f) {
        if (none(touching)) return;
        Real const zero(0.0);
        f.outside = f.outside | (touching & line.outside);
        Real const load = select(touching, line.load, zero);
        Real const damped =
            load * Damping::line_factor(edge_rate<edge>(mean, m), edge_impact_speed<edge>(m), contact.damping);
        at<edge>(f.normal) = fma(damped, mean.slope_i, at<edge>(f.normal));
        at<edge + 1>(f.normal) = fma(damped, mean.slope_j, at<edge + 1>(f.normal));
        at<edge>(f.elastic) = fma(load, mean.slope_i, at<edge>(f.elastic));
        at<edge + 1>(f.elastic) = fma(load, mean.slope_j, at<edge + 1>(f.elastic));
        f.potential = f.potential + select(touching, line.potential, zero);
    }

    /// h_aa = −4b²/(a+b)³, h_ab = 4ab/(a+b)³.
    template <class Damping, int edge, class Real>
    SLIDEWAY_FN static void add_edge_slopes(Quad<Mask<Real>> const& edges, FaceMotion<Real> const& m,
                                            LineContact<Real> const& of_edge, ContactParameters<Real> const& contact,
                                            FaceStiffness<Real>& f) {
        auto const touching = at<edge>(edges);
        if (none(touching)) return;
        Real const zero(0.0), two(2.0);
        Real const reciprocal = Real(1.0) / depth_sum<edge>(m);
        auto const mean = edge_mean<edge>(m, reciprocal);
        auto const line = line_slope(mean.mean, of_edge);
        auto const damping = Damping::line_slopes(edge_rate<edge>(mean, m), edge_impact_speed<edge>(m), contact.damping);
        Real const load = select(touching, line.load, zero);
        Real const damped = load * damping.factor;
        Real const stiffness = select(touching, line.slope * damping.factor, zero);
        at<edge>(f.normal) = fma(damped, mean.slope_i, at<edge>(f.normal));
        at<edge + 1>(f.normal) = fma(damped, mean.slope_j, at<edge + 1>(f.normal));

        Real const bend = two * damped * reciprocal;  // P f h_ij = bend · 2 part_i part_j, P f h_ii = −bend · h_i
        Real const mixed = fma(stiffness * mean.slope_i, mean.slope_j, bend * two * mean.part_i * mean.part_j);
        auto& by_i = at<edge>(f.by_depth);
        auto& by_j = at<edge + 1>(f.by_depth);
        by_i.own = by_i.own + mean.slope_i * fms(stiffness, mean.slope_i, bend);
        by_j.own = by_j.own + mean.slope_j * fms(stiffness, mean.slope_j, bend);
        partner<edge>(by_i) = partner<edge>(by_j) = mixed;
        if constexpr (Damping::couples) add_edge_rates<edge>(load * damping.by_rate, reciprocal, mean, m, f);
    }

    /// What the damping factor of an edge adds.  @param viscosity P ∂f/∂h'
    template <int edge, class Real>
    SLIDEWAY_FN static void add_edge_rates(Real viscosity, Real reciprocal, EdgeMean<Real> const& mean,
                                           FaceMotion<Real> const& m, FaceStiffness<Real>& f) {
        Real const viscous_i = viscosity * mean.slope_i, viscous_j = viscosity * mean.slope_j;
        auto& rate_i = at<edge>(f.by_rate);
        auto& rate_j = at<edge + 1>(f.by_rate);
        rate_i.own = fma(viscous_i, mean.slope_i, rate_i.own);
        rate_j.own = fma(viscous_j, mean.slope_j, rate_j.own);
        partner<edge>(rate_i) = partner<edge>(rate_j) = viscous_i * mean.slope_j;
        // Σ_k h_ik δ_k' = 4 part_j twist/(a + b), Σ_k h_jk δ_k' = −4 part_i twist/(a + b)
        Real const twist = Real(4.0) * reciprocal *
                           fms(mean.part_i, at<edge + 1>(m.apex).rate, mean.part_j * at<edge>(m.apex).rate);
        Real const by_i = mean.part_j * twist, by_j = negated(mean.part_i) * twist;
        auto& depth_i = at<edge>(f.by_depth);
        auto& depth_j = at<edge + 1>(f.by_depth);
        depth_i.own = fma(viscous_i, by_i, depth_i.own);
        partner<edge>(depth_i) = fma(viscous_i, by_j, partner<edge>(depth_i));
        depth_j.own = fma(viscous_j, by_j, depth_j.own);
        partner<edge>(depth_j) = fma(viscous_j, by_i, partner<edge>(depth_j));
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
