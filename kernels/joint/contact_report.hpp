#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

inline constexpr int face_count = 4;  // Y+, Y−, Z+, Z−

/// v0 of restitution: per pair that may touch the δ' of its last touch [m/s], at least `least_impact_speed`.
template <class Real, int quads> struct ImpactSpeeds { Quad<Real> speeds[quads]; };
inline constexpr double least_impact_speed = 1e-4;

/// Of the apex–face pairs.
template <class Real> struct ImpactMemory : ImpactSpeeds<Real, face_count> {};

template <class Real, int quads> SLIDEWAY_FN void start_memory(ImpactSpeeds<Real, quads>& memory) {
    Real const least(least_impact_speed);
    for (auto& face : memory.speeds) face = {least, least, least, least};
}

/// The contacts that a step takes as given, so that a law which switches is smooth within it: 1 where a pair is held to touch.
/// Without `holding` a pair touches where δ > 0.
template <class Real> struct HeldContacts {
    Real holding;
    Quad<Real> touching[face_count];
};

template <class Real> SLIDEWAY_FN void start_memory(HeldContacts<Real>& memory) {
    Real const zero(0.0);
    memory.holding = zero;
    for (auto& face : memory.touching) face = {zero, zero, zero, zero};
}

/// Apex numbers P1…P8 (from 0) of a face's a, b, c, d.  Source: Qian et al. 2020, Table 2: top {1,4,8,5}, bottom {2,3,7,6},
/// front {1,2,6,5}, back {4,3,7,8}.
/// A function, because device code cannot index a constant of the host.
SLIDEWAY_FN constexpr int face_apex(int face, int index) {
    constexpr int apices[face_count][4] = {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}};
    return apices[face][index];
}

/// All that the joint knows of one state, for observers and probes.
template <class Real> struct ContactReport {
    Quad<Real> penetration[face_count];   // [m]
    Quad<Real> rate[face_count];          // [m/s]; filled where steps end at touches
    Quad<Real> normal_force[face_count];  // [N]
    Real surfaces, lines, points;         // how many
    Real potential;                       // U of the contacts [J]
    Real friction_power;                  // Σ μ F V [W]
    Real damping_power;                   // Σ (F − F_elastic) δ' [W]
    Real elastic_power;                   // Σ F_elastic δ' [W], what the springs take up: U' unless a mode switches

    SLIDEWAY_FN void clear() {
        Real const zero(0.0);
        for (auto& force : normal_force) force = {zero, zero, zero, zero};
        surfaces = lines = points = potential = friction_power = damping_power = elastic_power = zero;
    }

    SLIDEWAY_FN void set_penetrations(int face, Quad<Real> const& depth) { penetration[face] = depth; }
    SLIDEWAY_FN void set_rates(int face, Quad<Real> const& r) { rate[face] = r; }

    /// A face of every lane: `face` where is_plus holds, the one opposite elsewhere.
    SLIDEWAY_FN void add_face(int face, Mask<Real> is_plus, FaceMotion<Real> const& m, FaceForces<Real> const& f) {
        Real const zero(0.0);
        auto& plus = normal_force[face];
        auto& minus = normal_force[face + 1];
        plus = {plus.a + select(is_plus, f.normal.a, zero), plus.b + select(is_plus, f.normal.b, zero),
                plus.c + select(is_plus, f.normal.c, zero), plus.d + select(is_plus, f.normal.d, zero)};
        minus = {minus.a + select(is_plus, zero, f.normal.a), minus.b + select(is_plus, zero, f.normal.b),
                 minus.c + select(is_plus, zero, f.normal.c), minus.d + select(is_plus, zero, f.normal.d)};
        potential = potential + f.potential;
        Real const front = fma(f.normal.a - f.elastic.a, m.rate.a, (f.normal.b - f.elastic.b) * m.rate.b);
        Real const rear = fma(f.normal.c - f.elastic.c, m.rate.c, (f.normal.d - f.elastic.d) * m.rate.d);
        damping_power = damping_power + (front + rear);
        elastic_power = elastic_power + (fma(f.elastic.a, m.rate.a, f.elastic.b * m.rate.b) +
                                         fma(f.elastic.c, m.rate.c, f.elastic.d * m.rate.d));
        auto modes = face_modes<Real>(m.touching);
        surfaces = surfaces + count<Real>(modes.surface);
        lines =
            lines + ((count<Real>(modes.ab) + count<Real>(modes.bc)) + (count<Real>(modes.cd) + count<Real>(modes.da)));
        points = points + ((count<Real>(modes.point.a) + count<Real>(modes.point.b)) +
                           (count<Real>(modes.point.c) + count<Real>(modes.point.d)));
    }

    /// Which of the 16 apex–face pairs touch, as a number: bit 4 f + i for apex i of face f.
    SLIDEWAY_FN Real pattern() const {
        Real bits(0.0);
        for (int face = face_count - 1; face >= 0; --face) {
            auto const& depth = penetration[face];
            auto const bit = [](Real const& d, double value) { return select(d > Real(0.0), Real(value), Real(0.0)); };
            Real const four = (bit(depth.a, 1.0) + bit(depth.b, 2.0)) + (bit(depth.c, 4.0) + bit(depth.d, 8.0));
            bits = fma(Real(16.0), bits, four);
        }
        return bits;
    }

    /// Sum of all normal forces [N].
    SLIDEWAY_FN Real total_force() const {
        return (sum(normal_force[0]) + sum(normal_force[1])) + (sum(normal_force[2]) + sum(normal_force[3]));
    }

    /// Normal force of one apex, its Y and its Z face summed [N].
    SLIDEWAY_FN Real apex_force(int apex) const {
        Real force(0.0);
        for (int face = 0; face < face_count; ++face) {
            auto const& q = normal_force[face];
            if (face_apex(face, 0) == apex) force = force + q.a;
            if (face_apex(face, 1) == apex) force = force + q.b;
            if (face_apex(face, 2) == apex) force = force + q.c;
            if (face_apex(face, 3) == apex) force = force + q.d;
        }
        return force;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
