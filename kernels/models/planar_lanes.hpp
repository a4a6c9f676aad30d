#pragma once

#include "kernels/mechanisms/planar_base.hpp"
#include "kernels/models/slider_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of the planar slider-crank.  Its contacts are points, which no stiff method need serve, and all four cost less than to group members
/// by them.
template <> struct LanesOf<PlanarBase> : ContactLanes<PlanarBase> {
    static constexpr bool has_patterns = false;
    static constexpr bool has_linearisation = false;
    template <class Real> using Observer = SliderObserver<Real, PlanarReport>;
    template <class Real> using Memory = ContactMemory<Real, 1>;
    template <class Real> using Watch = ContactWatch<Real, 1>;
};

}  // namespace slideway::inline SLIDEWAY_ISA
