// What a member remembers of its contacts between steps.
#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

inline constexpr int face_count = 4;  // Y+, Y−, Z+, Z−
inline constexpr double least_impact_speed = 1e-4;

/// Of every pair that may touch: what it did at its last touch, and whether a step holds it.
/// @tparam quads of pairs: one per face of the clearance joint, one for the corners of the planar slider
template <class Real, int quads = face_count> struct ContactMemory {
    static constexpr int speeds = 4 * quads;
    /// v0 of restitution: the δ' of the pair's last touch [m/s], at least `least_impact_speed`.
    Quad<Real> impact_speed[quads];
    /// Where a step takes its contacts as given, so that a law which switches is smooth within it: 1 where a pair is held to touch.
    Quad<Real> held[quads];
    /// 1 where contacts are held; else a pair touches where δ > 0.
    Real holding;
    /// The pair whose δ a step takes from its clock instead of the state: 4 face + place in the face, −1 where there is none.
    Real clock;
    Real clock_depth;  // that δ [m]
    Real touched;      // the face that is held to touch, and what of it (HeldFace); of a spatial slider
};

template <class Real, int quads> SLIDEWAY_FN void start_memory(ContactMemory<Real, quads>& memory) {
    Real const zero(0.0), least(least_impact_speed);
    for (auto& face : memory.impact_speed) face = {least, least, least, least};
    for (auto& face : memory.held) face = {zero, zero, zero, zero};
    memory.holding = memory.clock_depth = memory.touched = zero;
    memory.clock = Real(-1.0);
}

}  // namespace slideway::inline SLIDEWAY_ISA
