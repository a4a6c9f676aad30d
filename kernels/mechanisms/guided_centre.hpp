#pragma once

#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Whether nothing moves a guide's slider along the way.
template <class Guide> inline constexpr bool is_free_along = [] {
    if constexpr (requires { Guide::is_free; }) return Guide::is_free;
    else return false;
}();

/// How the centre of a slider answers to what acts on it in one state, whatever guides it along the way: numbers that a mechanism fills in.  Free are y',
/// z' and, where nothing drives it, one rate q' more: x' itself, or that of a crank.  x' follows from them, Δx' = κ Δq' + κy Δy' + κz Δz'.
template <class Real> struct GuidedCentre {
    /// A symmetric matrix of (q', y', z').
    struct Matrix { Real qq, qy, qz, yy, yz, zz; };

    Real slope, slope_y, slope_z;  // κ: 0 where a drive moves what is q, 1 where that is x
    Matrix masses;                 // [kg], of a crank [kg m²], [kg m]; qq is 1 where q' is not free
    Matrix inverse;                // qq is 0 there
    Vec3<Real> unloaded;    // acceleration under all but contact, with loads once they are taken up [m/s²]
    Real drive_x, drive_y;  // velocity of what drives [m/s]
    Real driven;            // mass on it, the slider's and what moves with it [kg]

    /// An impulse or force as the free components feel it: Σ masses_ij Δu'_j = feel(P)_i.
    SLIDEWAY_FN Vec3<Real> feel(Vec3<Real> const& impulse) const {
        return {slope * impulse.x, fma(slope_y, impulse.x, impulse.y), fma(slope_z, impulse.x, impulse.z)};
    }
    /// Change of the velocity by an impulse, or of the acceleration by a force.
    SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& impulse) const {
        auto const felt = feel(impulse);
        Real const q = fma(inverse.qq, felt.x, fma(inverse.qy, felt.y, inverse.qz * felt.z));
        Real const y = fma(inverse.qy, felt.x, fma(inverse.yy, felt.y, inverse.yz * felt.z));
        Real const z = fma(inverse.qz, felt.x, fma(inverse.yz, felt.y, inverse.zz * felt.z));
        return {fma(slope, q, fma(slope_y, y, slope_z * z)), y, z};
    }
    /// Change of q' that comes with a change of the centre's velocity.  Where x' does not feel q', at a crank's dead centres, none of the impulses along X
    /// reaches q either: it changes as the others pull it along.
    SLIDEWAY_FN Real rate_change(Vec3<Real> const& change) const {
        Real const along = fnma(slope_y, change.y, fnma(slope_z, change.z, change.x)), pulled = fma(masses.qy, change.y, masses.qz * change.z);
        auto const is_felt = slope * slope * masses.zz > Real(1e-16) * masses.qq;
        return select(is_felt, along / select(is_felt, slope, Real(1.0)), negated(pulled) / masses.qq);
    }
    /// What the drive does in an impact [J]: its velocity times its impulse on what it drives, m Δu' − P.  @param change Δu' of the centre
    SLIDEWAY_FN Real impulse_work(Vec3<Real> const& impulse, Vec3<Real> const& change) const {
        return fma(drive_x, fms(driven, change.x, impulse.x), drive_y * fms(driven, change.y, impulse.y));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
