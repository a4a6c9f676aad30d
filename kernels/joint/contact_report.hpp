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

    /// @param powers_alone nothing else will be told
    SLIDEWAY_FN void clear(bool powers_alone) {
        Real const zero(0.0);
        this->clear_totals();
        if (powers_alone) return;
        for (auto& force : normal_force) force = {zero, zero, zero, zero};
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
        add_modes(m, f);
    }

    /// One face of every lane.  @param number of it  @param normal F in its own order of the apices
    SLIDEWAY_FN void add_one_face(Real number, Quad<Real> const& normal, FaceMotion<Real> const& m, FaceForces<Real> const& f) {
        Real const zero(0.0);
        for (int face = 0; face < face_count; ++face) {
            auto const is = number == Real(static_cast<double>(face));
            auto& sum = normal_force[face];
            sum = {sum.a + select(is, normal.a, zero), sum.b + select(is, normal.b, zero), sum.c + select(is, normal.c, zero),
                   sum.d + select(is, normal.d, zero)};
        }
        add_modes(m, f);
    }

    SLIDEWAY_FN void add_powers(FaceMotion<Real> const& m, FaceForces<Real> const& f) {
        auto const& apex = m.apex;
        Real const front = fma(f.normal.a - f.elastic.a, apex.a.rate, (f.normal.b - f.elastic.b) * apex.b.rate);
        Real const rear = fma(f.normal.c - f.elastic.c, apex.c.rate, (f.normal.d - f.elastic.d) * apex.d.rate);
        this->damping_power = this->damping_power + (front + rear);
        this->elastic_power = this->elastic_power + (fma(f.elastic.a, apex.a.rate, f.elastic.b * apex.b.rate) +
                                         fma(f.elastic.c, apex.c.rate, f.elastic.d * apex.d.rate));
    }
    SLIDEWAY_FN void add_modes(FaceMotion<Real> const& m, FaceForces<Real> const& f) {
        this->potential = this->potential + f.potential;
        count_modes(m.touching);
    }
    SLIDEWAY_FN void count_modes(Quad<Mask<Real>> const& touching) {
        auto modes = face_modes<Real>(touching);
        this->surfaces = this->surfaces + count<Real>(modes.surface);
        this->lines = this->lines + ((count<Real>(modes.line.a) + count<Real>(modes.line.b)) +
                         (count<Real>(modes.line.c) + count<Real>(modes.line.d)));
        this->points = this->points + ((count<Real>(modes.point.a) + count<Real>(modes.point.b)) +
                           (count<Real>(modes.point.c) + count<Real>(modes.point.d)));
    }

    /// The modes of what is held.
    SLIDEWAY_FN void take_modes(Quad<Real> const* held) {
        Real const half(0.5);
        this->surfaces = this->lines = this->points = Real(0.0);
        for (int face = 0; face < face_count; ++face) {
            auto const& q = held[face];
            count_modes({Mask<Real>(q.a > half), Mask<Real>(q.b > half), Mask<Real>(q.c > half), Mask<Real>(q.d > half)});
        }
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

    /// Depth of the pair that is deepest within its face [m], negative in flight.
    SLIDEWAY_FN Real deepest() const {
        return max(max(largest(penetration[0]), largest(penetration[1])), max(largest(penetration[2]), largest(penetration[3])));
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
