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

}  // namespace slideway::inline SLIDEWAY_ISA
