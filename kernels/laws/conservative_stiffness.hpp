#pragma once

#include "kernels/laws/conservative.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/contact_stiffness.hpp"
#include "kernels/laws/damping_stiffness.hpp"
#include "kernels/laws/face_stiffness.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Derivatives of ConservativeLaw::forces: the Hessian of U times the damping factors, and what the factors add.
/// A line or surface of mean penetration h has F_i = P(h) f(h') h_i, where h_i = ∂h/∂δ_i and h' = Σ h_i δ_i', so that
/// ∂F_i/∂δ_j = P' f h_i h_j + P f h_ij + P ∂f/∂h' h_i Σ_k h_jk δ_k' and ∂F_i/∂δ'_j = P ∂f/∂h' h_i h_j.
template <> struct LawStiffness<ConservativeLaw> {
    template <class Damping, class Real>
    SLIDEWAY_NOINLINE static FaceStiffness<Real> face(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                      ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        auto const& t = m.touching;
        // A floor for the depths of apices out of contact keeps every dead side finite.
        Real const dead(1e-6);
        Quad<Real> const depth{select(t.a, m.depth.a, dead), select(t.b, m.depth.b, dead), select(t.c, m.depth.c, dead),
                               select(t.d, m.depth.d, dead)};
        add_point<Damping>(t.a, depth.a, m.rate.a, m.impact_speed.a, contact, f.normal.a, f.by_depth.a, f.by_rate.a);
        add_point<Damping>(t.b, depth.b, m.rate.b, m.impact_speed.b, contact, f.normal.b, f.by_depth.b, f.by_rate.b);
        add_point<Damping>(t.c, depth.c, m.rate.c, m.impact_speed.c, contact, f.normal.c, f.by_depth.c, f.by_rate.c);
        add_point<Damping>(t.d, depth.d, m.rate.d, m.impact_speed.d, contact, f.normal.d, f.by_depth.d, f.by_rate.d);

        auto const ab = t.a & t.b, bc = t.b & t.c, cd = t.c & t.d, da = t.d & t.a;
        add_edge<Damping>(ab, depth.a, depth.b, m.rate.a, m.rate.b, m.impact_speed.a, m.impact_speed.b, face.across,
                          contact, &ApexSlopes<Real>::across, f.normal.a, f.normal.b, f.by_depth.a, f.by_depth.b,
                          f.by_rate.a, f.by_rate.b);
        add_edge<Damping>(bc, depth.b, depth.c, m.rate.b, m.rate.c, m.impact_speed.b, m.impact_speed.c, face.along,
                          contact, &ApexSlopes<Real>::along, f.normal.b, f.normal.c, f.by_depth.b, f.by_depth.c,
                          f.by_rate.b, f.by_rate.c);
        add_edge<Damping>(cd, depth.c, depth.d, m.rate.c, m.rate.d, m.impact_speed.c, m.impact_speed.d, face.across,
                          contact, &ApexSlopes<Real>::across, f.normal.c, f.normal.d, f.by_depth.c, f.by_depth.d,
                          f.by_rate.c, f.by_rate.d);
        add_edge<Damping>(da, depth.d, depth.a, m.rate.d, m.rate.a, m.impact_speed.d, m.impact_speed.a, face.along,
                          contact, &ApexSlopes<Real>::along, f.normal.d, f.normal.a, f.by_depth.d, f.by_depth.a,
                          f.by_rate.d, f.by_rate.a);

        auto const surface = ab & cd;
        if (any(surface)) add_surface<Damping>(surface, depth, m, face, contact, f);
        return f;
    }

private:
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_point(Mask<Real> touching, Real const& depth, Real const& rate, Real const& v0,
                                      ContactParameters<Real> const& contact, Real& normal, ApexSlopes<Real>& by_depth,
                                      ApexSlopes<Real>& by_rate) {
        if (none(touching)) return;
        Real const zero(0.0);
        auto const elastic = point_stiffness(depth, contact.point);
        auto const damped = DampingStiffness<Damping>::point(elastic.load, elastic.slope, depth, rate, v0,
                                                             contact.point, contact.damping);
        normal = select(touching, damped.force, zero);
        by_depth.own = select(touching, damped.by_depth, zero);
        by_rate.own = select(touching, damped.by_rate, zero);
    }

    /// h = 2ab/(a+b): h_a = 2b²/(a+b)², h_aa = −4b²/(a+b)³, h_ab = 4ab/(a+b)³.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_edge(Mask<Real> touching, Real const& depth_i, Real const& depth_j, Real const& rate_i,
                                     Real const& rate_j, Real const& v0_i, Real const& v0_j,
                                     LineContact<Real> const& edge, ContactParameters<Real> const& contact,
                                     Real ApexSlopes<Real>::*partner, Real& normal_i, Real& normal_j,
                                     ApexSlopes<Real>& by_depth_i, ApexSlopes<Real>& by_depth_j,
                                     ApexSlopes<Real>& by_rate_i, ApexSlopes<Real>& by_rate_j) {
        if (none(touching)) return;
        Real const zero(0.0), two(2.0);
        Real const reciprocal = Real(1.0) / (depth_i + depth_j);
        Real const part_i = depth_i * reciprocal, part_j = depth_j * reciprocal;
        Real const slope_i = two * part_j * part_j, slope_j = two * part_i * part_i;
        auto const line = line_stiffness(two * depth_i * part_j, edge);
        Real const mean_rate = fma(slope_i, rate_i, slope_j * rate_j);
        auto const damping = DampingStiffness<Damping>::line(mean_rate, max(v0_i, v0_j), contact.damping);
        Real const load = select(touching, line.load, zero);
        Real const damped = load * damping.factor;
        Real const stiffness = select(touching, line.slope * damping.factor, zero);
        normal_i = fma(damped, slope_i, normal_i);
        normal_j = fma(damped, slope_j, normal_j);

        Real const bend = two * damped * reciprocal;  // P f h_ij = bend · 2 part_i part_j, P f h_ii = −bend · h_i
        Real const mixed = fma(stiffness * slope_i, slope_j, bend * two * part_i * part_j);
        by_depth_i.own = by_depth_i.own + slope_i * fms(stiffness, slope_i, bend);
        by_depth_j.own = by_depth_j.own + slope_j * fms(stiffness, slope_j, bend);
        by_depth_i.*partner = mixed;
        by_depth_j.*partner = mixed;
        if constexpr (DampingStiffness<Damping>::couples) {
            Real const viscosity = load * damping.by_rate;
            Real const viscous_i = viscosity * slope_i, viscous_j = viscosity * slope_j;
            by_rate_i.own = fma(viscous_i, slope_i, by_rate_i.own);
            by_rate_j.own = fma(viscous_j, slope_j, by_rate_j.own);
            by_rate_i.*partner = by_rate_j.*partner = viscous_i * slope_j;
            // Σ_k h_ik δ_k' = 4 part_j twist/(a + b), Σ_k h_jk δ_k' = −4 part_i twist/(a + b)
            Real const twist = Real(4.0) * reciprocal * fms(part_i, rate_j, part_j * rate_i);
            Real const by_i = part_j * twist, by_j = negated(part_i) * twist;
            by_depth_i.own = fma(viscous_i, by_i, by_depth_i.own);
            by_depth_i.*partner = fma(viscous_i, by_j, by_depth_i.*partner);
            by_depth_j.own = fma(viscous_j, by_j, by_depth_j.own);
            by_depth_j.*partner = fma(viscous_j, by_i, by_depth_j.*partner);
        }
    }

    /// P = kH, H = 4/Σ(1/δ).  With q_i = (1/δ_i)/Σ(1/δ): H = 4 δ_i q_i, H_i = 4 q_i² and H H_ij = 2 H_i H_j − [i=j] 32 q_i³.
    template <class Damping, class Real>
    SLIDEWAY_FN static void add_surface(Mask<Real> surface, Quad<Real> const& d, FaceMotion<Real> const& m,
                                        FaceContact<Real> const& face, ContactParameters<Real> const& contact,
                                        FaceStiffness<Real>& f) {
        Real const zero(0.0), four(4.0);
        Real const ab = d.a * d.b, cd = d.c * d.d;
        Quad<Real> const p{d.b * cd, d.a * cd, ab * d.d, ab * d.c};
        Real const scale = Real(2.0) / sum(p);
        Quad<Real> const q{p.a * scale, p.b * scale, p.c * scale, p.d * scale};  // twice q
        Quad<Real> const slope{q.a * q.a, q.b * q.b, q.c * q.c, q.d * q.d};
        Real const mean = Real(2.0) * d.a * q.a;
        Real const mean_rate = fma(slope.a, m.rate.a, slope.b * m.rate.b) + fma(slope.c, m.rate.c, slope.d * m.rate.d);
        Real const v0 = max(max(m.impact_speed.a, m.impact_speed.b), max(m.impact_speed.c, m.impact_speed.d));
        auto const damping = DampingStiffness<Damping>::surface(mean_rate, v0, contact.damping);
        Real const k = select(surface, face.surface_stiffness, zero);
        Real const stiffness = k * damping.factor;
        Real const viscosity = k * mean * damping.by_rate;
        // H Σ_k H_jk δ_k' = 2 H_j (h' − 4 q_j δ_j'), as a share of H_j and times k ∂f/∂h'
        auto const drag = [&](Real q_j, Real rate) {
            return Real(2.0) * k * damping.by_rate * fnma(q_j + q_j, rate, mean_rate);
        };
        Quad<Real> drags{zero, zero, zero, zero};
        if constexpr (DampingStiffness<Damping>::couples) {
            drags = {drag(q.a, m.rate.a), drag(q.b, m.rate.b), drag(q.c, m.rate.c), drag(q.d, m.rate.d)};
        }
        // ∂F_i/∂δ_j = (3 k f + drag_j) H_i H_j − [i=j] 32 k f q_i³
        Real const three = Real(3.0) * stiffness;
        Quad<Real> const column{slope.a * (three + drags.a), slope.b * (three + drags.b), slope.c * (three + drags.c),
                                slope.d * (three + drags.d)};
        auto const add = [&](Real q_i, Real h_i, Real across, Real along, Real opposite, Real own, Real& normal,
                             ApexSlopes<Real>& by_depth) {
            normal = fma(stiffness * mean, h_i, normal);
            by_depth.own = by_depth.own + h_i * fnma(four * stiffness, q_i, own);
            by_depth.across = fma(h_i, across, by_depth.across);
            by_depth.along = fma(h_i, along, by_depth.along);
            by_depth.opposite = h_i * opposite;
        };
        add(q.a, slope.a, column.b, column.d, column.c, column.a, f.normal.a, f.by_depth.a);
        add(q.b, slope.b, column.a, column.c, column.d, column.b, f.normal.b, f.by_depth.b);
        add(q.c, slope.c, column.d, column.b, column.a, column.c, f.normal.c, f.by_depth.c);
        add(q.d, slope.d, column.c, column.a, column.b, column.d, f.normal.d, f.by_depth.d);
        if constexpr (DampingStiffness<Damping>::couples) {
            auto const add_rates = [&](Real h_i, Real across, Real along, Real opposite, ApexSlopes<Real>& by_rate) {
                Real const viscous = viscosity * h_i;
                by_rate.own = fma(viscous, h_i, by_rate.own);
                by_rate.across = fma(viscous, across, by_rate.across);
                by_rate.along = fma(viscous, along, by_rate.along);
                by_rate.opposite = viscous * opposite;
            };
            add_rates(slope.a, slope.b, slope.d, slope.c, f.by_rate.a);
            add_rates(slope.b, slope.a, slope.c, slope.d, f.by_rate.b);
            add_rates(slope.c, slope.d, slope.b, slope.a, f.by_rate.c);
            add_rates(slope.d, slope.c, slope.a, slope.b, f.by_rate.d);
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
