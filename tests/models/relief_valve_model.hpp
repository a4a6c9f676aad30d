#pragma once

#include "kernels/steppers/no_watch.hpp"
#include "tests/models/event_recorder.hpp"
#include "tests/models/relief_valve.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The relief valve as the lanes integrate it: its impacts and the extrema of its lift are recorded, after a transient of 2,048 of
/// them, until 64 are.
struct ReliefValveModel : ReliefValve {
    static constexpr int series = size;
    static constexpr bool has_patterns = false;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = false;
    static constexpr bool has_linearisation = false;
    template <class Real> using Observer = EventRecorder<Real, 2048, 64>;
    template <class Real> using Watch = NoWatch<Real>;
};

}  // namespace slideway::inline SLIDEWAY_ISA
