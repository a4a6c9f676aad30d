#pragma once

#include "kernels/joint/attitude.hpp"
#include "kernels/joint/joint_stiffness.hpp"
#include "kernels/math/dense_solve.hpp"
#include "kernels/mechanisms/guided_centre.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A mechanism with one slider linearised about one state, with the structural Jacobian of its contacts: all that a linearly implicit
/// step needs.  In ν = (vy, vz, ωx, ωy, ωz) and q = (y, z, φ, ϑ, ψ), q' = G ν and M ν' = Q(q, ν),
///   A = [0, G; M⁻¹ K G⁻¹, M⁻¹ D],   K = ∂Q/∂(∫ν), D = ∂Q/∂ν of the contacts alone.
/// Left out, because not stiff: ∂G/∂q, ∂M/∂q, rod, weight and gyroscopic terms.
/// Eliminating the positions leaves five equations (Hairer & Wanner, Solving ODEs II (1996), IV.8, for second-order systems):
///   (M − hγ D − (hγ)² K) u_ν = M r_ν + hγ K G⁻¹ r_q,   u_q = r_q + hγ G u_ν.
template <class Real> struct SliderLinearisation {
    JointStiffness<Real> joint;    // K and D
    Real mass_y, mass_z, mass_yz;  // of (vy, vz): m (1 + κκᵀ) [kg]
    Vec3<Real> inertia;            // of ω [kg m²]
    bool has_twelve;               // components of the state, the last a place and its rate, which no contact is stiff against
    SinCos<Real> roll, yaw;
    Real touching;  // apex–face pairs in contact, and one more where there is an oil film
    bool is_coupled = false;  // where turning moves the pin or the centre of mass, in place of these masses:
    Real coupled_mass[5][5];  // of ν

    /// Takes the masses of a slider whose turning moves its pin or its centre of mass.  @param slope κ of the guide  @tparam free x' is, too
    template <bool free, class Offset, class Turning, class Parameters>
    SLIDEWAY_FN void couple(Offset const& offset, Translation<Real> const& slope, Turning const& turning, Parameters const& p) {
        Real const zero(0.0);
        GuidedCentre<Real> of_pin;
        of_pin.slope = Real(free ? 1.0 : 0.0), of_pin.slope_y = slope.y, of_pin.slope_z = slope.z;
        of_pin.masses = {free ? p.slider_mass : Real(1.0), zero, zero, mass_y, mass_yz, mass_z};
        Real six[6][6];
        offset.put_masses(of_pin, turning, p, six);
        // x' gives way; where it is prescribed nothing stands beside its own.
        Real const inverse = Real(1.0) / six[0][0];
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) coupled_mass[i][j] = fnma(six[i + 1][0] * inverse, six[0][j + 1], six[i + 1][j + 1]);
        }
        is_coupled = true;
    }

    /// Prepares `solve` for one hγ [s].  No pivoting: M is positive definite, and what is added nearly so.
    SLIDEWAY_NOINLINE void factor(Real hg) {
        hg_ = hg;
        Real const minus_hg = negated(hg);
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) {
                matrix_[i][j] = minus_hg * fma(hg, joint.by_place[i][j], joint.by_rate[i][j]);
            }
        }
        add_masses();
        factors_.factor(matrix_);
    }

    /// (I − hγ A) u = r.  @param r, u ordered as the state; they may be the same array.
    SLIDEWAY_NOINLINE void solve(Real const* r, Real* u) const {
        Real v[5];
        right_hand_side(r, v);
        factors_.solve(v);
        // G: φ' = ωx + s tanϑ, ϑ' = ωy cosφ − ωz sinφ, ψ' = s/cosϑ with s = ωy sinφ + ωz cosφ.
        Real const pitch = fma(v[3], roll.sin, v[4] * roll.cos) / yaw.cos;
        u[0] = fma(hg_, v[0], r[0]);
        u[1] = fma(hg_, v[1], r[1]);
        u[4] = fma(hg_, fma(pitch, yaw.sin, v[2]), r[4]);
        u[5] = fma(hg_, fms(v[3], roll.cos, v[4] * roll.sin), r[5]);
        u[6] = fma(hg_, pitch, r[6]);
        u[2] = v[0];
        u[3] = v[1];
        u[7] = v[2];
        u[8] = v[3];
        u[9] = v[4];
        if (has_twelve) {  // these two follow explicitly
            u[10] = fma(hg_, r[11], r[10]);
            u[11] = r[11];
        }
    }

    /// How well u solves the five equations of r: the sum over them of |W u − b|/(|W||u| + |b|), a relative backward error in
    /// every unit (Oettli & Prager, Numer. Math. 6 (1964) 405).  About 1e-16 where all is well; NaN if anything is.
    SLIDEWAY_NOINLINE Real residual(Real const* r, Real const* u) const {
        Real b[5];
        right_hand_side(r, b);
        Real const v[5] = {u[2], u[3], u[7], u[8], u[9]};
        Real worst(0.0);
        for (int i = 0; i < 5; ++i) {
            Real rest = negated(b[i]), size = abs(b[i]);
            for (int j = 0; j < 5; ++j) {
                rest = fma(matrix_[i][j], v[j], rest);
                size = fma(abs(matrix_[i][j]), abs(v[j]), size);
            }
            worst = worst + abs(rest) / (size + Real(1e-300));
        }
        return worst;
    }

    /// Square of the rate [1/s] that bounds an explicit step: Ω², the trace of M⁻¹(−K), and the square of the trace of M⁻¹(−D), which
    /// strong damping and steep friction raise.
    SLIDEWAY_FN Real rate_squared() const {
        Real const decay = trace(joint.by_rate);
        return fma(decay, decay, trace(joint.by_place));
    }

    /// Kinetic energy [J] of the stiff motions, which a stiff step damps away: ½ νᵀ(−K)ν/Ω², the masses that the contacts' stiffness
    /// sees.  Sliding along a face has none.  @param s the state.  0 without contact.
    SLIDEWAY_FN Real vibration_energy(Real const* s) const {
        Real const rates[5] = {s[2], s[3], s[7], s[8], s[9]};
        Real sum(0.0);
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) sum = fma(joint.by_place[i][j] * rates[i], rates[j], sum);
        }
        Real const squared = trace(joint.by_place);
        auto const stiff = squared > Real(0.0);
        return select(stiff, Real(0.5) * clamped(negated(sum)) / select(stiff, squared, Real(1.0)), Real(0.0));
    }

private:
    SLIDEWAY_FN void add_masses() {
        if (is_coupled) {
            for (int i = 0; i < 5; ++i) {
                for (int j = 0; j < 5; ++j) matrix_[i][j] = matrix_[i][j] + coupled_mass[i][j];
            }
            return;
        }
        matrix_[0][0] = matrix_[0][0] + mass_y;
        matrix_[0][1] = matrix_[0][1] + mass_yz;
        matrix_[1][0] = matrix_[1][0] + mass_yz;
        matrix_[1][1] = matrix_[1][1] + mass_z;
        matrix_[2][2] = matrix_[2][2] + inertia.x;
        matrix_[3][3] = matrix_[3][3] + inertia.y;
        matrix_[4][4] = matrix_[4][4] + inertia.z;
    }

    /// M r_ν.
    SLIDEWAY_FN void put_momenta(Real const* r, Real* b) const {
        if (is_coupled) {
            Real const v[5] = {r[2], r[3], r[7], r[8], r[9]};
            for (int i = 0; i < 5; ++i) {
                b[i] = coupled_mass[i][0] * v[0];
                for (int j = 1; j < 5; ++j) b[i] = fma(coupled_mass[i][j], v[j], b[i]);
            }
            return;
        }
        b[0] = fma(mass_y, r[2], mass_yz * r[3]);
        b[1] = fma(mass_yz, r[2], mass_z * r[3]);
        b[2] = inertia.x * r[7];
        b[3] = inertia.y * r[8];
        b[4] = inertia.z * r[9];
    }

    /// Trace of M⁻¹(−matrix), of which positive terms alone count.
    SLIDEWAY_FN Real trace(Real const (&matrix)[5][5]) const {
        if (is_coupled) return coupled_trace(matrix);
        Real const scale = Real(1.0) / fms(mass_y, mass_z, mass_yz * mass_yz);
        Real const y = clamped(fms(mass_yz, matrix[1][0], mass_z * matrix[0][0]) * scale);
        Real const z = clamped(fms(mass_yz, matrix[0][1], mass_y * matrix[1][1]) * scale);
        Real const turning = (clamped(negated(matrix[2][2]) / inertia.x) + clamped(negated(matrix[3][3]) / inertia.y)) +
                             clamped(negated(matrix[4][4]) / inertia.z);
        return (y + z) + turning;
    }

    SLIDEWAY_NOINLINE Real coupled_trace(Real const (&matrix)[5][5]) const {
        LuFactors<5, Real> masses;
        masses.factor(coupled_mass);
        Real sum(0.0);
        for (int j = 0; j < 5; ++j) {
            Real column[5];
            for (int i = 0; i < 5; ++i) column[i] = negated(matrix[i][j]);
            masses.solve(column);
            sum = sum + clamped(column[j]);
        }
        return sum;
    }

    /// M r_ν + hγ K G⁻¹ r_q.
    SLIDEWAY_FN void right_hand_side(Real const* r, Real* b) const {
        // G⁻¹: ωx = φ' − ψ' sinϑ, ωy = ϑ' cosφ + ψ' sinφ cosϑ, ωz = −ϑ' sinφ + ψ' cosφ cosϑ.
        Real const upright = yaw.cos * r[6];
        Real const place[5] = {hg_ * r[0], hg_ * r[1], hg_ * fnma(yaw.sin, r[6], r[4]),
                               hg_ * fma(roll.cos, r[5], roll.sin * upright),
                               hg_ * fms(roll.cos, upright, roll.sin * r[5])};
        put_momenta(r, b);
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) b[i] = fma(joint.by_place[i][j], place[j], b[i]);
        }
    }

    Real hg_;
    Real matrix_[5][5];  // W = M − hγ D − (hγ)² K
    LuFactors<5, Real> factors_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
