#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/laws/wet_polygon.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// An elastic bed over each face (a Winkler foundation), exactly: pressure κ δ₊ (1 + c δ') over what is wet of it, shared to the apices by
/// the bilinear weights N_i = (1 + ξ_i ξ)(1 + η_i η)/4, and never pulling:
///   F_i = max(0, ∫ κ δ₊ (1 + c δ') N_i dA),   U = ∫ ½ κ δ₊² dA.
/// U is convex, as an integral of convex functions of an affine depth.  c is χ of surfaces, or a/v0 with restitution.  No mode: a face, an
/// edge and a corner differ by how much is wet.  Source: model.md 4.
struct Foundation {
    static constexpr Key keys[] = {{"contact.bed_stiffness", &Inputs::law_a, "N/m3", Rule::positive, KeyGroup::law,
                                    "stiffness of the bed: pressure over depth", follows, nullptr, "E_s / l of its face"}};
    static constexpr double face_stiffness(Inputs const& in, double surface, double area) {
        return in.law_a == in.law_a ? in.law_a * area : surface;
    }
    static constexpr LawInfo info{.name = "foundation",
                                  .words = "an elastic bed over each face, no modes",
                                  .switches = false,
                                  .continuous = true,
                                  .groups = groups_of(KeyGroup::elastic, KeyGroup::surfaces, KeyGroup::restitution),
                                  .keys = keys,
                                  .face_stiffness = &face_stiffness};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                               ContactParameters<Real> const& contact) {
        WetPolygon<Real> const wet(depths(m));
        auto const volumes = wet.volumes();
        Real const k = stiffness_of(m, face, contact);
        FaceForces<Real> f;
        f.elastic = f.normal = shared(k, wet.of_face(loads(volumes)));
        if constexpr (Damping::couples) f.normal = shared(k, wet.of_face(damped(volumes, factor<Damping>(wet, m, contact))));
        f.potential = Real(0.5) * k * wet.squares();
        f.outside = mask_of<Real>(false);
        return f;
    }

    /// ∂F_i/∂δ_j = ∫ κ (1 + c δ') N_i N_j dA and ∂F_i/∂δ_j' = ∫ κ δ₊ c N_i N_j dA over what is wet, for changes that leave the face flat.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        WetPolygon<Real> const wet(depths(m));
        auto const volumes = wet.volumes();
        auto const areas = wet.areas();
        Real const k = stiffness_of(m, face, contact);
        auto f = FaceStiffness<Real>::none();
        if constexpr (Damping::couples) {
            auto const by = factor<Damping>(wet, m, contact);
            f.normal = shared(k, wet.of_face(damped(volumes, by)));
            f.by_depth = slopes(pushing(k, f.normal), wet.of_face(damped(areas, wet.higher_areas(), by)));
            f.by_rate = slopes(pushing(k * by.slope, f.normal), wet.of_face(volumes));
        } else {
            f.normal = shared(k, wet.of_face(loads(volumes)));
            f.by_depth = slopes(pushing(k, f.normal), wet.of_face(areas));
        }
        return f;
    }

private:
    /// The factor 1 + c δ' as the polygon sees it.
    template <class Real> struct Factor {
        Real slope;         // c [s/m]
        Plane<Real> excess; // c δ'
    };

    template <class Real> SLIDEWAY_FN static Quad<Real> depths(FaceMotion<Real> const& m) {
        return {m.apex.a.depth, m.apex.b.depth, m.apex.c.depth, m.apex.d.depth};
    }
    template <class Damping, class Real>
    SLIDEWAY_FN static Factor<Real> factor(WetPolygon<Real> const& wet, FaceMotion<Real> const& m, ContactParameters<Real> const& contact) {
        Real const slope = Damping::surface_slope(speed_of_impact<Damping>(m), contact.damping), share = Real(0.25) * slope;
        Real const ac = m.apex.a.rate - m.apex.c.rate, bd = m.apex.b.rate - m.apex.d.rate;
        Real const all = (m.apex.a.rate + m.apex.c.rate) + (m.apex.b.rate + m.apex.d.rate);
        return {slope, wet.seen({share * all, share * (ac + bd), share * (ac - bd)})};
    }

    /// k = κ A: κ as given, else E_s/l; 0 where no apex touches.
    template <class Real>
    SLIDEWAY_FN static Real stiffness_of(FaceMotion<Real> const& m, FaceContact<Real> const& face, ContactParameters<Real> const& contact) {
        Real const given = contact.of_law.a;
        Real const k = select(given == given, given * face.area, face.surface_stiffness);
        return select((m.touching.a | m.touching.b) | (m.touching.c | m.touching.d), k, Real(0.0));
    }

    /// The largest v0 of the apices that touch: those that do not had theirs at an earlier impact.  1 m/s where none does.
    template <class Damping, class Real> SLIDEWAY_FN static Real speed_of_impact(FaceMotion<Real> const& m) {
        Real const zero(0.0), one(1.0);
        if constexpr (!Damping::remembers) return one;  // and nobody asks
        auto const seen = [&](Mask<Real> touching, ApexMotion<Real> const& apex) { return select(touching, apex.impact_speed, zero); };
        Real const speed = max(max(seen(m.touching.a, m.apex.a), seen(m.touching.b, m.apex.b)),
                               max(seen(m.touching.c, m.apex.c), seen(m.touching.d, m.apex.d)));
        return select(speed > zero, speed, one);
    }

    template <class Real> SLIDEWAY_FN static LoadMoments<Real> const& loads(Moments<Real> const& m) { return m; }

    /// Moments of what has moments `m`, times the factor.
    template <class Real> SLIDEWAY_FN static LoadMoments<Real> damped(Moments<Real> const& m, Factor<Real> const& by) {
        auto const& r = by.excess;
        return {m.of_00 + fma(r.level, m.of_00, fma(r.along, m.of_10, r.across * m.of_01)),
                m.of_10 + fma(r.level, m.of_10, fma(r.along, m.of_20, r.across * m.of_11)),
                m.of_01 + fma(r.level, m.of_01, fma(r.along, m.of_11, r.across * m.of_02)),
                m.of_11 + fma(r.level, m.of_11, fma(r.along, m.of_21, r.across * m.of_12))};
    }
    template <class Real>
    SLIDEWAY_FN static Moments<Real> damped(Moments<Real> const& m, HigherMoments<Real> const& h, Factor<Real> const& by) {
        auto const& r = by.excess;
        return {damped(m, by),
                m.of_20 + fma(r.level, m.of_20, fma(r.along, h.of_30, r.across * m.of_21)),
                m.of_02 + fma(r.level, m.of_02, fma(r.along, m.of_12, r.across * h.of_03)),
                m.of_21 + fma(r.level, m.of_21, fma(r.along, h.of_31, r.across * h.of_22)),
                m.of_12 + fma(r.level, m.of_12, fma(r.along, h.of_22, r.across * h.of_13))};
    }

    /// k ∫ N_i of a load [N].
    template <class Real> SLIDEWAY_FN static Quad<Real> shared(Real k, LoadMoments<Real> const& m) {
        Real const quarter = Real(0.25) * k;
        Real const front = m.of_00 + m.of_10, rear = m.of_00 - m.of_10, front_tilt = m.of_01 + m.of_11, rear_tilt = m.of_01 - m.of_11;
        return {clamped(quarter * (front + front_tilt)), clamped(quarter * (front - front_tilt)), clamped(quarter * (rear - rear_tilt)),
                clamped(quarter * (rear + rear_tilt))};
    }
    /// k where an apex has a force, else 0.
    template <class Real> SLIDEWAY_FN static Quad<Real> pushing(Real k, Quad<Real> const& force) {
        Real const zero(0.0);
        return {select(force.a > zero, k, zero), select(force.b > zero, k, zero), select(force.c > zero, k, zero), select(force.d > zero, k, zero)};
    }
    /// k_i ∫ N_i N_j, N_j without its product ξη: how a plane through the depths of the apices follows that of apex j.
    template <class Real> SLIDEWAY_FN static Quad<ApexSlopes<Real>> slopes(Quad<Real> const& k, Moments<Real> const& m) {
        auto const row = [](Real stiffness, Real level, Real along, Real across) {
            Real const share = Real(1.0 / 16) * stiffness, same = level + along, other = level - along;
            return ApexSlopes<Real>{share * (same + across), share * (same - across), share * (other + across), share * (other - across)};
        };
        Real const front = m.of_00 + m.of_10, front_tilt = m.of_01 + m.of_11, front_along = m.of_20 + m.of_10, front_twist = m.of_21 + m.of_11;
        Real const rear = m.of_00 - m.of_10, rear_tilt = m.of_01 - m.of_11, rear_along = m.of_20 - m.of_10, rear_twist = m.of_21 - m.of_11;
        Real const front_across = m.of_02 + m.of_12, rear_across = m.of_02 - m.of_12;
        return {row(k.a, front + front_tilt, front_along + front_twist, front_across + front_tilt),
                row(k.b, front - front_tilt, front_along - front_twist, front_across - front_tilt),
                row(k.c, rear - rear_tilt, rear_along - rear_twist, rear_across - rear_tilt),
                row(k.d, rear + rear_tilt, rear_along + rear_twist, rear_across + rear_tilt)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
