#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Masses of the free components of the velocity of a slider's centre [kg]: a symmetric matrix in which what guides the slider leaves
/// x' alone, by itself (xx) or not free at all (then xx is 1).
template <class Real> struct GuidedMasses { Real xx, yy, yz, zz; };

}  // namespace slideway::inline SLIDEWAY_ISA
