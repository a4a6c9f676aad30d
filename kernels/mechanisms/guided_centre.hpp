#pragma once

#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How the centre of a slider answers to what acts on it in one state, whatever guides it along the way: numbers that a mechanism fills in.  Free are y',
/// z' and, where nothing drives the slider, x'; else x' follows from them, Δx' = κy Δy' + κz Δz'.
template <class Real> struct GuidedCentre {
    /// A symmetric matrix of the free components, which leaves x' alone.
    struct Matrix { Real xx, yy, yz, zz; };

    Real free;              // 1 where x' is free, else 0
    Real slope_y, slope_z;  // κ
    Matrix masses;          // [kg]; xx is 1 where x' is not free
    Matrix inverse;         // [1/kg]; xx is 0 there
    Vec3<Real> unloaded;    // acceleration under all but contact, with loads once they are taken up [m/s²]
    Real drive_x, drive_y;  // velocity of what drives [m/s]
    Real driven;            // mass on it, the slider's and what moves with it [kg]

    /// An impulse or force as the free components feel it: Σ masses_ij Δu'_j = feel(P)_i.
    SLIDEWAY_FN Vec3<Real> feel(Vec3<Real> const& impulse) const {
        return {free * impulse.x, fma(slope_y, impulse.x, impulse.y), fma(slope_z, impulse.x, impulse.z)};
    }
    /// Change of the velocity by an impulse, or of the acceleration by a force.
    SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& impulse) const {
        auto const felt = feel(impulse);
        Real const y = fma(inverse.yy, felt.y, inverse.yz * felt.z), z = fma(inverse.yz, felt.y, inverse.zz * felt.z);
        return {fma(inverse.xx, felt.x, fma(slope_y, y, slope_z * z)), y, z};
    }
    /// What the drive does in an impact [J]: its velocity times its impulse on what it drives, m Δu' − P.  @param change Δu' of the centre
    SLIDEWAY_FN Real impulse_work(Vec3<Real> const& impulse, Vec3<Real> const& change) const {
        return fma(drive_x, fms(driven, change.x, impulse.x), drive_y * fms(driven, change.y, impulse.y));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
