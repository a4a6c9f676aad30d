#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/contact_totals.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Apex numbers P1…P8 (from 0) of a face's a, b, c, d.  Source: Qian et al. 2020, Table 2: top {1,4,8,5}, bottom {2,3,7,6},
/// front {1,2,6,5}, back {4,3,7,8}.
/// A function, because device code cannot index a constant of the host.
SLIDEWAY_FN constexpr int face_apex(int face, int index) {
    constexpr int apices[face_count][4] = {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}};
    return apices[face][index];
}

/// All that the joint knows of one state, for observers and probes.
template <class Real> struct ContactReport : ContactTotals<Real> {
    Quad<Real> penetration[face_count];   // [m]
    Quad<Real> rate[face_count];          // [m/s]; filled where steps end at events of the contacts
    Quad<Real> normal_force[face_count];  // [N]

    SLIDEWAY_FN void clear() {
        Real const zero(0.0);
        for (auto& force : normal_force) force = {zero, zero, zero, zero};
        this->clear_totals();
    }

    /// A face of every lane: `face` where is_plus holds, the one opposite elsewhere.
    SLIDEWAY_FN void add_face(int face, Mask<Real> is_plus, FaceMotion<Real> const& m, FaceForces<Real> const& f) {
        Real const zero(0.0);
        auto& plus = normal_force[face];
        auto& minus = normal_force[face + 1];
        plus = {plus.a + select(is_plus, f.normal.a, zero), plus.b + select(is_plus, f.normal.b, zero),
                plus.c + select(is_plus, f.normal.c, zero), plus.d + select(is_plus, f.normal.d, zero)};
        minus = {minus.a + select(is_plus, zero, f.normal.a), minus.b + select(is_plus, zero, f.normal.b),
                 minus.c + select(is_plus, zero, f.normal.c), minus.d + select(is_plus, zero, f.normal.d)};
        this->potential = this->potential + f.potential;
        auto const& apex = m.apex;
        Real const front = fma(f.normal.a - f.elastic.a, apex.a.rate, (f.normal.b - f.elastic.b) * apex.b.rate);
        Real const rear = fma(f.normal.c - f.elastic.c, apex.c.rate, (f.normal.d - f.elastic.d) * apex.d.rate);
        this->damping_power = this->damping_power + (front + rear);
        this->elastic_power = this->elastic_power + (fma(f.elastic.a, apex.a.rate, f.elastic.b * apex.b.rate) +
                                         fma(f.elastic.c, apex.c.rate, f.elastic.d * apex.d.rate));
        auto modes = face_modes<Real>(m.touching);
        this->surfaces = this->surfaces + count<Real>(modes.surface);
        this->lines = this->lines + ((count<Real>(modes.line.a) + count<Real>(modes.line.b)) +
                         (count<Real>(modes.line.c) + count<Real>(modes.line.d)));
        this->points = this->points + ((count<Real>(modes.point.a) + count<Real>(modes.point.b)) +
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
