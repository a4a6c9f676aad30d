// The contacts that laws are made of, each a load P of one penetration h that its apices share: an apex alone (a point, h = δ), and the
// edge between two apices (a line, h a mean of theirs).  Which there are, and what mean, a law says; how a contact adds to the forces and
// to the stiffness of its face stands here, once for all laws:
//   F_i = P(h) f(h') h_i,   ∂F_i/∂δ_j = P' f h_i h_j + P f h_ij + P ∂f/∂h' h_i Σ_k h_jk δ_k',   ∂F_i/∂δ'_j = P ∂f/∂h' h_i h_j
// with h_i = ∂h/∂δ_i, h' = Σ h_i δ_i' and the factor f of the damping.
#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

// ---- points ----

/// The same face with depths that every contact can work on: positive where an apex does not touch, and not negative where one has
/// parted by a hair while its contact is held.
template <class Real>
SLIDEWAY_FN FaceMotion<Real> with_safe_depths(FaceMotion<Real> m, Quad<Mask<Real>> const& touching) {
    Real const dead(1e-6), zero(0.0);
    m.apex.a.depth = max(select(touching.a, m.apex.a.depth, dead), zero);
    m.apex.b.depth = max(select(touching.b, m.apex.b.depth, dead), zero);
    m.apex.c.depth = max(select(touching.c, m.apex.c.depth, dead), zero);
    m.apex.d.depth = max(select(touching.d, m.apex.d.depth, dead), zero);
    return m;
}

/// K δⁿ with its damping; U = K δⁿ⁺¹/(n + 1).  @param m with safe depths
template <class Damping, int i, class Real>
SLIDEWAY_FN void add_point(Quad<Mask<Real>> const& points, FaceMotion<Real> const& m,
                           ContactParameters<Real> const& contact, FaceForces<Real>& f) {
    auto const point = at<i>(points);
    if (none(point)) return;
    Real const zero(0.0);
    auto const& apex = at<i>(m.apex);
    Real const load = point_load(apex.depth, contact.point);
    Real const damped = Damping::point_force(load, apex, contact.point, contact.damping);
    at<i>(f.normal) = at<i>(f.normal) + select(point, damped, zero);
    at<i>(f.elastic) = at<i>(f.elastic) + select(point, load, zero);
    f.potential = f.potential + select(point, load * apex.depth * contact.point.potential_share, zero);
}

template <class Damping, int i, class Real>
SLIDEWAY_FN void add_point(Quad<Mask<Real>> const& points, FaceMotion<Real> const& m,
                           ContactParameters<Real> const& contact, FaceStiffness<Real>& f) {
    auto const point = at<i>(points);
    if (none(point)) return;
    Real const zero(0.0);
    auto const& apex = at<i>(m.apex);
    auto const damped =
        Damping::point_slopes(point_slope(apex.depth, contact.point), apex, contact.point, contact.damping);
    at<i>(f.normal) = at<i>(f.normal) + select(point, damped.force, zero);
    at<i>(f.by_depth).own = at<i>(f.by_depth).own + select(point, damped.by_depth, zero);
    at<i>(f.by_rate).own = at<i>(f.by_rate).own + select(point, damped.by_rate, zero);
}

/// All four, to forces or to stiffness.
template <class Damping, class Real, class Sum>
SLIDEWAY_FN void add_points(Quad<Mask<Real>> const& points, FaceMotion<Real> const& m,
                            ContactParameters<Real> const& contact, Sum& f) {
    add_point<Damping, 0>(points, m, contact, f);
    add_point<Damping, 1>(points, m, contact, f);
    add_point<Damping, 2>(points, m, contact, f);
    add_point<Damping, 3>(points, m, contact, f);
}

// ---- lines ----

/// The mean penetration h of an edge's apices i and j, and how it follows from them.
template <class Real> struct EdgeMean {
    Real mean, rate;        // h [m], h' [m/s]
    Real slope_i, slope_j;  // ∂h/∂δ_i, ∂h/∂δ_j
    // Of a mean that is not linear: h_ii = −bend slope_i and h_ij = 2 bend part_i part_j.
    Real bend, part_i, part_j;
};

/// h = (δi + δj)/2.
struct ArithmeticMean {
    static constexpr bool is_curved = false;

    template <int edge, class Real>
    SLIDEWAY_FN static EdgeMean<Real> of(Mask<Real> line, FaceMotion<Real> const& m, Real const&) {
        Real const zero(0.0), half(0.5);
        auto const &i = at<edge>(m.apex), &j = at<edge + 1>(m.apex);
        return {select(line, half * (i.depth + j.depth), Real(1e-6)), half * (i.rate + j.rate), half, half, zero, zero, zero};
    }
};

/// h = 2δiδj/(δi + δj), which vanishes smoothly with either: ∂h/∂δi = 2δj²/(δi+δj)², h_ii = −4δj²/(δi+δj)³, h_ij = 4δiδj/(δi+δj)³.
struct HarmonicMean {
    static constexpr bool is_curved = true;

    /// @param reciprocal 1/(δi + δj)
    template <int edge, class Real>
    SLIDEWAY_FN static EdgeMean<Real> of(Mask<Real>, FaceMotion<Real> const& m, Real const& reciprocal) {
        Real const two(2.0);
        auto const &i = at<edge>(m.apex), &j = at<edge + 1>(m.apex);
        Real const part_i = i.depth * reciprocal, part_j = j.depth * reciprocal;
        Real const slope_i = two * part_j * part_j, slope_j = two * part_i * part_i;
        return {two * i.depth * part_j, fma(slope_i, i.rate, slope_j * j.rate), slope_i, slope_j, two * reciprocal,
                part_i, part_j};
    }
};

/// An edge's line contact, to the forces.
template <class Damping, int edge, class Real>
SLIDEWAY_FN void add_line(Quad<Mask<Real>> const& lines, LineLoad<Real> const& line, EdgeMean<Real> const& h,
                          FaceMotion<Real> const& m, ContactParameters<Real> const& contact, FaceForces<Real>& f) {
    auto const touching = at<edge>(lines);
    if (none(touching)) return;
    Real const zero(0.0);
    f.outside = f.outside | (touching & line.outside);
    Real const load = select(touching, line.load, zero);
    Real const damped = load * Damping::line_factor(h.rate, edge_impact_speed<edge>(m), contact.damping);
    at<edge>(f.normal) = fma(damped, h.slope_i, at<edge>(f.normal));
    at<edge + 1>(f.normal) = fma(damped, h.slope_j, at<edge + 1>(f.normal));
    at<edge>(f.elastic) = fma(load, h.slope_i, at<edge>(f.elastic));
    at<edge + 1>(f.elastic) = fma(load, h.slope_j, at<edge + 1>(f.elastic));
    f.potential = f.potential + select(touching, line.potential, zero);
}

/// The four of a face, of means whose reciprocals 1/(δi + δj) one division served.
template <class Mean, class Damping, class Real>
SLIDEWAY_FN void add_lines(Quad<Mask<Real>> const& lines, Quad<Real> const& reciprocal, FaceMotion<Real> const& m,
                           FaceContact<Real> const& face, ContactParameters<Real> const& contact, FaceForces<Real>& f) {
    if (none((lines.b | lines.c) | lines.d)) {
        auto h = Mean::template of<0>(lines.a, m, reciprocal.a);
        add_line<Damping, 0>(lines, line_load<Real>(lines.a, h.mean, face.across), h, m, contact, f);
        return;
    }
    Quad<EdgeMean<Real>> h{Mean::template of<0>(lines.a, m, reciprocal.a), Mean::template of<1>(lines.b, m, reciprocal.b),
                           Mean::template of<2>(lines.c, m, reciprocal.c), Mean::template of<3>(lines.d, m, reciprocal.d)};
    auto loads = line_loads<Real>(lines, {h.a.mean, h.b.mean, h.c.mean, h.d.mean}, face.across, face.along);
    add_line<Damping, 0>(lines, loads.a, h.a, m, contact, f);
    add_line<Damping, 1>(lines, loads.b, h.b, m, contact, f);
    add_line<Damping, 2>(lines, loads.c, h.c, m, contact, f);
    add_line<Damping, 3>(lines, loads.d, h.d, m, contact, f);
}

/// What the damping factor of an edge adds.  @param viscosity P ∂f/∂h'
template <class Mean, int edge, class Real>
SLIDEWAY_FN void add_line_rates(Real viscosity, EdgeMean<Real> const& h, FaceMotion<Real> const& m, FaceStiffness<Real>& f) {
    Real const viscous_i = viscosity * h.slope_i, viscous_j = viscosity * h.slope_j;
    auto& rate_i = at<edge>(f.by_rate);
    auto& rate_j = at<edge + 1>(f.by_rate);
    rate_i.own = fma(viscous_i, h.slope_i, rate_i.own);
    rate_j.own = fma(viscous_j, h.slope_j, rate_j.own);
    partner<edge>(rate_i) = partner<edge>(rate_i) + viscous_i * h.slope_j;
    partner<edge>(rate_j) = partner<edge>(rate_j) + viscous_i * h.slope_j;
    if constexpr (Mean::is_curved) {
        // Σ_k h_ik δ_k' = part_j twist, Σ_k h_jk δ_k' = −part_i twist
        Real const twist =
            Real(2.0) * h.bend * fms(h.part_i, at<edge + 1>(m.apex).rate, h.part_j * at<edge>(m.apex).rate);
        Real const by_i = h.part_j * twist, by_j = negated(h.part_i) * twist;
        auto& depth_i = at<edge>(f.by_depth);
        auto& depth_j = at<edge + 1>(f.by_depth);
        depth_i.own = fma(viscous_i, by_i, depth_i.own);
        partner<edge>(depth_i) = fma(viscous_i, by_j, partner<edge>(depth_i));
        depth_j.own = fma(viscous_j, by_j, depth_j.own);
        partner<edge>(depth_j) = fma(viscous_j, by_i, partner<edge>(depth_j));
    }
}

/// An edge's line contact, to the stiffness.
template <class Mean, class Damping, int edge, class Real>
SLIDEWAY_FN void add_line(Quad<Mask<Real>> const& lines, FaceMotion<Real> const& m, LineContact<Real> const& of_edge,
                          ContactParameters<Real> const& contact, FaceStiffness<Real>& f) {
    auto const touching = at<edge>(lines);
    if (none(touching)) return;
    Real const zero(0.0);
    Real reciprocal = zero;
    if constexpr (Mean::is_curved) reciprocal = Real(1.0) / (at<edge>(m.apex).depth + at<edge + 1>(m.apex).depth);
    auto const h = Mean::template of<edge>(touching, m, reciprocal);
    auto const elastic = line_slope(h.mean, of_edge);
    auto const damping = Damping::line_slopes(h.rate, edge_impact_speed<edge>(m), contact.damping);
    Real const load = select(touching, elastic.load, zero);
    Real const damped = load * damping.factor;
    Real const stiffness = select(touching, elastic.slope * damping.factor, zero);
    at<edge>(f.normal) = fma(damped, h.slope_i, at<edge>(f.normal));
    at<edge + 1>(f.normal) = fma(damped, h.slope_j, at<edge + 1>(f.normal));

    auto& by_i = at<edge>(f.by_depth);
    auto& by_j = at<edge + 1>(f.by_depth);
    Real const bend = damped * h.bend;
    Real const mixed = fma(stiffness * h.slope_i, h.slope_j, bend * Real(2.0) * h.part_i * h.part_j);
    by_i.own = by_i.own + h.slope_i * fms(stiffness, h.slope_i, bend);
    by_j.own = by_j.own + h.slope_j * fms(stiffness, h.slope_j, bend);
    partner<edge>(by_i) = partner<edge>(by_i) + mixed;
    partner<edge>(by_j) = partner<edge>(by_j) + mixed;
    if constexpr (Damping::couples) add_line_rates<Mean, edge>(load * damping.by_rate, h, m, f);
}

/// The four of a face.
template <class Mean, class Damping, class Real>
SLIDEWAY_FN void add_lines(Quad<Mask<Real>> const& lines, FaceMotion<Real> const& m, FaceContact<Real> const& face,
                           ContactParameters<Real> const& contact, FaceStiffness<Real>& f) {
    add_line<Mean, Damping, 0>(lines, m, face.across, contact, f);
    add_line<Mean, Damping, 1>(lines, m, face.along, contact, f);
    add_line<Mean, Damping, 2>(lines, m, face.across, contact, f);
    add_line<Mean, Damping, 3>(lines, m, face.along, contact, f);
}

}  // namespace slideway::inline SLIDEWAY_ISA
