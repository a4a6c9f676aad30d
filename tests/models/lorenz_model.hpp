#pragma once

#include "kernels/steppers/no_watch.hpp"
#include "tests/models/event_recorder.hpp"
#include "tests/models/lorenz.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The Lorenz equations as the lanes integrate them: nothing is observed but the states.
struct LorenzModel : Lorenz {
    static constexpr int series = size;
    static constexpr int events = 0;
    static constexpr bool has_patterns = false;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = false;
    static constexpr bool has_linearisation = false;
    template <class Real> using Observer = EventRecorder<Real, 0, 0>;
    template <class Real> using Watch = NoWatch<Real>;
};

}  // namespace slideway::inline SLIDEWAY_ISA
