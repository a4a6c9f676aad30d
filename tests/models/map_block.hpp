// The border between map orbits and host: plain views of memory that the host owns.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/block.hpp"

namespace slideway {

/// Members of one map, which reads `MapInputs` of each.  Stop i is after first_stop + i · period steps; the last one ends the orbit.
template <class MapInputs> struct MapBlockOf {
    MapInputs const* inputs = nullptr;  // [members]
    std::size_t members = 0;
    std::uint64_t first_stop = 1, period = 1;  // >= 1
    StopPlan stops;
    ShadowPlan shadows;  // its directions are [members][count][size of the map]; scales are 1
    // results; NaN from where a member's state, or one of its shadows', is not finite
    double* final_states = nullptr;    // [members][size]
    double* section_values = nullptr;  // [members][stops.sections()][size], or none
    double* growth_values = nullptr;   // [members][stops.growths()][shadows.count], ln; unused without shadows
};

}  // namespace slideway
