#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which zeros of an event function count.
enum class Direction {
    rising,   // from below zero
    falling,  // from above zero
    both,
};

/// What a model says of one of its events.
struct EventInfo {
    Direction direction;
    bool resets;  // the model's `reset` changes the state there; else the event is only located
};

/// The event functions at one instant, and their time derivatives.
template <int events, class Real> struct EventValues { Real value[events], slope[events]; };

/// Takes over the values of the lanes in the mask.
template <int events, class Real>
SLIDEWAY_FN void keep_events(Mask<Real> in, EventValues<events, Real> const& from, EventValues<events, Real>& to) {
    for (int event = 0; event < events; ++event) {
        to.value[event] = select(in, from.value[event], to.value[event]);
        to.slope[event] = select(in, from.slope[event], to.slope[event]);
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
